// Top down, each range of boxes cut in two (bvh_split.hpp). Ranges of many boxes go to a common queue, the others are done in
// one piece; which of the two a range is depends on its size alone, so the result does not depend on the number of threads.
#include "compile/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "compile/bvh_split.hpp"
#include "compile/linear.hpp"
#include "parallel.hpp"

namespace csgrt {
namespace {

using namespace bvh;

constexpr std::size_t task_size = 16'384;  // boxes that are done in one piece
constexpr std::uint32_t none = 0xffffffff;
constexpr std::uint32_t part_of_number = 1u << 14;

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

kernel::BvhNode Builder::node(const Range& range) const {
    kernel::BvhNode result{};
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] = range.box.low.v[axis];
        result.high[axis] = range.box.high.v[axis];
    }
    return result;
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
        if (split(boxes_, range, first.range, second.range)) {
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
                split(boxes_, task.range, left.range, right.range);
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
    measure(boxes_, all);
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
