# The native device: the files of kernels/, compiled ahead of time by clang's OpenCL C front end.
#
# csgrt_native_kernels(TARGET): the library TARGET of the objects and their table (src/native/kernels.hpp). Without
# clang, or with CSGRT_NATIVE=OFF, the table is empty. The same file is the script that writes what is compiled: cmake
# -DFOLDER=... -DOUTPUT=... -DLEVELS=... -P native_kernels.cmake
#
# A program is compiled with all types of solids and all lights: for one scene's own this costs 1 to 5 %. An entry is a
# loop over work-items around a kernel: a call for each of them took up to five times as long.
set(programs first_hits first_hits_prefetch partitions)
set(first_hits_files 0_cull_tiles.cl packet/first_hits_packet.h first_hits.cl list_hits.cl)
set(first_hits_prefetch_files ${first_hits_files})
set(partitions_files 0_cull_tiles.cl 0_make_rays.cl 1_packet_candidates.cl 1_count_segments.cl 2_store_segments.cl
                     2_rays_in_faces.cl 3_weave.cl 4_evaluate.cl 3_deep_rays.cl 5_shade.cl 6_rows.cl)
set(first_hits_options -DCSGRT_PRIVATE_BOUNDARIES -DCSGRT_FEW=64u)
set(first_hits_prefetch_options ${first_hits_options} -DCSGRT_PREFETCH)
set(partitions_options "")

if(NOT CMAKE_SCRIPT_MODE_FILE)
    set(clangs clang clang-20 clang-19 clang-18 clang-17 clang-16 clang-15 clang-14)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")  # a sanitizer's library must be the one that it links
        string(REPLACE "clang++" "clang" own_clang ${CMAKE_CXX_COMPILER})
        list(PREPEND clangs ${own_clang})
    endif()
    find_program(CSGRT_CLANG NAMES ${clangs} DOC "clang, which compiles the native device's kernels")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
        set(native_levels x86-64-v4 x86-64-v3)
        if(CSGRT_SANITIZE)  # they take 20 s a program, and see the same code at each level
            set(native_levels x86-64-v3)
        endif()
        set(native_processor x86_64)
    elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
        set(native_levels aarch64)
        set(native_processor aarch64)
    endif()
    set(native_ldexp ldexp)
    if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
        set(native_target ${native_processor}-linux-gnu)
    elseif(WIN32)
        set(native_target ${native_processor}-w64-windows-gnu)
    elseif(APPLE)
        string(REPLACE aarch64 arm64 native_target ${native_processor}-apple-macos11)
        set(native_ldexp _ldexp)  # as compilers name a function of C there
    else()
        set(native_levels "")
    endif()
    set(native_default OFF)
    if(CSGRT_CLANG AND native_levels)
        set(native_default ON)
    endif()
    option(CSGRT_NATIVE "Kernels compiled ahead of time for processors (needs clang)" ${native_default})
    if(CSGRT_NATIVE AND NOT native_default)
        message(FATAL_ERROR "CSGRT_NATIVE is ON, but clang was not found (Debian, Ubuntu: clang), "
            "or the processor or the system is not known")
    elseif(NOT CSGRT_NATIVE)
        set(native_levels "")
        message(NOTICE "No native device: it needs clang (Debian, Ubuntu: clang) and x86-64 or aarch64. "
            "OpenCL alone draws.")
    endif()

    function(csgrt_native_kernels target)
        set(folder ${CMAKE_CURRENT_BINARY_DIR}/native)
        set(sources "")
        foreach(program IN LISTS programs)
            list(APPEND sources ${folder}/${program}_program.cl)
        endforeach()
        file(GLOB_RECURSE kernels CONFIGURE_DEPENDS
            ${PROJECT_SOURCE_DIR}/kernels/*.h ${PROJECT_SOURCE_DIR}/kernels/*.cl)
        add_custom_command(
            OUTPUT ${folder}/table.cpp ${sources}
            COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/kernels -DOUTPUT=${folder}
                "-DLEVELS=${native_levels}"
                -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
            DEPENDS ${kernels} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
            COMMENT "Listing the kernels for the native device" VERBATIM)
        add_library(${target} STATIC ${folder}/table.cpp)
        csgrt_target_options(${target})
        target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
        if(NOT native_levels)
            return()
        endif()

        execute_process(COMMAND ${CSGRT_CLANG} -print-resource-dir
            OUTPUT_VARIABLE resources OUTPUT_STRIP_TRAILING_WHITESPACE)
        # clang tells kernels no version of OpenCL C where its target is a processor, nor, on aarch64, that it has
        # doubles. Contraction: as of the host's code.
        set(options -x cl -cl-std=CL1.2 -Xclang -cl-ext=+cl_khr_fp64 -cl-no-stdinc -target ${native_target} -w -fPIC
            -fvisibility=hidden -fno-math-errno -ffp-contract=off
            -include ${resources}/include/opencl-c-base.h -D__OPENCL_VERSION__=120 -DCSGRT_LDEXP="${native_ldexp}"
            -include ${PROJECT_SOURCE_DIR}/src/native/builtins.h -I${PROJECT_SOURCE_DIR}/kernels
            -DCSGRT_REAL=double "-DCSGRT_SOLIDS=((1u << SOLID_TYPES) - 1u)" -DCSGRT_QUARTIC=0 -DCSGRT_PACKETS
            -DCSGRT_LARGE_TERMS
            -DCSGRT_SHAPED_LIGHTS)
        if(CSGRT_SANITIZE)
            # An empty buffer is a null pointer, to which kernels add 0: C++ allows it, C does not.
            list(APPEND options -O1 -g -fsanitize=${CSGRT_SANITIZE} -fno-sanitize=pointer-overflow
                -fno-sanitize-recover=all
                -fno-omit-frame-pointer)
        elseif(CMAKE_BUILD_TYPE STREQUAL "Debug")  # to step through them: docs/native.md
            list(APPEND options -O0 -g)
        else()
            list(APPEND options -O3 -mllvm -inline-threshold=3000)  # as drivers do: evaluate takes three quarters
        endif()
        set(objects "")
        foreach(level IN LISTS native_levels)
            set(march "")
            if(level MATCHES "^x86-64")
                set(march -march=${level})
            endif()
            string(MAKE_C_IDENTIFIER ${level} suffix)
            foreach(program IN LISTS programs)
                set(object ${folder}/${program}_${suffix}${CMAKE_CXX_OUTPUT_EXTENSION})
                add_custom_command(
                    OUTPUT ${object}
                    COMMAND ${CSGRT_CLANG} ${options} ${march} ${${program}_options}
                        "-DNATIVE_NAME(x)=csgrt_${suffix}_${program}_##x"
                        -MD -MF ${object}.d -c ${folder}/${program}_program.cl -o ${object}
                    DEPENDS ${folder}/${program}_program.cl ${PROJECT_SOURCE_DIR}/src/native/builtins.h
                    DEPFILE ${object}.d
                    COMMENT "Compiling the kernels of ${program} for ${level}" VERBATIM)
                set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
                target_sources(${target} PRIVATE ${object})
                list(APPEND objects ${object})
            endforeach()
        endforeach()
        # For a system whose C++ headers are not there: clang alone makes these.
        add_custom_target(${target}_kernels DEPENDS ${objects})
    endfunction()
    return()
endif()

# ---- The script ----
# Arguments that kernels take in groups: names of macros, each followed by what it stands for.
file(READ ${FOLDER}/shared/scene_args.h groups)
string(REGEX REPLACE " *\\\\\n *" " " groups "${groups}")
string(REGEX MATCHALL "#define [A-Z]+_ARGS [^\n]+" groups "${groups}")

# kernels_of(FILE OUT): "NAME(PARAMETERS)" of each kernel, which may stand on several lines.
function(kernels_of file out)
    file(READ ${FOLDER}/${file} text)
    string(REPLACE ";" " " text "${text}")
    string(REGEX MATCHALL "__kernel void [a-z_0-9]+\\([^)]*\\)" found "${text}")
    set(kernels "")
    foreach(kernel IN LISTS found)
        foreach(pass 1 2)  # a group may hold another
            foreach(group IN LISTS groups)
                string(REGEX MATCH "^#define ([A-Z]+_ARGS) (.*)$" all "${group}")
                string(REPLACE ${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" kernel "${kernel}")
            endforeach()
        endforeach()
        string(REGEX REPLACE "[ \n]+" " " kernel "${kernel}")
        string(REPLACE "__kernel void " "" kernel "${kernel}")
        list(APPEND kernels "${kernel}")
    endforeach()
    set(${out} "${kernels}" PARENT_SCOPE)
endfunction()

# entry_of(KERNEL NAME OUT): the loop around it, and the sizes of its arguments.
function(entry_of kernel name_out count_out text_out)
    string(REGEX MATCH "^([a-z_0-9]+)\\((.*)\\)$" all "${kernel}")
    set(name ${CMAKE_MATCH_1})
    string(REPLACE "," ";" parameters "${CMAKE_MATCH_2}")
    set(count 0)
    set(sizes "")
    set(taken "")
    set(names "")
    foreach(parameter IN LISTS parameters)
        string(STRIP "${parameter}" parameter)
        if(parameter MATCHES "__local" OR NOT parameter MATCHES "[ *][a-z_0-9]+$")
            message(FATAL_ERROR "${name}: a native kernel cannot take the parameter \"${parameter}\"")
        endif()
        string(REGEX MATCH "^(.*[ *])([a-z_0-9]+)$" all "${parameter}")
        string(STRIP "${CMAKE_MATCH_1}" type)
        set(parameter_name ${CMAKE_MATCH_2})
        if(type MATCHES "\\*$")
            list(APPEND sizes "0")
            string(APPEND taken "    ${type} ${parameter_name} = (${type})arguments[${count}];\n")
        else()
            list(APPEND sizes "sizeof(${type})")
            string(APPEND taken "    ${type} ${parameter_name};\n")
            string(APPEND taken
                "    __builtin_memcpy(&${parameter_name}, arguments + ${count}, sizeof ${parameter_name});\n")
        endif()
        list(APPEND names ${parameter_name})
        math(EXPR count "${count} + 1")
    endforeach()
    list(JOIN sizes ", " sizes)
    list(JOIN names ", " names)
    set(${name_out} ${name} PARENT_SCOPE)
    set(${count_out} ${count} PARENT_SCOPE)
    set(${text_out} "__constant uint NATIVE_NAME(${name}_sizes)[] = {${sizes}};
void NATIVE_NAME(${name})(ulong first_item, ulong end_item, const ulong* arguments) {
    WorkItem* const item = csgrt_native_item();
${taken}    const volatile uchar* const stop = item->stop;
    for (; first_item < end_item && !*stop; ++first_item) {
        item->id = first_item;
        ${name}(${names});
    }
}
" PARENT_SCOPE)
endfunction()

set(declarations "")
set(tables "")
foreach(program IN LISTS programs)
    set(text "// Made by cmake/native_kernels.cmake from kernels/; edit those.\n")
    string(APPEND text "#define __kernel static inline __attribute__((always_inline))\n")
    set(entries "")
    set(${program}_kernels "")
    foreach(file IN LISTS ${program}_files)
        string(APPEND text "#include \"${file}\"\n")
        kernels_of(${file} kernels)
        foreach(kernel IN LISTS kernels)
            entry_of("${kernel}" name count entry)
            string(APPEND entries "${entry}")
            list(APPEND ${program}_kernels "${name}:${count}")
        endforeach()
    endforeach()
    file(CONFIGURE OUTPUT ${OUTPUT}/${program}_program.cl CONTENT "${text}${entries}" @ONLY)
endforeach()

set(levels "")
foreach(level IN LISTS LEVELS)
    string(MAKE_C_IDENTIFIER ${level} suffix)
    set(of_level "")
    foreach(program IN LISTS programs)
        set(rows "")
        foreach(kernel IN LISTS ${program}_kernels)
            string(REPLACE ":" ";" kernel ${kernel})
            list(GET kernel 0 name)
            list(GET kernel 1 count)
            set(entry csgrt_${suffix}_${program}_${name})
            string(APPEND declarations
                "void ${entry}(std::size_t first, std::size_t end, const std::uint64_t* arguments);\n")
            string(APPEND declarations "extern const std::uint32_t ${entry}_sizes[];\n")
            string(APPEND rows "    {\"${name}\", ${entry}, ${entry}_sizes, ${count}},\n")
        endforeach()
        string(APPEND tables "const CompiledKernel ${suffix}_${program}[] = {\n${rows}};\n")
        string(APPEND of_level "    {\"${program}\", ${suffix}_${program}},\n")
    endforeach()
    string(APPEND tables "const Program ${suffix}[] = {\n${of_level}};\n")
    string(APPEND levels "    {\"${level}\", ${suffix}},\n")
endforeach()
if(levels)
    string(APPEND tables "const Level levels[] = {\n${levels}};\n")
    set(result "levels")
else()
    set(result "{}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT}/table.cpp CONTENT "// Made by cmake/native_kernels.cmake from kernels/; edit those.
#include \"native/kernels.hpp\"

extern \"C\" {
${declarations}}

namespace csgrt::native {
namespace {

${tables}
}  // namespace

std::span<const Level> compiled_levels() { return ${result}; }

}  // namespace csgrt::native
" @ONLY)
