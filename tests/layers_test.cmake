# Keeps the layers: who may include what. cmake -DROOT=... -P layers_test.cmake
#     cli -> render -> pipeline, reference -> rays -> compile, device -> native -> scene, formats
#         -> form, kernel_host, base
# A file includes its own folder and what stands to the right. kernels/ never includes src/. Public headers include
# the standard library and each other. Each outside library is used in its own folders alone.
cmake_minimum_required(VERSION 3.25)

set(below_compile scene formats)
set(below_pipeline rays compile device native ${below_compile})
# Of image it sees functions.hpp, by which it is loaded late; else what every program sees: the public
# headers.
set(may_cli scene image)
set(may_render pipeline reference ${below_pipeline})
set(may_pipeline ${below_pipeline})
set(may_reference rays compile ${below_compile})
set(may_rays compile ${below_compile})
set(may_compile ${below_compile})
set(may_device native ${below_compile})
set(may_native device scene)  # one layer with device: it fills the table of functions that device calls
set(may_scene formats)  # one layer with formats: a finding quotes the line of the file
set(may_formats scene)
set(may_verify "")  # all it needs is public
set(may_analysis compile)  # bounds of distances; all else that it needs is public
set(may_image "")
set(may_c "")
set(may_view scene)  # its vectors

# Within pipeline, scheduling includes passes and readback, which do not know of each other, nor of scheduling.
set(where_CL device native pipeline)
set(where_nlohmann formats view)
set(where_OpenImageIO image)
set(where_glm scene formats compile device reference pipeline render kernel_host)

set(findings "")
set(checked 0)

# The folder that `included`, named in `file`, lies in: a layer, "kernels", "csgrt" or "" for the standard library.
function(layer_of file included quoted out)
    cmake_path(GET file PARENT_PATH folder)
    foreach(base ${folder} ${ROOT}/src ${ROOT}/include)
        cmake_path(ABSOLUTE_PATH included BASE_DIRECTORY ${base} NORMALIZE OUTPUT_VARIABLE path)
        if(EXISTS ${path})
            cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE path)
            layer_at(${path} layer)
            set(${out} ${layer} PARENT_SCOPE)
            return()
        endif()
        if(NOT quoted)
            break()
        endif()
    endforeach()
    set(${out} "" PARENT_SCOPE)
endfunction()

# "src/compile/bvh/build.hpp" -> compile, "kernels/scan.cl" -> kernels
function(layer_at path out)
    if(path MATCHES "^src/([a-z_]+)/")
        set(${out} ${CMAKE_MATCH_1} PARENT_SCOPE)
    elseif(path MATCHES "^src/")
        set(${out} base PARENT_SCOPE)
    elseif(path MATCHES "^(kernels|include)/")
        set(${out} ${CMAKE_MATCH_1} PARENT_SCOPE)
    else()
        set(${out} outside PARENT_SCOPE)
    endif()
endfunction()

file(GLOB_RECURSE files RELATIVE ${ROOT}
    ${ROOT}/src/*.?pp ${ROOT}/include/*.hpp ${ROOT}/kernels/*.h ${ROOT}/kernels/*.cl)
foreach(file IN LISTS files)
    layer_at(${file} layer)
    set(may_rooms passes readback scheduling)  # of the pipeline, that the file may include
    if(file MATCHES "^src/pipeline/(passes|readback)/")
        set(may_rooms ${CMAKE_MATCH_1})
    endif()
    file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS includes)
        if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)")
            continue()
        endif()
        math(EXPR checked "${checked} + 1")
        set(included ${CMAKE_MATCH_2})
        if(CMAKE_MATCH_1 STREQUAL "<")
            # An outside library, the public headers, or the standard library.
            string(REGEX REPLACE "/.*" "" library ${included})
            if(DEFINED where_${library} AND NOT layer IN_LIST where_${library})
                list(APPEND findings "${file}: <${included}> belongs into src/ ${where_${library}} alone")
            elseif(layer STREQUAL "kernels")
                list(APPEND findings "${file}: <${included}>: a kernel includes kernels alone")
            elseif(layer STREQUAL "include" AND included MATCHES "/" AND NOT library STREQUAL "csgrt")
                list(APPEND findings "${file}: <${included}>: a public header includes the standard library alone")
            endif()
            continue()
        endif()
        layer_of(${ROOT}/${file} ${included} TRUE target)
        string(REGEX REPLACE "^pipeline/([a-z]+)/.*" "\\1" room ${included})
        if(target STREQUAL "")
            list(APPEND findings "${file}: \"${included}\" is no file of the project")
        elseif(layer STREQUAL "kernels" AND NOT target STREQUAL "kernels")
            list(APPEND findings "${file}: \"${included}\": a kernel includes kernels alone")
        elseif(layer STREQUAL "include")
            list(APPEND findings "${file}: \"${included}\": a public header is included as <csgrt/...>")
        elseif(included MATCHES "^pipeline/[a-z]+/" AND NOT room IN_LIST may_rooms)
            list(APPEND findings
                "${file}: \"${included}\": data goes from scheduling to passes to readback, never back")
        elseif(NOT target STREQUAL layer AND NOT target MATCHES "^(base|form|kernel_host|kernels)$"
               AND NOT target IN_LIST may_${layer})
            list(APPEND findings "${file}: \"${included}\": ${layer} must not include ${target}")
        endif()
    endforeach()
endforeach()

if(checked LESS 20)
    list(APPEND findings "only ${checked} includes were found: is ${ROOT} the project?")
endif()
if(findings)
    list(JOIN findings "\n  " text)
    message(FATAL_ERROR "The layers are not kept:\n  ${text}")
endif()
message(STATUS "${checked} includes, each of its own layer or a lower one")
