#include "compile/bvh/space.hpp"

#include <utility>

#include "base/parallel.hpp"
#include "compile/bvh/build.hpp"
#include "compile/linear.hpp"

namespace csgrt {

namespace {

/// The sphere around all bounded solids, from the box around their boxes. Returns how many solids are not bounded.
std::size_t set_sphere(const std::vector<Box>& boxes, Space& space) {
    struct Part {
        Box box = empty_box;
        std::size_t unbounded = 0;
    };
    constexpr std::size_t many = 16'384;
    std::vector<Part> parts((boxes.size() + many - 1) / many);
    for_chunks(boxes.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        Part part;
        for (std::size_t i = first; i < last; ++i) {
            if (is_finite(boxes[i])) {
                part.box = united(part.box, boxes[i]);
            } else {
                ++part.unbounded;
            }
        }
        parts[number] = part;
    });
    Part all;
    for (const Part& part : parts) all = {united(all.box, part.box), all.unbounded + part.unbounded};
    if (!is_empty(all.box)) {
        space.center = narrow(0.5L * (wide(all.box.low) + wide(all.box.high)));
        space.radius = 0.5 * diagonal(all.box);
    }
    return all.unbounded;
}

}  // namespace

NumberedSpace space_of(const std::vector<Box>& boxes) {
    NumberedSpace result;
    auto& [space, order] = result;
    const std::size_t unbounded = set_sphere(boxes, space);
    space.unbounded_count = static_cast<std::uint32_t>(unbounded);
    std::vector<std::uint32_t> bounded;
    if (unbounded > 0)
        for (std::uint32_t i = 0; i < boxes.size(); ++i) (is_finite(boxes[i]) ? bounded : order).push_back(i);
    Hierarchy hierarchy = build_bvh(
        boxes.size() - unbounded, [&](std::size_t i) { return boxes[unbounded > 0 ? bounded[i] : i]; }, space.center,
        space.radius, space.unbounded_count);
    space.nodes = std::move(hierarchy.nodes);
    if (unbounded == 0) {
        order = std::move(hierarchy.order);
    } else {
        for (const std::uint32_t i : hierarchy.order) order.push_back(bounded[i]);
    }
    return result;
}

}  // namespace csgrt
