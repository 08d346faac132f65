// Native kernels: kernels that are compiled ahead of time, for each level of instructions of this library. clang
// compiles the files of kernels/ unchanged; cmake/native_kernels.cmake writes the tables.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace csgrt::native {

/// Runs work-items [first, end). An argument is 64 bits: the address of memory, or a value of at most 64 bits.
using Entry = void (*)(std::size_t first, std::size_t end, const std::uint64_t* arguments);

/// A kernel of a program: its entry point, and the sizes of its arguments.
struct CompiledKernel {
    const char* name;
    Entry run;
    const std::uint32_t* argument_sizes;  ///< bytes of a value; 0: memory
    std::uint32_t argument_count;
};

/// A program of native kernels. It supports every type of solid.
struct Program {
    const char* name;  ///< as in the list of cmake/native_kernels.cmake
    std::span<const CompiledKernel> kernels;

    const CompiledKernel* kernel(std::string_view name) const;
};

/// Runs work-items [0, items) of a kernel on this thread. When `stop`, which may be null, becomes true, work-items that
/// have not begun are skipped.
void run_here(const CompiledKernel& kernel, std::size_t items, const std::uint64_t* arguments,
              const std::atomic<bool>* stop);

/// A level of instructions, and the programs that are compiled for it. A processor that can run the level can run all
/// of these programs.
struct Level {
    const char* name;  ///< as compilers name it: x86-64-v4
    std::span<const Program> programs;

    const Program* program(std::string_view name) const;
};

/// The levels of this library, the best first. Empty if the library was built without clang.
std::span<const Level> compiled_levels();

/// Whether this processor and its system can run a level.
bool can_run(std::string_view level);

/// The kernels of kernels/scan.cl, whose work-items wait for each other, as sequential code with the same sums.
std::span<const CompiledKernel> scan_kernels();

}  // namespace csgrt::native
