// Compares two readings of one model: a binary database and its text twin.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <csgrt/scene.hpp>

#include "catch.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt::brlcad_test {

/// The points of each loop of an nmg, from the smallest on, in the order of the points: a text may number vertices and
/// faces in any order.
inline std::vector<std::vector<Vec3>> plain_faces(const Nmg& nmg) {
    const auto less = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::vector<std::vector<Vec3>> loops;
    for (const auto& face : nmg.faces) {
        for (const Nmg::Loop& loop : face) {
            auto& points = loops.emplace_back();
            for (const std::uint32_t vertex : loop) points.push_back(nmg.vertices.at(vertex));
            std::rotate(points.begin(), std::min_element(points.begin(), points.end(), less), points.end());
        }
    }
    std::sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
    });
    return loops;
}

inline void put_sketch(const Sketch& sketch, std::vector<double>& out) {
    for (const Sketch::Point& p : sketch.vertices) out.insert(out.end(), {p.u, p.v});
    for (const Sketch::Curve& curve : sketch.curves) {
        out.push_back(static_cast<double>(curve.index()));
        if (const auto* line = std::get_if<Sketch::Line>(&curve)) {
            out.insert(out.end(), {double(line->start), double(line->end)});
        } else if (const auto* arc = std::get_if<Sketch::Arc>(&curve)) {
            out.insert(out.end(), {double(arc->start), double(arc->end), arc->radius, double(arc->center_left),
                                   double(arc->clockwise)});
        } else if (const auto* bezier = std::get_if<Sketch::Bezier>(&curve)) {
            out.insert(out.end(), bezier->points.begin(), bezier->points.end());
        } else {
            const auto& nurb = std::get<Sketch::Nurb>(curve);
            out.push_back(nurb.order);
            out.insert(out.end(), nurb.knots.begin(), nurb.knots.end());
            out.insert(out.end(), nurb.points.begin(), nurb.points.end());
            out.insert(out.end(), nurb.weights.begin(), nurb.weights.end());
        }
    }
    out.insert(out.end(), sketch.reversed.begin(), sketch.reversed.end());
}

/// All numbers of a solid.
inline std::vector<double> numbers_of(const Shape& any) {
    std::vector<double> out;
    const auto put = [&](const Vec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); };
    std::visit(
        [&](const auto& s) {
            using T = std::decay_t<decltype(s)>;
            if constexpr (std::is_same_v<T, Arb>) {
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
            } else if constexpr (std::is_same_v<T, Metaball>) {
                out.insert(out.end(), {static_cast<double>(s.method), s.threshold});
                for (const Metaball::Point& p : s.points) {
                    put(p.position);
                    out.insert(out.end(), {p.strength, p.softness});
                }
            } else if constexpr (std::is_same_v<T, Pipe>) {
                for (const Pipe::Point& p : s.points) {
                    put(p.position);
                    out.insert(out.end(), {p.outer, p.inner, p.bend});
                }
            } else if constexpr (std::is_same_v<T, Bot>) {
                out.insert(out.end(), {static_cast<double>(s.mode), static_cast<double>(s.orientation)});
                for (const Vec3& v : s.vertices) put(v);
                for (const auto& face : s.faces) out.insert(out.end(), face.begin(), face.end());
                out.insert(out.end(), s.thickness.begin(), s.thickness.end());
                out.insert(out.end(), s.append.begin(), s.append.end());
                for (const Vec3& v : s.normals) put(v);
                for (const auto& face : s.face_normals) out.insert(out.end(), face.begin(), face.end());
            } else if constexpr (std::is_same_v<T, Ars>) {
                for (const auto& curve : s.curves) {
                    out.push_back(static_cast<double>(curve.size()));
                    for (const Vec3& v : curve) put(v);
                }
            } else if constexpr (std::is_same_v<T, Nmg>) {
                for (const auto& face : plain_faces(s)) {
                    out.push_back(static_cast<double>(face.size()));
                    for (const Vec3& v : face) put(v);
                }
            } else if constexpr (std::is_same_v<T, Ebm>) {
                out.insert(out.end(), {double(s.width), double(s.depth), s.height});
                out.insert(out.end(), s.matrix.begin(), s.matrix.end());
                out.insert(out.end(), s.cells.begin(), s.cells.end());
            } else if constexpr (std::is_same_v<T, Vol>) {
                out.insert(out.end(),
                           {double(s.width), double(s.depth), double(s.height), double(s.low), double(s.high)});
                put(s.cell);
                out.insert(out.end(), s.matrix.begin(), s.matrix.end());
                out.insert(out.end(), s.cells.begin(), s.cells.end());
            } else if constexpr (std::is_same_v<T, Dsp>) {
                out.insert(out.end(), {double(s.width), double(s.depth), double(s.smooth), double(s.cut)});
                out.insert(out.end(), s.matrix.begin(), s.matrix.end());
                out.insert(out.end(), s.heights.begin(), s.heights.end());
            } else if constexpr (std::is_same_v<T, Extrude>) {
                for (const Vec3& v : {s.v, s.h, s.a, s.b}) put(v);
                put_sketch(s.sketch, out);
            } else if constexpr (std::is_same_v<T, Revolve>) {
                for (const Vec3& v : {s.v, s.axis, s.r}) put(v);
                out.push_back(s.angle);
                put_sketch(s.sketch, out);
            } else if constexpr (!std::is_same_v<T, Unsupported>) {  // vectors and numbers alone
                form::for_members(form::of<T>, [&](const auto& member) {
                    const auto& value = std::invoke(member.at, s);
                    if constexpr (std::is_same_v<decltype(value), const Vec3&>) {
                        put(value);
                    } else {
                        out.push_back(value);
                    }
                });
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
