# The command starts and draws where there is nothing but it: a root folder with the command, the libraries that the
# system's loader says it needs, and a scene. No OpenCL loader, no driver, no home.
# cmake -DCOMMAND=<csgrt> -DLIBRARY=<libcsgrt.so> -DSCENE=<file> -DWORK=<folder> -DHAS_NATIVE=<bool>
#       -P bare_root_test.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/dev)
file(COPY_FILE ${COMMAND} ${WORK}/csgrt)
file(COPY_FILE ${SCENE} ${WORK}/scene.json)
foreach(file ${COMMAND} ${LIBRARY})
    execute_process(COMMAND ldd ${file} OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
    if(needed MATCHES "OpenCL")
        message(FATAL_ERROR "${file} cannot start without an OpenCL loader:\n${needed}")
    endif()
    string(REGEX MATCHALL "/[^ \n]+" libraries "${needed}")
    foreach(library IN LISTS libraries)
        if(EXISTS ${library} AND NOT EXISTS ${WORK}/${library})
            cmake_path(GET library PARENT_PATH folder)
            file(MAKE_DIRECTORY ${WORK}/${folder})
            file(REAL_PATH ${library} real)
            file(COPY_FILE ${real} ${WORK}/${library})
        endif()
    endforeach()
endforeach()

# Root may change the root folder; others, in a namespace of users of their own, where the system lets them.
set(into_root "")
foreach(way "chroot" "unshare;--map-root-user;chroot")
    execute_process(COMMAND ${way} ${WORK} /csgrt --version RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE said)
    if(status EQUAL 0)
        set(into_root ${way})
        break()
    endif()
endforeach()
if(NOT into_root)
    message("SKIPPED: nobody may change the root folder here: ${said}")
    return()
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=HOME --unset=XDG_CACHE_HOME
    ${into_root} ${WORK} /csgrt /scene.json --size 64 --stats -
    RESULT_VARIABLE status OUTPUT_VARIABLE figures ERROR_VARIABLE said)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "it does not draw (${status}): ${said}")
endif()
# Older processors have the reference, as have builds without clang.
file(STRINGS /proc/cpuinfo levels REGEX "avx2|asimd" LIMIT_COUNT 1)
if(HAS_NATIVE AND levels)
    set(expected "\"device\": \"native-")
else()
    set(expected "\"device\": \"reference\"")
    if(NOT said MATCHES "warning: no device draws")
        message(FATAL_ERROR "nobody was told that the reference draws: ${said}")
    endif()
endif()
if(NOT figures MATCHES "${expected}")
    message(FATAL_ERROR "another device draws than should:\n${figures}${said}")
endif()
string(REGEX MATCH "\"ends\": [0-9]+" ends "${figures}")
if(NOT ends MATCHES "[1-9]")
    message(FATAL_ERROR "nothing was drawn:\n${figures}")
endif()

# It has not even looked for one, since no driver could reach a GPU: the system's loader tells what it looked for.
execute_process(COMMAND ${CMAKE_COMMAND} -E env LD_DEBUG=files
    ${into_root} ${WORK} /csgrt /scene.json --size 64 --stats -
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT said MATCHES "libcsgrt")
    message(FATAL_ERROR "the loader does not tell what it loads: ${said}")
elseif(HAS_NATIVE AND levels AND said MATCHES "OpenCL")
    message(FATAL_ERROR "a picture without a GPU looks for OpenCL")
endif()

execute_process(COMMAND ${into_root} ${WORK} /csgrt /scene.json --precision single --size 64 --stats -
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT status EQUAL 4 OR NOT said MATCHES "pocl-opencl-icd")
    message(FATAL_ERROR "single precision without OpenCL should be refused, with advice (${status}): ${said}")
endif()
message(STATUS "${figures}")
