#include "native/kernels.hpp"

#include <algorithm>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace csgrt::native {
namespace {

#if defined(__x86_64__)

struct Registers {
    unsigned a = 0, b = 0, c = 0, d = 0;
};

Registers cpuid(unsigned leaf) {
    Registers r;
    __get_cpuid_count(leaf, 0, &r.a, &r.b, &r.c, &r.d);
    return r;
}

/// The registers that the system saves (XCR0): bits 1, 2 SSE and AVX; 5 to 7 AVX-512.
unsigned saved_registers() {
    unsigned low = 0, high = 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

bool has(unsigned bits, unsigned wanted) { return (bits & wanted) == wanted; }

/// The level of the processor: 3, 4 for x86-64-v3, v4 (System V ABI for x86-64, "Micro-Architecture Levels"). 0: a
/// lower level.
int level_of_processor() {
    constexpr unsigned fma = 1u << 12, movbe = 1u << 22, osxsave = 1u << 27, avx = 1u << 28, f16c = 1u << 29;
    constexpr unsigned bmi1 = 1u << 3, avx2 = 1u << 5, bmi2 = 1u << 8, lzcnt = 1u << 5;
    constexpr unsigned avx512f = 1u << 16, avx512dq = 1u << 17, avx512cd = 1u << 28, avx512bw = 1u << 30,
                       avx512vl = 1u << 31;
    const unsigned basic = cpuid(1).c, more = cpuid(7).b;
    if (!has(basic, fma | movbe | osxsave | avx | f16c) || !has(more, bmi1 | avx2 | bmi2)) return 0;
    if (!has(cpuid(0x80000001u).c, lzcnt) || !has(saved_registers(), 0x6)) return 0;
    return has(more, avx512f | avx512dq | avx512cd | avx512bw | avx512vl) && has(saved_registers(), 0xe6) ? 4 : 3;
}

#endif

}  // namespace

bool can_run(std::string_view level) {
#if defined(__x86_64__)
    static const int own = level_of_processor();
    return (level == "x86-64-v3" && own >= 3) || (level == "x86-64-v4" && own >= 4);
#elif defined(__aarch64__)
    return level == "aarch64";
#else
    return false;
#endif
}

const CompiledKernel* Program::kernel(std::string_view wanted) const {
    const auto found = std::find_if(kernels.begin(), kernels.end(), [&](const auto& k) { return k.name == wanted; });
    return found == kernels.end() ? nullptr : &*found;
}

const Program* Level::program(std::string_view wanted) const {
    const auto found =
        std::find_if(programs.begin(), programs.end(), [&](const Program& p) { return p.name == wanted; });
    return found == programs.end() ? nullptr : &*found;
}

}  // namespace csgrt::native
