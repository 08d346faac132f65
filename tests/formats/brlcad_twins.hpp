// Compares two readings of one model: a binary database and its text twin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include <csgrt/scene.hpp>

#include "catch.hpp"

namespace csgrt::brlcad_test {

/// All numbers of a solid.
inline std::vector<double> numbers_of(const Shape& any) {
    std::vector<double> out;
    const auto put = [&](const Vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); };
    std::visit(
        [&](const auto& s) {
            using T = std::decay_t<decltype(s)>;
            if constexpr (std::is_same_v<T, Ell>) {
                for (const Vec3& v : {s.v, s.a, s.b, s.c}) put(v);
            } else if constexpr (std::is_same_v<T, Tgc>) {
                for (const Vec3& v : {s.v, s.h, s.a, s.b, s.c, s.d}) put(v);
            } else if constexpr (std::is_same_v<T, Arb>) {
                for (const Vec3& v : s.vertices) put(v);
            } else if constexpr (std::is_same_v<T, Arbn>) {
                for (const Plane& p : s.planes) {
                    put(p.normal);
                    out.push_back(p.distance);
                }
            } else if constexpr (std::is_same_v<T, Half>) {
                put(s.plane.normal);
                out.push_back(s.plane.distance);
            } else if constexpr (std::is_same_v<T, Tor>) {
                // The axis may have any length, and older text gives it the tube's.
                const double length = std::hypot(s.h.x, s.h.y, s.h.z);
                put(s.v);
                put({s.h.x / length, s.h.y / length, s.h.z / length});
                out.insert(out.end(), {s.r_a, s.r_h});
            } else if constexpr (std::is_same_v<T, Ehy>) {
                for (const Vec3& v : {s.v, s.h, s.a}) put(v);
                out.insert(out.end(), {s.r_1, s.r_2, s.c});
            }
        },
        any);
    return out;
}

/// How far apart, as a part of the largest number of both; infinite if they are not as many.
inline double gap(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return INFINITY;
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
        apart = std::max(apart, std::abs(a[i] - b[i]));
    }
    return apart == 0 ? 0 : apart / largest;
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
            const bool merges = stack[i].op == node.op && node.op != Operator::not_ &&
                                (first || node.op != Operator::difference);
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
