// Families of solids: every form that a solid has, in every placement, with
// fixed seeds.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solids/all.hpp"

#include "local_frame.hpp"

namespace csgrt::oracle {

enum class Kind { ell, tgc, arb, arbn, half, tor, ehy, part, epa, rpc, rhc, eto, hyp, superell, hrt, metaball };
constexpr int kind_count = static_cast<int>(Kind::metaball) + 1;

struct Case {
    std::string name;  ///< form, placement
    Shape shape;
    Matrix matrix = identity;
};

namespace detail {

inline constexpr const char* placements[] = {
    "as it is", "turned to other axes", "rotated", "scaled", "scaled unevenly", "sheared", "mirrored", "far away"};

Matrix to_matrix(const QAffine& m);

Matrix placement(std::size_t index, double size, Random& random);

}  // namespace detail

/// Case number `index` of a kind: cycles through its forms, and through the
/// placements once all forms have had one. The first form stands along the
/// axes, others sometimes; sizes are 1, with now and then a thousandth or a
/// million millimetres.
Case make_case(Kind kind, std::size_t index, Random& random);

}  // namespace csgrt::oracle
