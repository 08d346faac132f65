// Scan: kernels/scan.cl for a processor. The OpenCL kernel's work-items wait for each other (barrier), which loops over
// work-items cannot do. A sequential block takes no longer. The sums are of integers, so the order does not matter.
#include <algorithm>
#include <utility>

#include "native/kernels.hpp"
#include "kernel_host/kernels.hpp"

namespace csgrt::native {
namespace {

using kernel::RayCount;

constexpr std::size_t group = 64, block = 1024;  // SCAN_GROUP, SCAN_BLOCK

std::uint32_t saturated(std::uint32_t a, std::uint32_t b) { return a + b < a ? COUNT_MAX : a + b; }
RayCount plus(RayCount a, RayCount b) { return {saturated(a.segments, b.segments), saturated(a.words, b.words)}; }

/// Replaces each count by the sum of the counts before it. Returns the sum of all counts.
RayCount scan(RayCount* counts, std::size_t size) {
    RayCount sum{};
    for (std::size_t i = 0; i < size; ++i) sum = plus(sum, std::exchange(counts[i], sum));
    return sum;
}

RayCount* counts_at(std::uint64_t argument) {
    return reinterpret_cast<RayCount*>(static_cast<std::uintptr_t>(argument));
}

void scan_blocks(std::size_t first, std::size_t end, const std::uint64_t* arguments) {
    const std::size_t size = static_cast<std::uint32_t>(arguments[2]);
    for (std::size_t b = first / group; b < end / group; ++b)
        counts_at(arguments[1])[b] = scan(counts_at(arguments[0]) + b * block, std::min(block, size - b * block));
}

void scan_sums(std::size_t, std::size_t, const std::uint64_t* arguments) {
    scan(counts_at(arguments[0]), static_cast<std::uint32_t>(arguments[1]));
}

void scan_add(std::size_t first, std::size_t end, const std::uint64_t* arguments) {
    const std::size_t size = static_cast<std::uint32_t>(arguments[2]);
    RayCount* const counts = counts_at(arguments[0]);
    for (std::size_t i = first; i < std::min(end, size); ++i)
        counts[i] = plus(counts[i], counts_at(arguments[1])[i / block]);
}

constexpr std::uint32_t of_two[] = {0, 4}, of_three[] = {0, 0, 4};
constexpr CompiledKernel kernels[] = {{"scan_blocks", scan_blocks, of_three, 3},
                                      {"scan_sums", scan_sums, of_two, 2},
                                      {"scan_add", scan_add, of_three, 3}};

}  // namespace

std::span<const CompiledKernel> scan_kernels() { return kernels; }

}  // namespace csgrt::native
