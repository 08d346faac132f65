# csgrt_chart measures a tiny sample, and draw_chart.py draws it where matplotlib is.
# cmake -DCHART=csgrt_chart -DPYTHON=python3 -DROOT=... -DWORK=... -P chart_test.cmake
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
    COMMAND ${CHART} --scenes ${ROOT}/scenes --models ${WORK}/none --rays 16 --truth ${WORK}/truth --truth-only
            --workloads "scene operators,edges"
    RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "csgrt_chart --truth-only failed: ${failed}")
endif()
execute_process(
    COMMAND ${CHART} --scenes ${ROOT}/scenes --models ${WORK}/none --rays 16 --truth ${WORK}/truth --size 16 --frames 1
            --json ${WORK}/tiny.json --workloads "scene operators,edges" --variants "default,single,tolerance none"
            --methods none
    RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "csgrt_chart failed: ${failed}")
endif()
file(READ ${WORK}/tiny.json json)
string(JSON rows LENGTH ${json} results)
if(NOT rows EQUAL 12)
    message(FATAL_ERROR "3 variants on 2 workloads in 2 modes should be 12 results, not ${rows}")
endif()
execute_process(COMMAND ${PYTHON} -c "import matplotlib, plotly" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(failed)
    message("SKIPPED: measured, but not drawn: ${PYTHON} lacks one (Debian, Ubuntu: python3-matplotlib python3-plotly)")
    return()
endif()
execute_process(COMMAND ${PYTHON} ${ROOT}/bench/draw_chart.py -o ${WORK} ${WORK}/tiny.json RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "draw_chart.py failed: ${failed}")
endif()
if(NOT EXISTS ${WORK}/tiny.png)
    message(FATAL_ERROR "there should be tiny.png")
endif()
file(READ ${WORK}/index.html page)
foreach(part "the default is" "Plotly.react" "tolerance none" "What to choose when")
    string(FIND "${page}" "${part}" at)
    if(at EQUAL -1)
        message(FATAL_ERROR "the page has no \"${part}\"")
    endif()
endforeach()
