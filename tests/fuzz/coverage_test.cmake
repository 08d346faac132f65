# Which lines of the readers the seeds reach: builds the fuzz target with Clang's counters in WORK and prints a table.
# Needs ROOT, GENERATOR, WORK.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

find_program(clang NAMES clang++ clang++-20 clang++-19 clang++-18 clang++-17 clang++-16 clang++-15 clang++-14)
find_program(cov NAMES llvm-cov llvm-cov-20 llvm-cov-19 llvm-cov-18 llvm-cov-17 llvm-cov-16 llvm-cov-15 llvm-cov-14)
find_program(profdata NAMES llvm-profdata llvm-profdata-20 llvm-profdata-19 llvm-profdata-18 llvm-profdata-17
    llvm-profdata-16 llvm-profdata-15 llvm-profdata-14)
if(NOT clang OR NOT cov OR NOT profdata)
    message("SKIPPED: there is no clang++, llvm-cov or llvm-profdata")
    return()
endif()

run(${CMAKE_COMMAND} -S ${ROOT} -B ${WORK} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${clang} -DCMAKE_BUILD_TYPE=Debug
    "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -fprofile-instr-generate -fcoverage-mapping" -DCSGRT_SANITIZE=address
    -DCSGRT_IMAGE=OFF -DCSGRT_BENCH=OFF -DCSGRT_NATIVE=OFF)
run(${CMAKE_COMMAND} --build ${WORK} --target csgrt_fuzz)
set(seeds ${ROOT}/tests/fuzz/seeds)
set(profiles "")
foreach(reader json asc g rays view)
    set(profile ${WORK}/${reader}.profraw)
    list(APPEND profiles ${profile})
    set(folders ${seeds}/${reader})
    if(reader STREQUAL "json")
        list(APPEND folders ${ROOT}/scenes ${ROOT}/scenes/broken)
    endif()
    run(${CMAKE_COMMAND} -E env CSGRT_FUZZ=${reader} LLVM_PROFILE_FILE=${profile} ASAN_OPTIONS=detect_leaks=0
        ${WORK}/tests/csgrt_fuzz -runs=0 ${folders})
endforeach()
run(${profdata} merge -o ${WORK}/all.profdata ${profiles})
run(${cov} report -instr-profile ${WORK}/all.profdata ${WORK}/tests/csgrt_fuzz ${ROOT}/src/formats
    ${ROOT}/src/cli/text/rays.cpp)
message("${output}")
# TOTAL, then regions, functions and lines: all, missed, covered.
if(NOT output MATCHES "TOTAL +[0-9]+ +[0-9]+ +[0-9.]+% +[0-9]+ +[0-9]+ +[0-9.]+% +[0-9]+ +[0-9]+ +([0-9.]+)%")
    message(FATAL_ERROR "the report has no total")
endif()
if(CMAKE_MATCH_1 LESS 90)
    message(FATAL_ERROR "the seeds reach ${CMAKE_MATCH_1} % of the readers' lines, less than 90 %")
endif()
