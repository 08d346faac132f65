// What goes wrong in the stress suite at the default settings today, family by family: no more than this may. A family
// that gets better stays within its bounds; tighten them then.
//
// Nearly all of it has one reason, the absolute tolerance of 0.0005 mm: whatever is thinner vanishes, be it a shell, a
// corner cut off, or a whole model (see "/ 1024": every scene made 1024 times smaller). With --tolerance 0 there remain
//   - coincident: curved surfaces that are one leave skins, since they do not share a record as planes do;
//   - slivers, degenerate: a plate thinner than a millionth of its diagonal and not along the axes has no sides
//     (src/compile/polyhedron.cpp, same_corner_relative).
#pragma once

#include <array>
#include <string>

#include "stress/speckles.hpp"

namespace csgrt::test {

struct Bounds {
    const char* family;
    std::size_t wrong, overlaps, far;
    std::array<std::size_t, changes.size()> disagreements;  ///< in the order of `changes`
    std::size_t speckles;
};

using BoundsTable = std::array<Bounds, 12>;

/// What the default tests run (stress_test.cpp).
inline constexpr BoundsTable sample_bounds{{
    {"coplanar", 1, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 104}, 0},
    {"coincident", 0, 0, 2, {0, 0, 0, 0, 0, 0, 0, 0, 0, 62}, 0},
    {"tangent", 42, 1, 1, {0, 0, 0, 0, 0, 0, 0, 0, 22, 96}, 0},
    {"edges", 30, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 4, 28}, 0},
    {"far_origin", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 60}, 0},
    {"scale", 94, 0, 7, {0, 0, 0, 0, 7, 0, 0, 0, 54, 160}, 0},
    {"slivers", 250, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 13, 104}, 0},
    {"degenerate", 11, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 10, 159}, 0},
    {"deep_trees", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 32}, 0},
    {"depth", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 72}, 0},
    {"overlaps", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 35}, 0},
    {"nested", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 39}, 0},
}};
inline constexpr BoundsTable sample_bounds_without_tolerance{{
    {"coplanar", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, 0},
    {"coincident", 13, 0, 0, {0, 0, 0, 0, 18, 39, 13, 35, 0, 0}, 119},
    {"tangent", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"edges", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"far_origin", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"scale", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"slivers", 43, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"degenerate", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"deep_trees", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"depth", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"overlaps", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"nested", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
}};

/// Seeds 0 to 83.
inline constexpr BoundsTable long_bounds{{
    {"coplanar", 3, 0, 2, {0, 0, 0, 0, 0, 0, 0, 0, 1, 864}, 10},
    {"coincident", 18, 0, 7, {0, 0, 0, 0, 0, 0, 0, 0, 12, 708}, 23},
    {"tangent", 294, 1, 5, {0, 0, 0, 0, 0, 0, 0, 0, 175, 689}, 0},
    {"edges", 232, 0, 11, {0, 0, 0, 0, 0, 0, 0, 0, 39, 175}, 0},
    {"far_origin", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 316}, 0},
    {"scale", 551, 2, 74, {0, 0, 0, 0, 23, 0, 0, 0, 189, 587}, 0},
    {"slivers", 1367, 0, 0, {0, 0, 0, 0, 3, 0, 0, 0, 169, 724}, 0},
    {"degenerate", 392, 0, 35, {0, 0, 0, 0, 0, 0, 0, 0, 137, 849}, 0},
    {"deep_trees", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 181}, 0},
    {"depth", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 288}, 0},
    {"overlaps", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 241}, 0},
    {"nested", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 202}, 0},
}};
inline constexpr BoundsTable long_bounds_without_tolerance{{
    {"coplanar", 2, 0, 0, {0, 0, 0, 0, 2, 4, 1, 4, 0, 0}, 4},
    {"coincident", 135, 18, 0, {0, 0, 0, 0, 197, 251, 107, 231, 0, 0}, 1215},
    {"tangent", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"edges", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, 0},
    {"far_origin", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"scale", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"slivers", 98, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"degenerate", 10, 0, 35, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"deep_trees", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"depth", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"overlaps", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
    {"nested", 0, 0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0},
}};

}  // namespace csgrt::test
