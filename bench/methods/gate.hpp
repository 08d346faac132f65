// What the nodes of the laboratory's trees compute.
#pragma once

#include <cstdint>

namespace csgrt::bench {

/// Differences are intersections with a complement; where complements stand is each tree's own. Kernels know the
/// numbers (kernels/covered.h).
enum class Gate : std::uint8_t { leaf = 0, union_ = 1, intersection = 2, xor_ = 3 };

/// The value of a gate that is no leaf.
inline bool value_of(Gate gate, bool a, bool b) {
    return gate == Gate::intersection ? a && b : gate == Gate::union_ ? a || b : a != b;
}

}  // namespace csgrt::bench
