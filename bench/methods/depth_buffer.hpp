// The parts of the depth buffer's method that tests look at.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "region_trees.hpp"

namespace csgrt::bench {

/// Depth as a buffer keeps it: near is 0, far 2^bits - 1, linear between (orthographic), rounded to nearest.
class DepthScale {
public:
    DepthScale(double near, double far, unsigned bits);
    std::uint64_t kept(double depth) const;
    double depth(std::uint64_t kept) const;

private:
    double near_, length_, steps_;
};

/// A product of a tree's sum: solids (of the ray's candidates) << 1, and 1 if complemented; ascending, each once.
using Product = std::vector<std::uint32_t>;

/// The sum of products of a live tree. False: more than `most` literals would have to be written.
bool normalize(const std::vector<LiveTrees::Node>& nodes, const LiveTrees::Root& root, std::size_t most,
               std::vector<Product>& sum);

}  // namespace csgrt::bench
