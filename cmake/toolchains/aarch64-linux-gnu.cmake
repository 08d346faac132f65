# aarch64 (64-bit Arm) under Linux, from another machine. Debian, Ubuntu: g++-aarch64-linux-gnu, and qemu-user-static to
# run what is built (docs/portability.md):
#   cmake -G Ninja -S . -B build-aarch64 -DCMAKE_TOOLCHAIN_FILE=cmake/toolchains/aarch64-linux-gnu.cmake
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)  # notes of what GCC 10 changed
set(CMAKE_FIND_ROOT_PATH /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
# The host's libraries are for another processor. Its headers are looked at: header_only.cmake.
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
find_program(CSGRT_EMULATOR NAMES qemu-aarch64-static qemu-aarch64 DOC "Runs programs for aarch64")
if(CSGRT_EMULATOR)
    set(CMAKE_CROSSCOMPILING_EMULATOR ${CSGRT_EMULATOR} -L /usr/aarch64-linux-gnu)
endif()
