# csgrt_bench --compare prints the known ratios of two files, and the known geometric mean: (8 x 0.5 x 0.4 x 2.5)^(1/4).
# Figures have another order in b.json, other devices, and partners that either file lacks.
# cmake -DBENCH=csgrt_bench -P compare_test.cmake
set(folder ${CMAKE_CURRENT_LIST_DIR}/compare)
execute_process(COMMAND ${BENCH} --compare ${folder}/a.json ${folder}/b.json
    OUTPUT_VARIABLE text RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "csgrt_bench --compare failed: ${failed}")
endif()
file(READ ${folder}/expected.txt expected)
if(NOT text STREQUAL expected)
    message(FATAL_ERROR "csgrt_bench --compare printed\n${text}in place of\n${expected}")
endif()
execute_process(COMMAND ${BENCH} --compare ${folder}/a.json ${folder}/expected.txt
    ERROR_VARIABLE text RESULT_VARIABLE status)
if(NOT status EQUAL 6 OR NOT text MATCHES "expected.txt: is no file of this benchmark")
    message(FATAL_ERROR "a file that is no JSON should be refused by name with exit status 6, not ${status}: ${text}")
endif()
