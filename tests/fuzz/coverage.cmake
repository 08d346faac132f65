# Prints which lines of the readers the seeds and the kept corpus reach, and fails below 90 %: builds the fuzz target
# with Clang's counters in WORK. Needs ROOT, GENERATOR, WORK.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

foreach(tool clang++ llvm-cov llvm-profdata)
    set(names ${tool})
    foreach(version RANGE 20 14 -1)
        list(APPEND names ${tool}-${version})
    endforeach()
    find_program(${tool} NAMES ${names})
    if(NOT ${tool})
        message("SKIPPED: there is no ${tool}")
        return()
    endif()
endforeach()

run(${CMAKE_COMMAND} -S ${ROOT} -B ${WORK} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${clang++} -DCMAKE_BUILD_TYPE=Debug
    "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -fprofile-instr-generate -fcoverage-mapping" -DCSGRT_SANITIZE=address
    -DCSGRT_IMAGE=OFF -DCSGRT_BENCH=OFF -DCSGRT_NATIVE=OFF)
run(${CMAKE_COMMAND} --build ${WORK} --target csgrt_fuzz)
set(corpus ${WORK}/tests/fuzz/corpus)  # fuzz.cmake has unpacked it
set(profiles "")
foreach(reader json asc g rays view)
    list(APPEND profiles ${WORK}/${reader}.profraw)
    set(folders ${ROOT}/tests/fuzz/seeds/${reader} ${corpus}/${reader})
    if(reader STREQUAL "json")
        list(APPEND folders ${ROOT}/scenes ${ROOT}/scenes/broken)
    endif()
    run(${CMAKE_COMMAND} -E env CSGRT_FUZZ=${reader} LLVM_PROFILE_FILE=${WORK}/${reader}.profraw
        ASAN_OPTIONS=detect_leaks=0 ${WORK}/tests/csgrt_fuzz -runs=0 ${folders})
endforeach()
run(${llvm-profdata} merge -o ${WORK}/all.profdata ${profiles})
set(writers "json/(write|schema)|json/(text|unit)[.]|/strict_scene[.]|/picture_names[.]")
execute_process(COMMAND ${llvm-cov} report -instr-profile ${WORK}/all.profdata ${WORK}/tests/csgrt_fuzz
    -ignore-filename-regex=${writers} ${ROOT}/src/formats ${ROOT}/src/cli/text/rays.cpp OUTPUT_VARIABLE output)
message("${output}")
# TOTAL, then regions, functions and lines: all, missed, covered.
if(NOT output MATCHES "TOTAL +[0-9]+ +[0-9]+ +[0-9.]+% +[0-9]+ +[0-9]+ +[0-9.]+% +[0-9]+ +[0-9]+ +([0-9.]+)%")
    message(FATAL_ERROR "the report has no total")
endif()
if(CMAKE_MATCH_1 LESS 90)
    message(FATAL_ERROR "${CMAKE_MATCH_1} % of the readers' lines are reached, less than 90 %")
endif()
