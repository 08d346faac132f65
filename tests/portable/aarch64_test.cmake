# Builds csgrt for aarch64 into WORK with Debian's cross compiler, runs it under qemu, and compares its answers with
# those of this machine's BUILD (csgrt_answers). Both have the reference's bits. A scene that both compile to the same
# numbers has the same answers. Some scenes are compiled to other numbers: compiling computes with long double, whose
# precision is 64 bits on x86-64 and 113 on aarch64.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../run.cmake)

set(toolchain ${ROOT}/cmake/toolchains/aarch64-linux-gnu.cmake)
find_program(compiler aarch64-linux-gnu-g++)
find_program(emulator NAMES qemu-aarch64-static qemu-aarch64)
foreach(tool compiler emulator CLANG)
    if(NOT ${tool})
        message("SKIPPED: no ${tool} for aarch64 (Debian, Ubuntu: g++-aarch64-linux-gnu qemu-user-static clang)")
        return()
    endif()
endforeach()

# The negative of a fma must stay one, for the sign of its zero (src/native/builtins.h). None of the scenes below
# shows it.
execute_process(COMMAND ${CLANG} -print-resource-dir OUTPUT_VARIABLE resources OUTPUT_STRIP_TRAILING_WHITESPACE)
file(WRITE ${WORK}/zero.cl "double negative(double a, double b, double c) { return -fma(a, b, c); }\n")
execute_process(
    COMMAND ${CLANG} -x cl -cl-std=CL1.2 -Xclang -cl-ext=+cl_khr_fp64 -cl-no-stdinc -target aarch64-linux-gnu -w -O3
        -ffp-contract=off -include ${resources}/include/opencl-c-base.h "-DCSGRT_LDEXP=\"ldexp\""
        -include ${ROOT}/src/native/builtins.h -S -o - ${WORK}/zero.cl
    OUTPUT_VARIABLE assembly COMMAND_ERROR_IS_FATAL ANY)
if(NOT assembly MATCHES "fmadd" OR assembly MATCHES "fnmadd")
    message(FATAL_ERROR "-fma(a, b, c) is not the negative of a fma:\n${assembly}")
endif()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${ROOT} -B ${WORK} -DCMAKE_TOOLCHAIN_FILE=${toolchain} -DCSGRT_NATIVE=ON)
run(${CMAKE_COMMAND} --build ${WORK} --target csgrt_answers csgrt_cli)
run(${CMAKE_COMMAND} --build ${BUILD} --target csgrt_answers)

file(GLOB scenes ${ROOT}/scenes/*.json)
list(FILTER scenes EXCLUDE REGEX schema)
set(emulated ${emulator} -L /usr/aarch64-linux-gnu)
run(${emulated} ${WORK}/csgrt devices)
execute_process(COMMAND ${BUILD}/tests/csgrt_answers 128 ${scenes} OUTPUT_VARIABLE here RESULT_VARIABLE here_result)
execute_process(COMMAND ${emulated} ${WORK}/tests/csgrt_answers 128 ${scenes}
    OUTPUT_VARIABLE there RESULT_VARIABLE there_result)
if(here_result OR there_result)
    message(FATAL_ERROR "csgrt_answers failed: here ${here_result}, for aarch64 ${there_result}\n${here}\n${there}")
endif()

string(REGEX REPLACE "\n$" "" here "${here}")
string(REGEX REPLACE "\n$" "" there "${there}")
string(REPLACE "\n" ";" here "${here}")
string(REPLACE "\n" ";" there "${there}")
set(subjects 0)
set(compiled_alike 0)
set(answered_alike 0)
foreach(mine theirs IN ZIP_LISTS here there)
    math(EXPR subjects "${subjects} + 1")
    foreach(one mine theirs)
        if(NOT "${${one}}" MATCHES "^(.+): scene ([0-9a-f]+) (.*)$")
            message(FATAL_ERROR "what is this: ${${one}}")
        endif()
        set(${one}_name "${CMAKE_MATCH_1}")
        set(${one}_scene ${CMAKE_MATCH_2})
        set(${one}_answers "${CMAKE_MATCH_3}")
    endforeach()
    if(NOT mine_name STREQUAL theirs_name)
        message(FATAL_ERROR "not the same subjects: ${mine_name}, ${theirs_name}")
    endif()
    set(same_answers FALSE)
    if(mine_answers STREQUAL theirs_answers)
        set(same_answers TRUE)
        math(EXPR answered_alike "${answered_alike} + 1")
    endif()
    if(mine_scene STREQUAL theirs_scene)
        math(EXPR compiled_alike "${compiled_alike} + 1")
        if(NOT same_answers)
            message(FATAL_ERROR "the same scene, but other answers\nhere:    ${mine}\naarch64: ${theirs}")
        endif()
    elseif(NOT same_answers)
        message("compiled otherwise, and answered so: ${mine_name}")
    endif()
endforeach()
message("${subjects} subjects: ${compiled_alike} compiled alike, ${answered_alike} answered alike")
math(EXPR half "${subjects} / 2")
if(subjects LESS 50 OR compiled_alike LESS half)
    message(FATAL_ERROR "too few to compare")
endif()
