// Blists: trees in positive form as lists of leaves (blist.cpp has the theory).
#pragma once

#include <cstdint>
#include <vector>

#include "positive_tree.hpp"

namespace csgrt::bench {

/// A leaf, and which leaf of the list is asked next, always one behind it; or that the point is in or out.
struct BlistLeaf {
    static constexpr std::uint32_t in = 0xffffffff, out = 0xfffffffe;
    std::uint32_t solid;
    bool complement;  ///< the leaf is true where the solid is not
    std::uint32_t on_true, on_false;
};

/// The Blist of a tree with the heavier operands on the left (Grouping::heavy_left). A xor has its right operand twice.
/// The first leaf is asked first; without leaves the point is out. Throws Error (usage): over 2^26 leaves.
std::vector<BlistLeaf> blist_of(const PositiveTree& tree);

/// How many names are wanted at a time: the places that leaves passed may have told to go to next.
std::size_t labels(const std::vector<BlistLeaf>& leaves);

}  // namespace csgrt::bench
