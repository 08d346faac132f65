# Windows on x86-64, from Linux. Debian, Ubuntu: g++-mingw-w64-x86-64-posix. The library is compiled only
# (docs/portability.md):
#   cmake -G Ninja -S . -B build-windows -DCMAKE_TOOLCHAIN_FILE=cmake/toolchains/x86_64-w64-mingw32.cmake \
#       -DCSGRT_TESTS=OFF
#   cmake --build build-windows --target csgrt_core csgrt_native
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)  # the kind that has std::thread
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_INCLUDE_PATH /usr/include)  # headers alone: header_only.cmake
