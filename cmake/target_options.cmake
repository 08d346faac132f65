# What every target of csgrt is compiled with.
#
# -ffp-contract=off: the kernels are compiled for the host as well, and must round as they do on a device.
# For the same reason nothing here may relax floating point (-ffast-math, -march=native with contraction, ...).
# fma is written out where it is wanted; without -mfma it is a call into the C library, which picks the processor's
# instruction at run time. That is slower than the instruction inline, and runs on every x86-64.
function(csgrt_target_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES
        CXX_EXTENSIONS OFF
        POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
        $<$<BOOL:${CSGRT_WERROR}>:-Werror>)
    if(CSGRT_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # it sees what is not there in what the sanitizers add
        target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
        # All false where "literal" + string is inlined (GCC bug 105651).
        target_compile_options(${target} PRIVATE
            -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    endif()
endfunction()

# A shared library of csgrt: its interface is include/, its version the project's. Its name on disk changes with what
# programs may count on: before version 1 that is a minor version, so that 0.2 stands beside 0.1 and replaces nothing.
function(csgrt_library_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    set(compatible ${PROJECT_VERSION_MAJOR})
    if(compatible EQUAL 0)
        set(compatible 0.${PROJECT_VERSION_MINOR})
    endif()
    set_target_properties(${target} PROPERTIES
        LINKER_LANGUAGE CXX
        VERSION ${PROJECT_VERSION}
        SOVERSION ${compatible}
        INSTALL_RPATH "$ORIGIN")
    if(NOT CSGRT_SANITIZE)  # the sanitizers' own symbols come with the program
        target_link_options(${target} PRIVATE LINKER:--no-undefined)
    endif()
endfunction()

set(CSGRT_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, for instance address,undefined")
if(CSGRT_SANITIZE)
    add_compile_options(-fsanitize=${CSGRT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${CSGRT_SANITIZE})
    if(CSGRT_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fsanitize=fuzzer-no-link>)  # counts for tests/fuzz
    endif()
endif()
