// Segments -> partitions, the straightforward way: sort all ends, take those within the tolerance of the first as one
// event, keep the covering segments in a unique list.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel_host.hpp"

namespace csgrt {

struct WovenPartition {
    double in = 0, out = 0;
    std::uint32_t in_end = 0, out_end = 0;  ///< into the ends: 2 x segment + side
    std::vector<std::uint32_t> segments;    ///< that cover it, ascending, each once
};

/// `ends`: two a segment, in then out.
std::vector<WovenPartition> weave(const std::vector<kernel::End>& ends, double tolerance);

}  // namespace csgrt
