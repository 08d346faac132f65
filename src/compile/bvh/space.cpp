#include "compile/bvh/space.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "compile/bvh/build.hpp"
#include "compile/linear.hpp"

namespace csgrt {

bool set_sphere(const std::vector<Box>& boxes, Space& space) {
    struct BoxPart {
        Box box = empty_box;
        bool is_bounded = true;
    };
    constexpr std::size_t many = 16'384;
    std::vector<BoxPart> parts((boxes.size() + many - 1) / many);
    for_chunks(boxes.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        BoxPart part;
        for (std::size_t i = first; i < last; ++i) {
            if (is_finite(boxes[i])) {
                part.box = united(part.box, boxes[i]);
            } else {
                part.is_bounded = false;
            }
        }
        parts[number] = part;
    });
    BoxPart all;
    for (const BoxPart& part : parts) all = {united(all.box, part.box), all.is_bounded && part.is_bounded};
    if (!is_empty(all.box)) {
        space.center = narrow(0.5L * (wide(all.box.low) + wide(all.box.high)));
        space.radius = 0.5 * diagonal(all.box);
    }
    return all.is_bounded;
}

namespace {

using Nodes = std::vector<kernel::BvhNode>;

void set_box(kernel::BvhNode& node, const kernel::BvhNode& a, const kernel::BvhNode& b) {
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis] = std::min(a.low[axis], b.low[axis]);
        node.high[axis] = std::max(a.high[axis], b.high[axis]);
    }
}

/// The hierarchy without the leaves that have no wanted solid. `first`: the number of the first solid.
Nodes pruned(Nodes nodes, std::uint32_t first, const std::vector<bool>& wanted) {
    std::vector<std::uint32_t> sizes(nodes.size());  // nodes that are kept of each subtree
    for (std::size_t i = nodes.size(); i-- > 0;) {
        kernel::BvhNode& node = nodes[i];
        if (node.leaf) {
            std::uint32_t begin = (node.leaf >> BVH_LEAF_SHIFT) - first, end = begin + (node.leaf & BVH_LEAF_MASK);
            while (begin < end && !wanted[begin]) ++begin;
            while (begin < end && !wanted[end - 1]) --end;
            node.leaf = (first + begin) << BVH_LEAF_SHIFT | (end - begin);
            sizes[i] = begin < end;
            continue;
        }
        const std::size_t left = i + 1, right = nodes[left].skip;
        sizes[i] = sizes[left] + sizes[right] + (sizes[left] > 0 && sizes[right] > 0);
        if (sizes[left] == 0 || sizes[right] == 0) {  // the other child replaces the node
            const kernel::BvhNode& other = nodes[sizes[left] > 0 ? left : right];
            set_box(node, other, other);
        } else {
            set_box(node, nodes[left], nodes[right]);
        }
    }
    Nodes kept;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool is_leaf = nodes[i].leaf != 0;
        if (sizes[i] == 0 || (!is_leaf && (sizes[i + 1] == 0 || sizes[nodes[i + 1].skip] == 0))) continue;
        kept.push_back(nodes[i]);
        kept.back().skip = static_cast<std::uint32_t>(kept.size() - 1) + sizes[i];
    }
    return kept;
}

/// Two hierarchies under one new root.
Nodes joined(const Nodes& left, const Nodes& right) {
    if (left.empty()) return right;
    if (right.empty()) return left;
    kernel::BvhNode root{};
    set_box(root, left.front(), right.front());
    Nodes nodes{root};
    for (const Nodes* part : {&left, &right}) {
        const auto before = static_cast<std::uint32_t>(nodes.size());
        for (const kernel::BvhNode& node : *part) {
            nodes.push_back(node);
            nodes.back().skip += before;
        }
    }
    nodes.front().skip = static_cast<std::uint32_t>(nodes.size());
    return nodes;
}

}  // namespace

NumberedSpace space_of(const std::vector<Box>& boxes, const std::vector<Box>& ray_boxes,
                       const EarlierHierarchy* earlier) {
    NumberedSpace result;
    auto& [space, order] = result;
    const auto hierarchy_of = [&, &space = space](std::size_t count, const auto& box_of, std::uint32_t first) {
        return build_bvh(count, box_of, space.center, space.radius, first);
    };
    if (set_sphere(boxes, space)) {
        Hierarchy hierarchy = build_bvh(
            boxes.size(), [&](std::size_t i) { return boxes[i]; }, space.center, space.radius, 0, 0, earlier);
        space.nodes = std::move(hierarchy.nodes);
        order = std::move(hierarchy.order);
        return result;
    }
    std::vector<std::uint32_t> bounded, ending, nowhere;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        (is_finite(boxes[i])       ? bounded
         : is_empty(ray_boxes[i])  ? nowhere
         : is_finite(ray_boxes[i]) ? ending
                                   : order)
            .push_back(i);
    space.unbounded_count = static_cast<std::uint32_t>(order.size());
    const Hierarchy of_ending = hierarchy_of(
        ending.size(), [&](std::size_t i) { return ray_boxes[ending[i]]; }, space.unbounded_count);
    for (const std::uint32_t i : of_ending.order) order.push_back(ending[i]);
    order.insert(order.end(), nowhere.begin(), nowhere.end());
    const auto first = static_cast<std::uint32_t>(order.size());
    Hierarchy of_bounded = hierarchy_of(
        bounded.size(), [&](std::size_t i) { return boxes[bounded[i]]; }, first);
    std::vector<bool> wanted;
    for (const std::uint32_t i : of_bounded.order) {
        order.push_back(bounded[i]);
        wanted.push_back(!is_empty(ray_boxes[bounded[i]]));
    }
    space.nodes = joined(of_ending.nodes, pruned(std::move(of_bounded.nodes), first, wanted));
    return result;
}

std::uint32_t starting_node(const std::vector<kernel::BvhNode>& nodes, const std::vector<kernel::SolidRecord>& solids) {
    const auto starts = [&](const kernel::BvhNode& node) {
        const auto first = solids.begin() + (node.leaf >> BVH_LEAF_SHIFT);
        return std::any_of(first, first + (node.leaf & BVH_LEAF_MASK), [](const auto& s) { return s.start_count > 0; });
    };
    return static_cast<std::uint32_t>(std::find_if(nodes.begin(), nodes.end(), starts) - nodes.begin());
}

std::vector<bool> met_solids(const Space& space, std::size_t solids) {
    std::vector<bool> met(solids);
    const auto add = [&](std::uint32_t first, std::uint32_t count) { std::fill_n(met.begin() + first, count, true); };
    add(0, space.unbounded_count);
    for (const kernel::BvhNode& node : space.nodes) add(node.leaf >> BVH_LEAF_SHIFT, node.leaf & BVH_LEAF_MASK);
    return met;
}

}  // namespace csgrt
