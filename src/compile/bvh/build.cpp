// The hierarchy is built from the top down: each range of boxes is cut in two (split.hpp). The halves of a large range
// are put into a common queue; a smaller range is built by one task. Only the size of a range decides this, so the
// result does not depend on the number of threads.
#include "compile/bvh/build.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "compile/bvh/split.hpp"
#include "compile/linear.hpp"
#include "base/parallel.hpp"

namespace csgrt {
namespace {

using namespace bvh;

constexpr std::size_t task_size = 16'384;  // boxes of a range that one task builds whole
constexpr std::uint32_t none = 0xffffffff;
constexpr std::uint32_t part_of_number = 1u << 14;

void set_number(FloatBox& box, std::size_t number) {
    box.low.v[3] = static_cast<float>(number % part_of_number);
    box.high.v[3] = static_cast<float>(number / part_of_number);
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

using BoxOf = std::function<Box(std::size_t)>;

/// The subtrees of an earlier hierarchy, by their boxes.
class Earlier {
public:
    explicit Earlier(const EarlierHierarchy& hierarchy)
        : hierarchy_(hierarchy),
          places_(hierarchy.order.size()),
          first_nodes_(hierarchy.order.size(), none),
          is_changed_(hierarchy.order.size()) {
        for (std::uint32_t i = 0; i < hierarchy.order.size(); ++i)
            if (hierarchy.order[i] != none) places_[hierarchy.order[i]] = i;
        for (const std::uint32_t box : hierarchy.changed) is_changed_[box] = 1;
        for (std::uint32_t i = static_cast<std::uint32_t>(nodes().size()), place = size(); i-- > 0;) {
            if (nodes()[i].leaf != 0) place = first_of(i);
            first_nodes_[place] = i;
        }
    }

    /// The node with just the boxes of a range, none of which has changed; none: there is no such node, or only few
    /// boxes, whose order depends on the others.
    std::uint32_t find(const std::vector<FloatBox>& boxes, const Range& range) const {
        if (range.size() <= few) return none;
        std::uint32_t low = none, high = 0;
        for (std::size_t i = range.first; i < range.last; ++i) {
            const std::uint32_t box = number_of(boxes[i]), place = places_[box];
            if (is_changed_[box]) return none;
            low = std::min(low, place);
            high = std::max(high, place);
        }
        if (high - low + 1 != range.size()) return none;
        // The nodes that begin at one box stand behind each other, the largest first.
        for (std::uint32_t i = first_nodes_[low]; i != none && i < nodes().size(); ++i) {
            const std::uint32_t after = nodes()[i].skip;
            const std::uint32_t end = after < nodes().size() ? first_place(after) : size();
            if (end == high + 1) return i;
            if (nodes()[i].leaf != 0) break;
        }
        return none;
    }
    const std::vector<kernel::BvhNode>& nodes() const { return hierarchy_.nodes; }
    std::uint32_t box(std::size_t place) const { return hierarchy_.order[place]; }
    /// The place of a node's first box in the order.
    std::uint32_t first_place(std::uint32_t node) const {
        while (nodes()[node].leaf == 0) ++node;
        return first_of(node);
    }

private:
    std::uint32_t size() const { return static_cast<std::uint32_t>(hierarchy_.order.size()); }
    std::uint32_t first_of(std::uint32_t leaf) const { return nodes()[leaf].leaf >> BVH_LEAF_SHIFT; }

    const EarlierHierarchy& hierarchy_;
    std::vector<std::uint32_t> places_;       ///< of each box, in the order
    std::vector<std::uint32_t> first_nodes_;  ///< by place: the largest node that begins there
    std::vector<std::uint8_t> is_changed_;
};

/// Builds the hierarchy on several threads. Tasks wait in a queue. Each task writes its nodes into its own part of the
/// result, and the gaps between the parts are closed at the end.
class Builder {
public:
    Builder(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius, std::uint32_t first_solid,
            unsigned threads, const EarlierHierarchy* earlier);
    Hierarchy build();

private:
    /// A range of many boxes, and the result of its task.
    struct Task {
        Range range;
        std::uint32_t place;  ///< index of the first node; each task has memory for all nodes that it may make
        std::uint32_t left = none, right = none;  ///< tasks; none: this task has built the whole range
        std::uint32_t nodes = 0;  ///< built by this task; their `skip` counts from the task's first node
    };

    /// The memory of a thread.
    struct Memory {
        std::vector<std::uint32_t> right;  ///< the index of each node's right child; none: a leaf
        std::vector<FloatBox> rights;      ///< see split()
    };

    kernel::BvhNode node(const Range& range) const;
    void build_whole(Task& task, Memory& memory);
    bool take_over(const Range& range, kernel::BvhNode* nodes, std::vector<std::uint32_t>& right);
    void work();
    void join();

    std::vector<FloatBox> boxes_;
    Range all_{};
    std::vector<kernel::BvhNode> nodes_;
    std::uint32_t first_solid_;
    unsigned threads_;
    std::optional<Earlier> earlier_;
    std::deque<Task> tasks_;
    std::vector<std::uint32_t> waiting_;
    std::size_t unfinished_ = 0;
    std::exception_ptr thrown_;
    std::mutex mutex_;
    std::condition_variable changed_;
};

Builder::Builder(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius, std::uint32_t first_solid,
                 unsigned threads, const EarlierHierarchy* earlier)
    : first_solid_(first_solid), threads_(thread_count(threads)) {
    if (earlier != nullptr) earlier_.emplace(*earlier);
    resize_cleared(boxes_, count);
    const double pad = bvh_padding * radius;
    std::vector<Range> ranges((count + task_size - 1) / task_size);
    for_chunks(count, task_size, threads_, [&](std::size_t first, std::size_t last, std::size_t chunk) {
        for (std::size_t i = first; i < last; ++i) {
            const Box b = box_of(i);
            boxes_[i].low = {{below(b.low.x - center.x - pad), below(b.low.y - center.y - pad),
                              below(b.low.z - center.z - pad), static_cast<float>(i % part_of_number)}};
            boxes_[i].high = {{above(b.high.x - center.x + pad), above(b.high.y - center.y + pad),
                               above(b.high.z - center.z + pad), static_cast<float>(i / part_of_number)}};
        }
        ranges[chunk] = {first, last, {}, {}};
        measure(boxes_, ranges[chunk]);
    });
    all_ = {0, count, nothing, nothing};
    for (const Range& range : ranges) {
        unite(all_.box, range.box);
        unite(all_.middles, range.middles);
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

/// Builds a range in depth-first order: a node comes before its children, and the left child is the next node.
void Builder::build_whole(Task& task, Memory& memory) {
    struct Open {
        Range range;
        std::uint32_t parent;  // the parent of a right child, which needs the child's index
    };
    kernel::BvhNode* const nodes = nodes_.data() + task.place;
    std::vector<std::uint32_t>& right = memory.right;
    right.clear();
    std::vector<Open> open{{task.range, none}};
    while (!open.empty()) {
        const auto [range, parent] = open.back();
        open.pop_back();
        const auto number = static_cast<std::uint32_t>(right.size());
        if (parent != none) right[parent] = number;
        if (earlier_ && take_over(range, nodes, right)) continue;
        right.push_back(none);
        nodes[number] = node(range);
        Open second{{}, number}, first{{}, none};
        if (split(boxes_, range, first.range, second.range, memory.rights)) {
            open.push_back(second);
            open.push_back(first);
        } else {
            nodes[number].leaf = (first_solid_ + static_cast<std::uint32_t>(range.first)) << BVH_LEAF_SHIFT |
                                 static_cast<std::uint32_t>(range.size());
        }
    }
    task.nodes = static_cast<std::uint32_t>(right.size());
    nodes[0].skip = task.nodes;
    for (std::size_t i = 0; i < right.size(); ++i) {
        if (right[i] == none) continue;
        nodes[i + 1].skip = right[i];
        nodes[right[i]].skip = nodes[i].skip;
    }
}

/// Copies the earlier subtree of a range's boxes, if there is one, and puts the boxes in its order.
bool Builder::take_over(const Range& range, kernel::BvhNode* nodes, std::vector<std::uint32_t>& right) {
    const std::uint32_t found = earlier_->find(boxes_, range);
    if (found == none) return false;
    const std::vector<kernel::BvhNode>& from = earlier_->nodes();
    const std::uint32_t place = earlier_->first_place(found), end = from[found].skip;
    const auto number = static_cast<std::uint32_t>(right.size());
    for (std::uint32_t i = found; i < end; ++i) {
        kernel::BvhNode& node = nodes[number + (i - found)] = from[i];
        if (node.leaf != 0) {
            const std::uint32_t first = earlier_->first_place(i) - place + static_cast<std::uint32_t>(range.first);
            node.leaf = (first_solid_ + first) << BVH_LEAF_SHIFT | (node.leaf & BVH_LEAF_MASK);
        }
        right.push_back(node.leaf != 0 ? none : number + (from[i + 1].skip - found));
    }
    for (std::uint32_t i = 0; i < range.size(); ++i) set_number(boxes_[range.first + i], earlier_->box(place + i));
    return true;
}

/// Takes tasks from the queue until there are none and no other thread may add more.
void Builder::work() {
    Memory memory;
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return !waiting_.empty() || unfinished_ == 0; });
        if (waiting_.empty()) return;
        Task& task = tasks_[waiting_.back()];
        waiting_.pop_back();
        lock.unlock();
        Task left, right;
        const bool large = task.range.size() > task_size && !(earlier_ && earlier_->find(boxes_, task.range) != none);
        std::exception_ptr thrown;
        try {
            if (large) {
                split(boxes_, task.range, left.range, right.range, memory.rights);
                left.place = task.place + 1;
                right.place = task.place + 2 * static_cast<std::uint32_t>(left.range.size());
            } else {
                build_whole(task, memory);
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

/// Closes the gaps between the tasks' nodes.
void Builder::join() {
    struct Open {
        std::uint32_t task;
        std::uint32_t close;  // if there is no task: the node whose subtree ends here
    };
    std::vector<Open> open{{0, none}};
    std::uint32_t first = 0;
    while (!open.empty()) {
        const auto [number, close] = open.back();
        open.pop_back();
        if (number == none) {
            nodes_[close].skip = first;
            continue;
        }
        const Task& task = tasks_[number];
        if (task.left == none) {
            for (std::uint32_t i = 0; i < task.nodes; ++i) {
                nodes_[first + i] = nodes_[task.place + i];
                nodes_[first + i].skip += first;
            }
            first += task.nodes;
            continue;
        }
        nodes_[first] = node(task.range);
        open.push_back({none, first++});
        open.push_back({task.right, none});
        open.push_back({task.left, none});
    }
    nodes_.resize(first);
}

Hierarchy Builder::build() {
    Hierarchy result;
    if (boxes_.empty()) return result;
    const std::size_t most = 2 * boxes_.size() - 1;
    resize_cleared(nodes_, most);
    tasks_.push_back({all_, 0});
    waiting_.push_back(0);
    unfinished_ = 1;
    on_threads(boxes_.size() > task_size ? threads_ : 1, [this] { work(); });
    if (thrown_) std::rethrow_exception(thrown_);
    join();
    result.nodes = std::move(nodes_);
    result.order.resize(boxes_.size());
    for_chunks(boxes_.size(), task_size, threads_, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) result.order[i] = number_of(boxes_[i]);
    });
    return result;
}

}  // namespace

Hierarchy build_bvh(std::size_t count, const BoxOf& box_of, const Vec3& center, double radius,
                    std::uint32_t first_solid, unsigned threads, const EarlierHierarchy* earlier) {
    return Builder(count, box_of, center, radius, first_solid, threads, earlier).build();
}

}  // namespace csgrt
