# A foreign project makes csgrt a part of itself (HOW: fetch, subdirectory), or finds an installed one (package).
# cmake -DHOW=... -DSHARED=ON|OFF -DIMAGE=ON|OFF -DSTANDARD=20|23 -DCOMPILER=... -DROOT=... -DGENERATOR=... -DWORK=...
# -P foreign_test.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
find_program(compiler ${COMPILER})
if(NOT compiler)
    message("SKIPPED: there is no ${COMPILER}")
    return()
endif()

file(REMOVE_RECURSE ${WORK})
set(options -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${compiler} -DBUILD_SHARED_LIBS=${SHARED}
    -DCSGRT_IMAGE=${IMAGE} -DCSGRT_TESTS=OFF)
if(HOW STREQUAL "package")
    run(${CMAKE_COMMAND} -S ${ROOT} -B ${WORK}/csgrt ${options})
    run(${CMAKE_COMMAND} --build ${WORK}/csgrt)
    run(${CMAKE_COMMAND} --install ${WORK}/csgrt --prefix ${WORK}/first)
    file(RENAME ${WORK}/first ${WORK}/prefix)
    run(${WORK}/prefix/bin/csgrt verify ${ROOT}/scenes/operators.json --rays 100)
endif()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/install -B ${WORK}/build ${options} -DCMAKE_CXX_STANDARD=${STANDARD}
    -DHOW=${HOW} -DCSGRT=${ROOT} -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
run(${CMAKE_COMMAND} --build ${WORK}/build --target consumer)
run(${CMAKE_COMMAND} -E chdir ${WORK}/build ./consumer)
if(IMAGE AND NOT EXISTS ${WORK}/build/ball.exr)
    message(FATAL_ERROR "csgrt::image was built but the consumer did not find it")
endif()
