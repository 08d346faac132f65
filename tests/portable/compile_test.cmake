# Compiles TARGETS for the system of TOOLCHAIN into WORK: nothing is linked or run. Skipped where there is no COMPILER.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

find_program(compiler NAMES ${COMPILER})
if(NOT compiler OR NOT CLANG)
    message("SKIPPED: it needs ${COMPILER} and clang")
    return()
endif()
# Without optimization, except of the kernels: it compiles sooner and finds the same errors.
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${ROOT} -B ${WORK}
    -DCMAKE_TOOLCHAIN_FILE=${ROOT}/cmake/toolchains/${TOOLCHAIN}.cmake -DCSGRT_NATIVE=ON -DCSGRT_WERROR=ON
    -DCSGRT_TESTS=OFF -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0)
run(${CMAKE_COMMAND} --build ${WORK} --target ${TARGETS})
