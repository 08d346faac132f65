#include "compile/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compile/linear.hpp"

namespace csgrt {

namespace {

constexpr std::size_t bins = 16;
constexpr std::size_t most_in_leaf = 4;
constexpr double cost_of_box = 1, cost_of_solid = 3;  // a solid takes about three times as long as a box

double half_area(const Box& box) {
    if (is_empty(box)) return 0;
    const double x = box.high.x - box.low.x, y = box.high.y - box.low.y, z = box.high.z - box.low.z;
    return x * y + y * z + z * x;
}

double coordinate(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Where to cut: boxes whose middle along `axis` falls in a bin below `bin` go left. axis < 0: do not cut.
struct Cut {
    int axis = -1;
    std::size_t bin = 0;
    double cost = infinity;
};

class Builder {
public:
    Builder(const std::vector<Box>& boxes, const Vec3& center, double radius)
        : boxes_(boxes), center_(center), radius_(radius) {
        middles_.reserve(boxes.size());
        for (const Box& box : boxes)
            middles_.push_back({0.5 * box.low.x + 0.5 * box.high.x, 0.5 * box.low.y + 0.5 * box.high.y,
                                0.5 * box.low.z + 0.5 * box.high.z});
    }

    Hierarchy build(std::uint32_t first_solid);

private:
    struct Range {
        std::size_t first, last;
        std::uint32_t parent;  // of a right child, which must be told where it begins
        std::size_t size() const { return last - first; }
    };

    Box around(const Range& range) const;
    Box middles(const Range& range) const;
    std::size_t bin_of(std::uint32_t box, int axis, const Box& span) const;
    Cut best_cut(const Range& range, const Box& span) const;
    std::size_t split(const Range& range, const Box& box);
    kernel::BvhNode node(const Box& box) const;

    const std::vector<Box>& boxes_;
    Vec3 center_;
    double radius_;
    std::vector<Vec3> middles_;
    std::vector<std::uint32_t> order_;
};

Box Builder::around(const Range& range) const {
    Box box = empty_box;
    for (std::size_t i = range.first; i < range.last; ++i) box = united(box, boxes_[order_[i]]);
    return box;
}

Box Builder::middles(const Range& range) const {
    Box box = empty_box;
    for (std::size_t i = range.first; i < range.last; ++i) extend(box, middles_[order_[i]]);
    return box;
}

std::size_t Builder::bin_of(std::uint32_t box, int axis, const Box& span) const {
    const double low = coordinate(span.low, axis), high = coordinate(span.high, axis);
    const double place = (coordinate(middles_[box], axis) - low) / (high - low);
    return std::min(static_cast<std::size_t>(place * bins), bins - 1);
}

Cut Builder::best_cut(const Range& range, const Box& span) const {
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(coordinate(span.high, axis) > coordinate(span.low, axis))) continue;
        std::array<Box, bins> boxes;
        std::array<std::size_t, bins> counts{};
        boxes.fill(empty_box);
        for (std::size_t i = range.first; i < range.last; ++i) {
            const std::size_t bin = bin_of(order_[i], axis, span);
            boxes[bin] = united(boxes[bin], boxes_[order_[i]]);
            ++counts[bin];
        }
        std::array<double, bins> left_cost{};
        Box box = empty_box;
        std::size_t count = 0;
        for (std::size_t bin = 1; bin < bins; ++bin) {
            box = united(box, boxes[bin - 1]);
            count += counts[bin - 1];
            left_cost[bin] = half_area(box) * static_cast<double>(count);
        }
        box = empty_box;
        count = 0;
        for (std::size_t bin = bins - 1; bin > 0; --bin) {
            box = united(box, boxes[bin]);
            count += counts[bin];
            if (count == 0 || count == range.size()) continue;
            const double cost = left_cost[bin] + half_area(box) * static_cast<double>(count);
            if (cost < best.cost) best = {axis, bin, cost};
        }
    }
    return best;
}

/// Orders the range and returns where its right part begins; range.last: it is a leaf.
std::size_t Builder::split(const Range& range, const Box& box) {
    if (range.size() == 1) return range.last;
    const Box span = middles(range);
    const Cut cut = best_cut(range, span);
    const double area = half_area(box);
    const double cost_of_leaf = cost_of_solid * static_cast<double>(range.size()) * area;
    const bool worth = cut.axis >= 0 && 2 * cost_of_box * area + cost_of_solid * cut.cost < cost_of_leaf;
    if (!worth && range.size() <= most_in_leaf) return range.last;
    const auto begin = order_.begin();
    const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    if (cut.axis >= 0) {
        const auto middle = std::stable_partition(at(range.first), at(range.last),
                                                  [&](std::uint32_t i) { return bin_of(i, cut.axis, span) < cut.bin; });
        return static_cast<std::size_t>(middle - begin);
    }
    return range.first + range.size() / 2;  // all in one place
}

float below(double value) {
    const float f = static_cast<float>(value);
    return f <= value ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
float above(double value) {
    const float f = static_cast<float>(value);
    return f >= value ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

kernel::BvhNode Builder::node(const Box& box) const {
    const double pad = bvh_padding * radius_;
    kernel::BvhNode result{};
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] = below(coordinate(box.low, axis) - coordinate(center_, axis) - pad);
        result.high[axis] = above(coordinate(box.high, axis) - coordinate(center_, axis) + pad);
    }
    return result;
}

Hierarchy Builder::build(std::uint32_t first_solid) {
    constexpr std::uint32_t none = 0xffffffff;
    Hierarchy result;
    order_.resize(boxes_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);

    std::vector<std::uint32_t> right;  // of each node; none: a leaf
    std::vector<Range> ranges;
    if (!boxes_.empty()) ranges.push_back({0, boxes_.size(), none});
    while (!ranges.empty()) {
        const Range range = ranges.back();
        ranges.pop_back();
        const auto number = static_cast<std::uint32_t>(result.nodes.size());
        if (range.parent != none) right[range.parent] = number;
        right.push_back(none);
        const Box box = around(range);
        result.nodes.push_back(node(box));
        const std::size_t middle = split(range, box);
        if (middle == range.last) {
            result.nodes[number].leaf = (first_solid + static_cast<std::uint32_t>(range.first)) << BVH_LEAF_SHIFT |
                                        static_cast<std::uint32_t>(range.size());
        } else {
            ranges.push_back({middle, range.last, number});
            ranges.push_back({range.first, middle, none});
        }
    }
    // Depth-first order: a node comes before its children, the left one right after it.
    if (!result.nodes.empty()) result.nodes[0].skip = static_cast<std::uint32_t>(result.nodes.size());
    for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        if (right[i] == none) continue;
        result.nodes[i + 1].skip = right[i];
        result.nodes[right[i]].skip = result.nodes[i].skip;
    }
    result.order = std::move(order_);
    return result;
}

}  // namespace

Hierarchy build_bvh(const std::vector<Box>& boxes, const Vec3& center, double radius, std::uint32_t first_solid) {
    return Builder(boxes, center, radius).build(first_solid);
}

}  // namespace csgrt
