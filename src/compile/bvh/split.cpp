#include "compile/bvh/split.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "compile/linear.hpp"

namespace csgrt::bvh {
namespace {

constexpr std::size_t bins = 16;
constexpr std::size_t most_in_leaf = 4;
constexpr double cost_of_box = 1, cost_of_solid = 12;  // a test of a solid takes about twelve times as long as a test
                                                       // of a box

double half_area(const FloatBox& box) {
    const auto size = [&](int i) { return static_cast<double>(box.high.v[i]) - static_cast<double>(box.low.v[i]); };
    const double x = size(0), y = size(1), z = size(2);
    return x * y + y * z + z * x;
}

/// The bins of the boxes' middles, on three axes. An axis along which all middles are equal has one bin.
class Bins {
public:
    explicit Bins(const FloatBox& middles) {
        for (int i = 0; i < 4; ++i) {
            low_.v[i] = quarter * middles.low.v[i];
            const float extent = quarter * middles.high.v[i] - low_.v[i];
            const float per_length = 0.999999f * static_cast<float>(bins) / extent;
            per_length_.v[i] = extent > 0 && per_length <= largest ? per_length : 0;
        }
    }
    std::size_t operator()(const Quad& at, int axis) const {
        return static_cast<std::size_t>(static_cast<int>((quarter * at.v[axis] - low_.v[axis]) * per_length_.v[axis]));
    }
    bool has(int axis) const { return per_length_.v[axis] > 0; }

private:
    static constexpr float quarter = 0.25f;  // keeps the difference of two large numbers finite
    Quad low_, per_length_;
};

/// A cut: boxes whose middle along `axis` is in a bin below `bin` are the left side. axis < 0: there is no cut.
struct Cut {
    int axis = -1;
    std::size_t bin = 0;
    double cost = infinity;  ///< of both sides: half the surface area times the number of boxes
};

Cut best_cut(const std::vector<FloatBox>& boxes, const Range& range, const Bins& bin_of) {
    struct Bin {
        FloatBox box = nothing;
        std::size_t count = 0;
    };
    std::array<std::array<Bin, bins>, 3> all;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const FloatBox& box = boxes[i];
        const Quad at = middle(box);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = all[static_cast<std::size_t>(axis)][bin_of(at, axis)];
            unite(bin.box, box);
            ++bin.count;
        }
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!bin_of.has(axis)) continue;
        const std::array<Bin, bins>& binned = all[static_cast<std::size_t>(axis)];
        std::array<double, bins> left_cost{};
        FloatBox box = nothing;
        std::size_t count = 0;
        // A bin without boxes does not change the sides, so the cost is the same.
        for (std::size_t bin = 1; bin < bins; ++bin) {
            left_cost[bin] = left_cost[bin - 1];
            if (binned[bin - 1].count == 0) continue;
            unite(box, binned[bin - 1].box);
            count += binned[bin - 1].count;
            left_cost[bin] = half_area(box) * static_cast<double>(count);
        }
        box = nothing;
        count = 0;
        for (std::size_t bin = bins - 1; bin > 0; --bin) {
            if (binned[bin].count == 0) continue;
            unite(box, binned[bin].box);
            count += binned[bin].count;
            if (count == range.size()) break;
            const double cost = left_cost[bin] + half_area(box) * static_cast<double>(count);
            if (cost < best.cost) best = {axis, bin, cost};
        }
    }
    return best;
}

/// Moves the boxes of the left side to the front, and measures the two sides. The boxes of a side keep their order, so
/// more than `few` boxes make the same subtree, whatever other boxes the hierarchy has.
std::size_t part(std::vector<FloatBox>& boxes, const Range& range, const Cut& cut, const Bins& bin_of, Range& left,
                 Range& right, std::vector<FloatBox>& rights) {
    left.box = left.middles = right.box = right.middles = nothing;
    if (rights.size() < range.size()) rights.resize(range.size());
    std::size_t end = range.first, count = 0;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const FloatBox box = boxes[i];
        const Quad at = middle(box);
        const bool goes_left = bin_of(at, cut.axis) < cut.bin;
        Range& side = goes_left ? left : right;
        unite(side.box, box);
        extend(side.middles, at);
        (goes_left ? boxes[end++] : rights[count++]) = box;
    }
    std::copy_n(rights.begin(), count, boxes.begin() + static_cast<std::ptrdiff_t>(end));
    return end;
}

/// Sorts the boxes along the best axis. `bin` of the result is the number of boxes on the left side.
Cut best_cut_of_few(std::vector<FloatBox>& boxes, const Range& range) {
    std::array<FloatBox, few> ordered;
    std::array<FloatBox, few> best_order;
    const std::size_t count = range.size();
    const auto begin = boxes.begin() + static_cast<std::ptrdiff_t>(range.first);
    Cut best;
    const int axes = count > 2 ? 3 : 1;  // two boxes have the same cost along every axis
    for (int axis = 0; axis < axes; ++axis) {
        std::copy_n(begin, count, ordered.begin());
        const auto at = [&](const FloatBox& box) { return 0.5f * box.low.v[axis] + 0.5f * box.high.v[axis]; };
        for (std::size_t i = 1; i < count; ++i) {
            const FloatBox box = ordered[i];
            std::size_t k = i;
            for (; k > 0 && at(box) < at(ordered[k - 1]); --k) ordered[k] = ordered[k - 1];
            ordered[k] = box;
        }
        std::array<double, few> right_cost{};
        FloatBox box = nothing;
        for (std::size_t i = count - 1; i > 0; --i) {
            unite(box, ordered[i]);
            right_cost[i] = half_area(box) * static_cast<double>(count - i);
        }
        box = nothing;
        bool better = false;
        for (std::size_t i = 1; i < count; ++i) {
            unite(box, ordered[i - 1]);
            const double cost = half_area(box) * static_cast<double>(i) + right_cost[i];
            if (cost < best.cost) {
                best = {axis, i, cost};
                better = true;
            }
        }
        if (better) best_order = ordered;
    }
    if (best.axis >= 0) std::copy_n(best_order.begin(), count, begin);
    return best;
}

}  // namespace

void measure(const std::vector<FloatBox>& boxes, Range& range) {
    range.box = range.middles = nothing;
    for (std::size_t i = range.first; i < range.last; ++i) {
        unite(range.box, boxes[i]);
        extend(range.middles, middle(boxes[i]));
    }
}

bool split(std::vector<FloatBox>& boxes, const Range& range, Range& left, Range& right, std::vector<FloatBox>& rights) {
    if (range.size() == 1) return false;
    const bool is_few = range.size() <= few;
    std::optional<Bins> bin_of;
    if (!is_few) bin_of.emplace(range.middles);
    const Cut cut = is_few ? best_cut_of_few(boxes, range) : best_cut(boxes, range, *bin_of);
    const double area = half_area(range.box);
    const double cost_of_leaf = cost_of_solid * static_cast<double>(range.size()) * area;
    const bool worth = cut.axis >= 0 && 2 * cost_of_box * area + cost_of_solid * cut.cost < cost_of_leaf;
    if (!worth && range.size() <= most_in_leaf) return false;
    if (cut.axis >= 0 && !is_few) {
        left.last = right.first = part(boxes, range, cut, *bin_of, left, right, rights);
        left.first = range.first;
        right.last = range.last;
        return true;
    }
    left.first = range.first;
    left.last = right.first =
        range.first + (cut.axis >= 0 ? cut.bin : range.size() / 2);  // all middles are equal: the cut is in the middle
    right.last = range.last;
    measure(boxes, left);
    measure(boxes, right);
    return true;
}

}  // namespace csgrt::bvh
