// Build: builds the bounding volume hierarchy that culling, kernel 1 and first hits walk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A bounding volume hierarchy in depth-first order, as kernels/traversal/bvh_cursor.h walks it.
struct Hierarchy {
    std::vector<kernel::BvhNode> nodes;  ///< none if there are no boxes
    std::vector<std::uint32_t> order;    ///< boxes in the order of the leaves
};

/// A hierarchy of most of the same boxes, numbered from 0, whose subtrees are taken over where none of their boxes has
/// changed.
struct EarlierHierarchy {
    const std::vector<kernel::BvhNode>& nodes;
    const std::vector<std::uint32_t>& order;    ///< numbers of boxes, as they are now; 0xffffffff: a box that is gone
    const std::vector<std::uint32_t>& changed;  ///< the boxes that have changed
};

/// The padding of boxes on all sides, relative to the radius. The slab test of kernels/shared/slab.h moves the ray's
/// origin to within one radius of the centre. There rounding to float displaces a side by less than half of the
/// padding.
inline constexpr double bvh_padding = 1.0 / (1 << 20);

/// Builds the hierarchy by the binned surface area heuristic, with 1 to 4 boxes a leaf. Several threads may call
/// `box_of(i)`, for i < count < 2^28, at once. `center` and `radius` describe a sphere around all boxes. The i-th box
/// of the order gets the number first_solid + i. `threads` (0: as many as there are processors) and `earlier`, which
/// has the same sphere and no fewer boxes, change only the time.
Hierarchy build_bvh(std::size_t count, const std::function<Box(std::size_t)>& box_of, const Vec3& center, double radius,
                    std::uint32_t first_solid, unsigned threads = 0, const EarlierHierarchy* earlier = nullptr);

inline Hierarchy build_bvh(const std::vector<Box>& boxes, const Vec3& center, double radius, std::uint32_t first_solid,
                           unsigned threads = 0) {
    return build_bvh(
        boxes.size(), [&](std::size_t i) { return boxes[i]; }, center, radius, first_solid, threads);
}

}  // namespace csgrt
