// Kensler's table, for the tests.
#pragma once

#include "region_trees.hpp"

namespace csgrt::bench::kensler_table {

/// What a ray meets of a set next: a surface where it enters, or one where it leaves, or none any more. Where it leaves
/// next, it is inside.
enum class Next { enter, exit, miss };
enum class Action {
    take_a,
    take_b,
    take_a_flipped,  ///< where the ray enters A it leaves the whole, and the reverse
    take_b_flipped,
    miss,
    pass_a,  ///< A's surface is within B, or outside it: look for the one behind it
    pass_b,
};

/// `a_at`, `b_at`: where they are met, infinity where they are not.
Action action(Gate gate, Next a, double a_at, Next b, double b_at);

}  // namespace csgrt::bench::kensler_table
