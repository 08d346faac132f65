#include "compile/regions/status_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "compile/regions/linearize.hpp"

namespace csgrt {
namespace kernel {
#include "../kernels/boolean/status_tree.h"
}  // namespace kernel

namespace {

/// The builder makes the status trees of all regions. Each tree is cut into paths by the sizes of its subtrees, and
/// each path becomes a balanced tree of clusters.
class Builder {
public:
    explicit Builder(const CompiledScene& scene) : scene_(scene) {}

    StatusTree build() {
        for (std::uint32_t region = 0; region < scene_.regions.size(); ++region)
            if (scene_.claims.empty() || scene_.claims[region]) add_region(region);
        list_leaves();
        find_outside();
        return std::move(result_);
    }

private:
    /// An item of a path: the leaf at the path's end, or the smaller operand of an operator and the operator's effect
    /// (RAKE_x) on the path.
    struct Item {
        std::uint32_t node, rake;
    };
    /// A subtree, which is another path with `cluster` as its root. `rake`: the effect of the subtree's value on the
    /// parent.
    struct Subtree {
        std::uint32_t node, cluster, rake;
    };
    /// Neighbouring items of a path: [first, end). `cluster` composes these items.
    struct Range {
        std::size_t first, end;
        std::uint32_t cluster, rake;
    };
    struct Leaf {
        std::uint32_t solid, cluster, rake;
    };

    std::uint32_t op(std::uint32_t node) const { return scene_.trees[node] >> TREE_SHIFT; }
    std::uint32_t low_bits(std::uint32_t node) const { return scene_.trees[node] & TREE_MASK; }
    std::uint32_t& size(std::uint32_t node) { return sizes_[node - first_word_]; }

    std::uint32_t add_pair(std::uint32_t link) {
        result_.links.push_back(link);
        check_tree_words(2 * result_.links.size());
        return 2 * static_cast<std::uint32_t>(result_.links.size() - 1);
    }

    void add_region(std::uint32_t region) {
        const RegionWords& record = scene_.regions[region];
        if (record.word_count == 0) return;
        first_word_ = record.first_word;
        sizes_.resize(record.word_count);
        for (std::uint32_t node = first_word_ + record.word_count; node-- > first_word_;)
            size(node) = op(node) == OP_LEAF ? 1 : size(node + 1) + size(low_bits(node));
        subtrees_.push_back({first_word_, add_pair(REGION_LINK << TREE_SHIFT | region), RAKE_NONE});
        while (!subtrees_.empty()) {
            const Subtree subtree = subtrees_.back();
            subtrees_.pop_back();
            add_path(subtree);
        }
    }

    void add_path(const Subtree& path) {
        items_.clear();
        weights_.assign(1, 0);
        std::uint32_t node = path.node;
        while (op(node) != OP_LEAF) {
            const std::uint32_t left = node + 1, right = low_bits(node);
            const bool goes_right = size(right) > size(left);
            items_.push_back({goes_right ? left : right, rake_of(op(node), goes_right)});
            weights_.push_back(weights_.back() + size(items_.back().node));
            node = goes_right ? right : left;
        }
        items_.push_back({node, RAKE_NONE});
        weights_.push_back(weights_.back() + 1);
        ranges_.push_back({0, items_.size(), path.cluster, path.rake});
        while (!ranges_.empty()) {
            const Range range = ranges_.back();
            ranges_.pop_back();
            if (range.end - range.first > 1)
                split(range);
            else if (range.end == items_.size())
                leaves_.push_back({low_bits(node), range.cluster, range.rake});
            else
                subtrees_.push_back({items_[range.first].node, range.cluster, items_[range.first].rake});
        }
    }

    /// Splits a range where both halves weigh nearly the same.
    void split(const Range& range) {
        const auto weight = [&](std::size_t i) { return weights_[i] - weights_[range.first]; };
        const auto total = weight(range.end);
        // The first position with half of the weight before it is searched.
        std::size_t low = range.first + 1, high = range.end - 1;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (2 * weight(middle) < total)
                low = middle + 1;
            else
                high = middle;
        }
        if (low > range.first + 1 && total - 2 * weight(low - 1) < 2 * weight(low) - total) --low;
        const std::uint32_t pair = add_pair(range.rake << TREE_SHIFT | range.cluster);
        ranges_.push_back({low, range.end, pair + 1, RAKE_NONE});
        ranges_.push_back({range.first, low, pair, RAKE_NONE});
    }

    /// The rake of an operator. `goes_right`: the path goes to the right operand, so the left operand is raked in.
    static std::uint32_t rake_of(std::uint32_t op, bool goes_right) {
        if (op == OP_UNION) return RAKE_UNION;
        if (op == OP_INTERSECTION) return RAKE_COMMON;
        if (op == OP_XOR) return RAKE_XOR;
        return (op == OP_DIFFERENCE) == goes_right ? RAKE_MINUEND : RAKE_REMOVED;
    }

    void list_leaves() {
        result_.first_leaves.assign(scene_.solids.size() + 1, 0);
        for (const Leaf& leaf : leaves_) ++result_.first_leaves[leaf.solid + 1];
        for (std::size_t i = 0; i < scene_.solids.size(); ++i) result_.first_leaves[i + 1] += result_.first_leaves[i];
        std::vector<std::uint32_t> next(result_.first_leaves.begin(), result_.first_leaves.end() - 1);
        result_.leaves.resize(leaves_.size());
        for (const Leaf& leaf : leaves_)
            result_.leaves[next[leaf.solid]++] =
                leaf.cluster << 2 | (kernel::raked(leaf.rake, 0) ^ kernel::raked(leaf.rake, 3));
    }

    /// Computes the functions where no solid covers. The loop goes from the last pair to the first, because a parent is
    /// in an earlier pair.
    void find_outside() {
        auto& outside = result_.outside;
        outside.assign((2 * result_.links.size() + 15) / 16, 0);
        const auto set = [&](std::uint32_t cluster, std::uint32_t rake, std::uint32_t f) {
            outside[cluster >> 4] |= kernel::raked(rake, f) << 2 * (cluster & 15u);
        };
        for (const Leaf& leaf : leaves_) set(leaf.cluster, leaf.rake, 0);
        for (std::size_t pair = result_.links.size(); pair-- > 0;) {
            const std::uint32_t link = result_.links[pair], upper = 2 * static_cast<std::uint32_t>(pair);
            if (link >> TREE_SHIFT == REGION_LINK) continue;
            set(link & TREE_MASK, link >> TREE_SHIFT,
                kernel::composed(kernel::function_of(outside.data(), upper),
                                 kernel::function_of(outside.data(), upper + 1)));
        }
    }

    const CompiledScene& scene_;
    StatusTree result_;
    std::uint32_t first_word_ = 0;
    std::vector<std::uint32_t> sizes_;  ///< leaves below each node of the region's tree
    std::vector<Subtree> subtrees_;
    std::vector<Item> items_;
    std::vector<std::uint64_t> weights_;  ///< of the path's items before each item
    std::vector<Range> ranges_;
    std::vector<Leaf> leaves_;
};

}  // namespace

StatusTree make_status_tree(const CompiledScene& scene) { return Builder(scene).build(); }

}  // namespace csgrt
