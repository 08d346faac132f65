// The parts of the depth buffer's method that tests look at.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "positive_tree.hpp"
#include "region_trees.hpp"

namespace csgrt::bench {

/// Depth as a buffer keeps it: near is 0, far 2^bits - 1, linear between (orthographic), rounded to nearest. With 64
/// bits it is the double itself: its number among all doubles.
class DepthScale {
public:
    static constexpr unsigned exact = 64;
    DepthScale(double near, double far, unsigned bits);
    std::uint64_t kept(double depth) const;
    double depth(std::uint64_t kept) const;

private:
    bool is_exact_;
    double near_, length_, steps_;
};

/// A product of a tree's sum: solids (of the ray's candidates) << 1, and 1 if complemented; ascending, each once.
using Product = std::vector<std::uint32_t>;

/// The sum of products of a live tree. False: more than `most` literals would have to be written.
bool normalize(const std::vector<LiveTrees::Node>& nodes, const LiveTrees::Root& root, std::size_t most,
               std::vector<Product>& sum);

/// Rewrites a whole tree by Goldfeather's rules (normal_form.cpp): each(product of solids, in any order). Returns how
/// often a rule was applied. Nothing: it would not end, or the region holds the empty space.
std::optional<std::uint64_t> rewrite(const GeneralTree& tree, const std::function<void(const Product&)>& each);

}  // namespace csgrt::bench
