# A parent of csgrt keeps its tests, its build type, its modules and its functions, and gets no names but csgrt's.
# Configured only: what the targets do, other tests tell.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK})
function(configure name)
    run(${CMAKE_COMMAND} -S ${PARENT} -B ${WORK}/${name} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DROOT=${ROOT}
        ${ARGN})
    execute_process(COMMAND ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/${name} -N OUTPUT_VARIABLE tests
        COMMAND_ERROR_IS_FATAL ANY)
    if(NOT tests MATCHES "Test +#1: own\n" OR NOT tests MATCHES "Total Tests: 1\n")
        message(FATAL_ERROR "${name}: not the parent's test alone:\n${tests}")
    endif()
    file(STRINGS ${WORK}/${name}/names.txt names)
    set(names ${names} PARENT_SCOPE)
endfunction()

configure(alone -DCTEST=before)
set(own ${names})
foreach(order before after)
    configure(${order} -DCTEST=${order} -DCSGRT=${ROOT})
    list(REMOVE_ITEM names ${own})
    # What CMake itself, its GNUInstallDirs and its FindThreads keep.
    list(FILTER names EXCLUDE REGEX "^(csgrt|CSGRT|CMAKE_|_GNUInstallDirs|FIND_PACKAGE_MESSAGE_DETAILS_Threads)")
    if(names)
        message(FATAL_ERROR "${order}: names that are not csgrt's: ${names}")
    endif()
endforeach()
