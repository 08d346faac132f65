// Top down: each range of boxes is cut where the surface area heuristic finds it cheapest, among the borders of bins;
// a few boxes are put in order and cut anywhere. Boxes are moved, not pointed at, so that all passes are in sequence.
// Ranges of many boxes go to a common queue, the others are done in one piece; which of the two a range is depends on
// its size alone, so the result does not depend on the number of threads.
#include "compile/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "compile/linear.hpp"
#include "parallel.hpp"

namespace csgrt {

namespace {

constexpr std::size_t bins = 16;
constexpr std::size_t few = 8;  // boxes that are cut anywhere
constexpr std::size_t most_in_leaf = 4;
constexpr std::size_t task_size = 16'384;             // boxes that are done in one piece
constexpr double cost_of_box = 1, cost_of_solid = 12;  // a solid takes some twelve times as long as a box
constexpr std::uint32_t none = 0xffffffff;

/// Four, so that a compiler makes one instruction of them. The last one of `low` and `high` is the box's number, in two
/// parts that a float holds exactly; what the arithmetic of boxes makes of them means nothing.
struct alignas(16) Quad {
    float v[4];
};
constexpr std::uint32_t part_of_number = 1u << 14;

struct FloatBox {
    Quad low, high;
};
constexpr float largest = std::numeric_limits<float>::max();
constexpr FloatBox nothing{{{largest, largest, largest, largest}}, {{-largest, -largest, -largest, -largest}}};

void unite(FloatBox& to, const FloatBox& box) {
    for (int i = 0; i < 4; ++i) to.low.v[i] = box.low.v[i] < to.low.v[i] ? box.low.v[i] : to.low.v[i];
    for (int i = 0; i < 4; ++i) to.high.v[i] = box.high.v[i] > to.high.v[i] ? box.high.v[i] : to.high.v[i];
}
Quad middle(const FloatBox& box) {
    Quad m;
    for (int i = 0; i < 4; ++i) m.v[i] = 0.5f * box.low.v[i] + 0.5f * box.high.v[i];
    return m;
}
void extend(FloatBox& to, const Quad& p) { unite(to, {p, p}); }

double half_area(const FloatBox& box) {
    const auto size = [&](int i) { return static_cast<double>(box.high.v[i]) - static_cast<double>(box.low.v[i]); };
    const double x = size(0), y = size(1), z = size(2);
    return x * y + y * z + z * x;
}

std::uint32_t number_of(const FloatBox& box) {
    return static_cast<std::uint32_t>(box.low.v[3]) + part_of_number * static_cast<std::uint32_t>(box.high.v[3]);
}

float below(double value) {
    const float f = static_cast<float>(std::clamp<double>(value, -largest, largest));
    return f <= value ? f : std::nextafter(f, -largest);
}
float above(double value) {
    const float f = static_cast<float>(std::clamp<double>(value, -largest, largest));
    return f >= value ? f : std::nextafter(f, largest);
}

struct Range {
    std::size_t first, last;
    FloatBox box, middles;  ///< around the boxes and around their middles
    std::size_t size() const { return last - first; }
};

/// Which bin the middle of a box falls in, on three axes. Axes along which all middles lie in one place have one bin.
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
    static constexpr float quarter = 0.25f;  // lest the difference of two large numbers be infinite
    Quad low_, per_length_;
};

/// Boxes whose middle along `axis` falls in a bin below `bin` go left. axis < 0: there is no cut.
struct Cut {
    int axis = -1;
    std::size_t bin = 0;
    double cost = infinity;  ///< of both sides: half the area times the number of boxes
};

/// A hierarchy over some of the boxes; `skip` counts from its first node.
using Nodes = std::vector<kernel::BvhNode>;
using BoxOf = std::function<Box(std::size_t)>;

class Builder {
public:
    Builder(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius, std::uint32_t first_solid,
            unsigned threads);
    Hierarchy build();

private:
    /// A range of many boxes, and what became of it.
    struct Task {
        Range range;
        std::uint32_t left = none, right = none;  ///< tasks; none: `nodes` holds it all
        Nodes nodes;
    };

    Cut best_cut(const Range& range, const Bins& bin_of) const;
    Cut best_cut_of_few(const Range& range);
    bool split(const Range& range, Range& left, Range& right);
    std::size_t part(const Range& range, const Cut& cut, const Bins& bin_of, Range& left, Range& right);
    void measure(Range& range) const;
    kernel::BvhNode node(const Range& range) const;
    Nodes in_one_piece(const Range& whole);
    void work();
    void join(std::uint32_t task, Nodes& nodes);

    std::vector<FloatBox> boxes_;
    std::uint32_t first_solid_;
    unsigned threads_;
    std::deque<Task> tasks_;
    std::vector<std::uint32_t> waiting_;
    std::size_t unfinished_ = 0;
    std::exception_ptr thrown_;
    std::mutex mutex_;
    std::condition_variable changed_;
};

Builder::Builder(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius, std::uint32_t first_solid,
                 unsigned threads)
    : boxes_(count), first_solid_(first_solid), threads_(thread_count(threads)) {
    const double pad = bvh_padding * radius;
    for_chunks(count, task_size, threads_, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const Box b = box_of(i);
            boxes_[i].low = {{below(b.low.x - center.x - pad), below(b.low.y - center.y - pad),
                              below(b.low.z - center.z - pad), static_cast<float>(i % part_of_number)}};
            boxes_[i].high = {{above(b.high.x - center.x + pad), above(b.high.y - center.y + pad),
                               above(b.high.z - center.z + pad), static_cast<float>(i / part_of_number)}};
        }
    });
}

void Builder::measure(Range& range) const {
    range.box = range.middles = nothing;
    for (std::size_t i = range.first; i < range.last; ++i) {
        unite(range.box, boxes_[i]);
        extend(range.middles, middle(boxes_[i]));
    }
}

kernel::BvhNode Builder::node(const Range& range) const {
    kernel::BvhNode result{};
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] = range.box.low.v[axis];
        result.high[axis] = range.box.high.v[axis];
    }
    return result;
}

Cut Builder::best_cut(const Range& range, const Bins& bin_of) const {
    struct Bin {
        FloatBox box = nothing;
        std::size_t count = 0;
    };
    std::array<std::array<Bin, bins>, 3> all;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const FloatBox& box = boxes_[i];
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
        for (std::size_t bin = 1; bin < bins; ++bin) {
            unite(box, binned[bin - 1].box);
            count += binned[bin - 1].count;
            left_cost[bin] = count > 0 ? half_area(box) * static_cast<double>(count) : 0;
        }
        box = nothing;
        count = 0;
        for (std::size_t bin = bins - 1; bin > 0; --bin) {
            unite(box, binned[bin].box);
            count += binned[bin].count;
            if (count == 0 || count == range.size()) continue;
            const double cost = left_cost[bin] + half_area(box) * static_cast<double>(count);
            if (cost < best.cost) best = {axis, bin, cost};
        }
    }
    return best;
}

/// Moves the boxes that go left to the front and looks at both sides on the way.
std::size_t Builder::part(const Range& range, const Cut& cut, const Bins& bin_of, Range& left, Range& right) {
    left.box = left.middles = right.box = right.middles = nothing;
    std::size_t first = range.first, last = range.last;
    for (;;) {
        Quad at;
        while (first < last && bin_of(at = middle(boxes_[first]), cut.axis) < cut.bin) {
            unite(left.box, boxes_[first++]);
            extend(left.middles, at);
        }
        while (first < last && bin_of(at = middle(boxes_[last - 1]), cut.axis) >= cut.bin) {
            unite(right.box, boxes_[--last]);
            extend(right.middles, at);
        }
        if (first == last) return first;
        std::swap(boxes_[first], boxes_[last - 1]);
    }
}

/// Leaves the boxes in the order of the best axis; `bin` is how many go left.
Cut Builder::best_cut_of_few(const Range& range) {
    std::array<FloatBox, few> ordered;
    std::array<FloatBox, few> best_order;
    const std::size_t count = range.size();
    const auto begin = boxes_.begin() + static_cast<std::ptrdiff_t>(range.first);
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
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

/// False: the range is a leaf.
bool Builder::split(const Range& range, Range& left, Range& right) {
    if (range.size() == 1) return false;
    const bool is_few = range.size() <= few;
    const Bins bin_of(range.middles);
    const Cut cut = is_few ? best_cut_of_few(range) : best_cut(range, bin_of);
    const double area = half_area(range.box);
    const double cost_of_leaf = cost_of_solid * static_cast<double>(range.size()) * area;
    const bool worth = cut.axis >= 0 && 2 * cost_of_box * area + cost_of_solid * cut.cost < cost_of_leaf;
    if (!worth && range.size() <= most_in_leaf) return false;
    if (cut.axis >= 0 && !is_few) {
        left.last = right.first = part(range, cut, bin_of, left, right);
        left.first = range.first;
        right.last = range.last;
        return true;
    }
    left.first = range.first;
    left.last = right.first =
        range.first + (cut.axis >= 0 ? cut.bin : range.size() / 2);  // all in one place: in the middle
    right.last = range.last;
    measure(left);
    measure(right);
    return true;
}

/// Depth-first order: a node comes before its children, the left one right after it.
Nodes Builder::in_one_piece(const Range& whole) {
    struct Open {
        Range range;
        std::uint32_t parent;  // of a right child, which must be told where it begins
    };
    Nodes nodes;
    std::vector<std::uint32_t> right;  // of each node; none: a leaf
    std::vector<Open> open{{whole, none}};
    while (!open.empty()) {
        const auto [range, parent] = open.back();
        open.pop_back();
        const auto number = static_cast<std::uint32_t>(nodes.size());
        if (parent != none) right[parent] = number;
        right.push_back(none);
        nodes.push_back(node(range));
        Open second{{}, number}, first{{}, none};
        if (split(range, first.range, second.range)) {
            open.push_back(second);
            open.push_back(first);
        } else {
            nodes.back().leaf = (first_solid_ + static_cast<std::uint32_t>(range.first)) << BVH_LEAF_SHIFT |
                                static_cast<std::uint32_t>(range.size());
        }
    }
    nodes[0].skip = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (right[i] == none) continue;
        nodes[i + 1].skip = right[i];
        nodes[right[i]].skip = nodes[i].skip;
    }
    return nodes;
}

/// Takes tasks from the queue until there are none and no other thread may bring more.
void Builder::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return !waiting_.empty() || unfinished_ == 0; });
        if (waiting_.empty()) return;
        Task& task = tasks_[waiting_.back()];
        waiting_.pop_back();
        lock.unlock();
        Task left, right;
        const bool large = task.range.size() > task_size;
        std::exception_ptr thrown;
        try {
            if (large) {
                split(task.range, left.range, right.range);
            } else {
                task.nodes = in_one_piece(task.range);
            }
        } catch (...) {
            thrown = std::current_exception();  // out of memory
        }
        lock.lock();
        if (thrown) {
            thrown_ = thrown;
            waiting_.clear();
        }
        if (thrown_) {
            unfinished_ = 0;
            changed_.notify_all();
            return;
        }
        if (large) {
            for (Task* child : {&left, &right}) {
                (child == &left ? task.left : task.right) = static_cast<std::uint32_t>(tasks_.size());
                waiting_.push_back(static_cast<std::uint32_t>(tasks_.size()));
                tasks_.push_back(std::move(*child));
            }
            unfinished_ += 2;
        }
        if (--unfinished_ == 0 || large) changed_.notify_all();
    }
}

void Builder::join(std::uint32_t number, Nodes& nodes) {
    struct Open {
        std::uint32_t task;
        std::uint32_t close;  // the node whose subtree ends here, if no task
    };
    std::vector<Open> open{{number, none}};
    while (!open.empty()) {
        const auto [task_number, close] = open.back();
        open.pop_back();
        const auto first = static_cast<std::uint32_t>(nodes.size());
        if (task_number == none) {
            nodes[close].skip = first;
            continue;
        }
        Task& task = tasks_[task_number];
        if (task.left == none) {
            if (nodes.empty()) {
                nodes = std::move(task.nodes);  // all of it
                continue;
            }
            nodes.insert(nodes.end(), task.nodes.begin(), task.nodes.end());
            for (std::size_t i = first; i < nodes.size(); ++i) nodes[i].skip += first;
            continue;
        }
        nodes.push_back(node(task.range));
        open.push_back({none, first});
        open.push_back({task.right, none});
        open.push_back({task.left, none});
    }
}

Hierarchy Builder::build() {
    Hierarchy result;
    if (boxes_.empty()) return result;
    Range all{0, boxes_.size(), {}, {}};
    measure(all);
    tasks_.push_back({all, none, none, {}});
    waiting_.push_back(0);
    unfinished_ = 1;
    on_threads(boxes_.size() > task_size ? threads_ : 1, [this] { work(); });
    if (thrown_) std::rethrow_exception(thrown_);
    std::size_t count = 0;
    for (const Task& task : tasks_) count += 1 + task.nodes.size();
    result.nodes.reserve(count);
    join(0, result.nodes);
    result.order.reserve(boxes_.size());
    for (const FloatBox& box : boxes_) result.order.push_back(number_of(box));
    return result;
}

}  // namespace

Hierarchy build_bvh(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius,
                    std::uint32_t first_solid, unsigned threads) {
    return Builder(count, box_of, center, radius, first_solid, threads).build();
}

}  // namespace csgrt
