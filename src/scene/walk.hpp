// Walk: visits the combinations below an object, depth first, with its own stack instead of recursion.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scene/names.hpp"

namespace csgrt {

/// A walk that keeps a `Level` for each combination on its current path.
template <class Level>
class Walk {
public:
    /// A combination on the current path.
    struct Open {
        std::uint32_t object;
        std::uint32_t next;  ///< the next node of its tree
        Level level;
    };

    /// Walks below a combination. The visitor has
    ///     std::optional<Level> follow(const Open& parent, std::uint32_t node, std::uint32_t child)
    ///                                a leaf; `child` may be Names::none. No level: the walk does not go below it.
    ///     void operate(const Open& parent, std::uint32_t node)   an operator, after its operands
    ///     void nothing()             a leaf that is left out, or a combination without a tree
    ///     void leave(Open&& done)    after the last node
    template <class Visitor>
    void below(const Names& names, std::uint32_t object, Level level, Visitor& visitor) {
        open_.push_back({object, 0, std::move(level)});
        while (!open_.empty()) {
            Open& parent = open_.back();
            const std::span<const std::uint32_t> children = names.children(parent.object);
            if (parent.next == children.size()) {
                if (children.empty()) visitor.nothing();
                Open done = std::move(parent);
                open_.pop_back();
                visitor.leave(std::move(done));
                continue;
            }
            const std::uint32_t node = parent.next++, child = children[node];
            if (child == Names::operation) {
                visitor.operate(parent, node);
            } else if (child == Names::left_out) {
                visitor.nothing();
            } else if (std::optional<Level> next = visitor.follow(parent, node, child)) {
                open_.push_back({child, 0, std::move(*next)});
            }
        }
    }

    /// The combinations on the current path, from the top.
    const std::vector<Open>& open() const { return open_; }

private:
    std::vector<Open> open_;
};

}  // namespace csgrt
