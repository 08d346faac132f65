# macOS on Apple's processors, without Apple's SDK: clang compiles the kernels, which need no header but its own, and
# nothing else (docs/portability.md).
#   cmake -G Ninja -S . -B build-macos -DCMAKE_TOOLCHAIN_FILE=cmake/toolchains/arm64-apple-macos.cmake \
#       -DCSGRT_TESTS=OFF
#   cmake --build build-macos --target csgrt_native_kernels
# Under macOS itself no toolchain file is needed.
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR arm64)
find_program(CSGRT_CLANGXX NAMES clang++ clang++-20 clang++-19 clang++-18 clang++-17 clang++-16 clang++-15 clang++-14)
set(CMAKE_CXX_COMPILER ${CSGRT_CLANGXX})
set(CMAKE_CXX_COMPILER_TARGET arm64-apple-macos11)
set(CMAKE_CXX_COMPILER_WORKS ON)  # it links nothing: what CMake would try cannot be tried
set(CMAKE_SIZEOF_VOID_P 8)
set(CMAKE_HAVE_LIBC_PTHREAD ON)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_INCLUDE_PATH /usr/include)
