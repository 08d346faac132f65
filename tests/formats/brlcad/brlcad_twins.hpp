// Compares two readings of one model: a binary database and its text twin.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <csgrt/scene.hpp>

#include "catch.hpp"

namespace csgrt::brlcad_test {

/// The solid with what its twin may write otherwise in one form. The loops of an nmg are a face each, from their
/// smallest point on, in the order of the points: a text may number vertices and faces in any order. The axis of a
/// torus may have any length, and older text gives it the tube's.
inline Shape plain(Shape any) {
    const auto less = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    if (auto* tor = std::get_if<Tor>(&any)) {
        const double length = std::hypot(tor->h.x, tor->h.y, tor->h.z);
        tor->h = {tor->h.x / length, tor->h.y / length, tor->h.z / length};
    } else if (const auto* nmg = std::get_if<Nmg>(&any)) {
        Ars loops;
        for (const auto& face : nmg->faces) {
            for (const Nmg::Loop& loop : face) {
                auto& points = loops.curves.emplace_back();
                for (const std::uint32_t vertex : loop) points.push_back(nmg->vertices.at(vertex));
                std::rotate(points.begin(), std::min_element(points.begin(), points.end(), less), points.end());
            }
        }
        std::sort(loops.curves.begin(), loops.curves.end(), [&](const auto& a, const auto& b) {
            return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
        });
        return loops;
    }
    return any;
}

/// The operators and names of a tree in one form, however its runs of one operator are nested: ((a u b) u c) and
/// (a u (b u c)) are u a b c, ((a - b) - c) is - a b c. The matrices are those of the leaves, in order.
struct PlainTree {
    std::string text;
    std::vector<std::vector<double>> matrices;
};

inline PlainTree plain(const Tree& tree) {
    struct Part {
        Operator op;
        std::string inner;  // operands without the operator around them
        std::string whole() const {
            return op == Operator::leaf ? inner : std::string(1, "?u+-^!"[static_cast<int>(op)]) + "(" + inner + ")";
        }
    };
    PlainTree out;
    std::vector<Part> stack;
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back({Operator::leaf, "{" + node.object + "}"});
            out.matrices.emplace_back(node.matrix.begin(), node.matrix.end());
            continue;
        }
        REQUIRE(stack.size() >= node.arity);
        Part part{node.op, {}};
        for (std::size_t i = stack.size() - node.arity; i < stack.size(); ++i) {
            const bool first = i == stack.size() - node.arity;
            const bool merges =
                stack[i].op == node.op && node.op != Operator::not_ && (first || node.op != Operator::difference);
            part.inner += merges ? stack[i].inner : stack[i].whole();
        }
        stack.resize(stack.size() - node.arity);
        stack.push_back(std::move(part));
    }
    REQUIRE(stack.size() <= 1);
    if (!stack.empty()) out.text = stack[0].whole();
    return out;
}

}  // namespace csgrt::brlcad_test
