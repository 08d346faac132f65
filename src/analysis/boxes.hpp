// Boxes: their sides, and what they have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/vector.hpp"

namespace csgrt::analysis {

/// A box without a point; include() takes it as such.
inline constexpr Box no_box = {{1, 1, 1}, {-1, -1, -1}};

inline Vec3 center_of(const Box& box) { return 0.5 * (box.low + box.high); }
inline bool has_inside(const Box& box) {
    return box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z;
}
inline double least_side(const Box& box) {
    const Vec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z});
}
inline bool is_finite(const Box& box) { return std::isfinite(length(box.high - box.low)); }
inline Box common(const Box& a, const Box& b) {
    Box c;
    for (double Vec3::*const axis : axes) {
        c.low.*axis = std::max(a.low.*axis, b.low.*axis);
        c.high.*axis = std::min(a.high.*axis, b.high.*axis);
    }
    return c;
}
inline void include(Box& box, const Vec3& point) {
    const bool is_empty = box.low.x > box.high.x;
    for (double Vec3::*const axis : axes) {
        box.low.*axis = is_empty ? point.*axis : std::min(box.low.*axis, point.*axis);
        box.high.*axis = is_empty ? point.*axis : std::max(box.high.*axis, point.*axis);
    }
}

inline void include(Box& box, const Box& other) {
    include(box, other.low);
    include(box, other.high);
}

/// The parts of a box, cut at the middle of each axis along which it is more than half as long as along its longest
/// one.
inline std::vector<Box> parts_of(const Box& box) {
    const Vec3 size = box.high - box.low, middle = center_of(box);
    const double longest = std::max({size.x, size.y, size.z});
    std::vector<Box> parts = {box};
    for (double Vec3::*const axis : axes) {
        if (size.*axis <= 0.5 * longest) continue;
        const std::size_t count = parts.size();
        for (std::size_t i = 0; i < count; ++i) {
            Box upper = parts[i];
            parts[i].high.*axis = upper.low.*axis = middle.*axis;
            parts.push_back(upper);
        }
    }
    return parts;
}

}  // namespace csgrt::analysis
