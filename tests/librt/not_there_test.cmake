# What csgrt/librt.h does not have must not compile, and the compiler must name it.
# cmake -DCOMPILER=... -DINCLUDE=... -DWORK=... -P not_there_test.cmake
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${WORK})

# compile(STATEMENTS RESULT WORDS)
function(compile statements result words)
    file(WRITE ${WORK}/one.cpp "#include <csgrt/librt.h>\nvoid use(hit* hitp, soltab* stp) {\n${statements}}\n")
    execute_process(COMMAND ${COMPILER} -std=c++20 -I${INCLUDE} -Wno-unused -fsyntax-only ${WORK}/one.cpp
        RESULT_VARIABLE code ERROR_VARIABLE text)
    set(${result} ${code} PARENT_SCOPE)
    set(${words} "${text}" PARENT_SCOPE)
endfunction()

compile("vect_t n;\nRT_HIT_NORMAL(n, hitp, stp, hitp->hit_rayp, 0);\n" result words)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "what is there does not compile:\n${words}")
endif()
compile("struct curvature c;
    RT_CURVATURE(nullptr, hitp, 0, stp);
    struct uvcoord uv;
    RT_HIT_UVCOORD(nullptr, stp, hitp, nullptr);
    int number = hitp->hit_surfno;
    hitp->hit_surfno = 3;
" result words)
# From the third line on, each is an error that names what is not there.
set(line 3)
foreach(name curvature csgrt_has_no_curvature uvcoord csgrt_has_no_uv_coordinates csgrt_does_not_have
        csgrt_does_not_have)
    if(NOT words MATCHES "(one.cpp:${line}|librt.h:[0-9]+):[0-9]+: error[^\n]*${name}")
        message(FATAL_ERROR "line ${line} is no error about ${name}:\n${words}")
    endif()
    math(EXPR line "${line} + 1")
endforeach()
