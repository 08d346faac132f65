# Installs the build into an empty prefix, moves it, and builds and runs a program against it with find_package alone.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/prefix)

run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} -E chdir ${WORK}/build ./consumer)
run(${WORK}/build/c_consumer)
if(IMAGE AND NOT EXISTS ${WORK}/build/ball.exr)
    message(FATAL_ERROR "csgrt::image was built but the consumer did not find it")
endif()
run(${WORK}/prefix/bin/csgrt --version)
if(IMAGE)
    run(${WORK}/prefix/bin/csgrt compare ${WORK}/build/ball.exr ${WORK}/build/ball.exr)
endif()

# No path of the machine that built it may stand in what is installed.
file(GLOB package ${WORK}/prefix/lib*/cmake/csgrt/*.cmake ${WORK}/prefix/lib*/*/cmake/csgrt/*.cmake)
foreach(file IN LISTS package)
    file(READ ${file} text)
    string(FIND "${text}" "${BUILD}" at)
    if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names the build folder")
    endif()
endforeach()
