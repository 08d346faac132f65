#include "compile/bounds/bounds.hpp"

#include <cmath>
#include <stdexcept>

#include "compile/solids/polyhedron.hpp"
#include "compile/bounds/tight_box.hpp"

namespace csgrt {

namespace {

Box corners_box(const Arb& arb, const Matrix& m) {
    Box box = empty_box;
    for (const Vec3& vertex : arb.vertices) extend(box, narrow(transform_point(m, wide(vertex))));
    return box;
}

Box around_planes(const std::vector<Plane>& planes, const Vec3& near = {}) {
    const Box box = polyhedron_box(planes, near);
    if (!is_finite(box)) return box;
    if (is_empty(box)) {
        // A ray never hits the solid, so any position serves.
        const Vec3 foot =
            planes.empty() ? Vec3{} : narrow(wide(planes[0].normal) * static_cast<long double>(planes[0].distance));
        return {foot, foot};
    }
    // Vertices are found to about 1e-15 of the cube of the search, which is not much larger than the solid.
    const double pad = 1e-9 * diagonal(box);
    return {{box.low.x - pad, box.low.y - pad, box.low.z - pad},
            {box.high.x + pad, box.high.y + pad, box.high.z + pad}};
}

Box arb_box(const Arb& s, const Matrix& m, const ArbFaces& faces) {
    return faces.is_hull ? corners_box(s, m)
                         : around_planes(faces.planes, narrow(transform_point(m, wide(s.vertices[0]))));
}

}  // namespace

Box Tight::operator()(const Ell& s) const {
    return box_around(transform_point(m, wide(s.v)),
                      half_size(linear_part(m) * WideMatrix(wide(s.a), wide(s.b), wide(s.c))));
}
Box Tight::operator()(const Tgc& s) const {
    return united(ellipse_box(m, wide(s.v), wide(s.a), wide(s.b)),
                  ellipse_box(m, wide(s.v) + wide(s.h), wide(s.c), wide(s.d)));
}
Box Tight::operator()(const Arb& s) const { return arb_box(s, m, arb_faces(s, m)); }
Box Tight::operator()(const Arbn& s) const { return around_planes(arbn_faces(s, m)); }
Box Tight::operator()(const Half&) const { return whole_space; }
// The box of the circle, enlarged by the box of a ball of the tube's radius.
Box Tight::operator()(const Tor& s) const {
    const Wide h = glm::normalize(wide(s.h));
    // The projections of x, y and z onto the circle's plane are e_i - (e_i . h) h. Their lengths give the circle's box.
    const WideMatrix linear = linear_part(m);
    const WideMatrix disc = linear * (WideMatrix(1) - glm::outerProduct(h, h));
    return box_around(transform_point(m, wide(s.v)), static_cast<long double>(s.r_a) * half_size(disc) +
                                                         static_cast<long double>(s.r_h) * half_size(linear));
}
// The box of the cylinder over its base, which holds the solid.
Box Tight::operator()(const Ehy& s) const {
    const Wide a = glm::normalize(wide(s.a));
    const Wide b = glm::normalize(glm::cross(wide(s.h), a)) * static_cast<long double>(s.r_2);
    return united(ellipse_box(m, wide(s.v), a * static_cast<long double>(s.r_1), b),
                  ellipse_box(m, wide(s.v) + wide(s.h), a * static_cast<long double>(s.r_1), b));
}
Box Tight::operator()(const Unsupported&) const { return {}; }
Box Tight::operator()(const Pipe&) const { throw std::logic_error("a pipe is boxed piece by piece"); }
Box Tight::operator()(const Cline&) const { throw std::logic_error("a cline is boxed piece by piece"); }

namespace {

/// Does BRL-CAD treat the cone as a right elliptical cylinder, which gets an exact box? The tolerances are BRL-CAD's.
bool is_right_cylinder(const Tgc& s, const Matrix& m) {
    constexpr long double length_tolerance = 1e-8L, dot_tolerance = 0.001L;
    const Wide h = transform_direction(m, wide(s.h)), a = transform_direction(m, wide(s.a)),
               b = transform_direction(m, wide(s.b));
    const Wide c = transform_direction(m, wide(s.c)), d = transform_direction(m, wide(s.d));
    const auto small = [](long double x, long double tolerance) { return std::fabs(x) <= tolerance; };
    const long double hh = glm::length(h), aa = glm::length(a), bb = glm::length(b);
    if (small(hh, length_tolerance) || small(aa, length_tolerance) || small(bb, length_tolerance)) return false;
    return small(glm::length(a - c), length_tolerance) && small(glm::length(b - d), length_tolerance) &&
           small(glm::dot(a, b) / (aa * bb), dot_tolerance) && small(glm::dot(h, a) / (hh * aa), dot_tolerance) &&
           small(glm::dot(h, b) / (hh * bb), dot_tolerance);
}

/// BRL-CAD's box of a solid. For most types it is the exact box.
struct BrlCad {
    const Matrix& m;
    const Box& exact;  ///< as Tight has it

    Box operator()(const Tgc& s) const {
        if (is_right_cylinder(s, m)) return exact;
        return united(parallelogram_box(m, wide(s.v), wide(s.a), wide(s.b)),
                      parallelogram_box(m, wide(s.v) + wide(s.h), wide(s.c), wide(s.d)));
    }
    Box operator()(const Arb& s) const { return corners_box(s, m); }
    Box operator()(const Arbn& s) const { return polyhedron_box(arbn_faces(s, m)); }
    Box operator()(const Ehy& s) const {
        const Wide a = glm::normalize(wide(s.a)) * static_cast<long double>(s.r_1);
        const Wide b = glm::normalize(glm::cross(wide(s.h), a)) * static_cast<long double>(s.r_2);
        return united(parallelogram_box(m, wide(s.v), a, b), parallelogram_box(m, wide(s.v) + wide(s.h), a, b));
    }
    Box operator()(const Vol& s) const {
        const Vec3 half{0.5 * s.width * s.cell.x, 0.5 * s.depth * s.cell.y, 0.5 * s.height * s.cell.z};
        const WideMatrix own = linear_part(s.matrix);
        const Wide x = own[0] * static_cast<long double>(half.x), y = own[1] * static_cast<long double>(half.y);
        return united(parallelogram_box(m, transform_point(s.matrix, {half.x, half.y, 0}), x, y),
                      parallelogram_box(m, transform_point(s.matrix, {half.x, half.y, 2 * half.z}), x, y));
    }
    template <class Other>
    Box operator()(const Other&) const {
        return exact;
    }
};

}  // namespace

namespace {

/// The box around the part of a torus between two planes through its axis, less than half of it. All balls of the tube
/// along the arc lie within the hull of three balls: at the two ends of the arc, and where the tangents at these ends
/// meet.
Box bend_box(const Tor& s, const Matrix& m, const std::vector<Plane>& cuts) {
    const Wide axis = glm::normalize(wide(s.h)), from = -wide(cuts[0].normal), to = wide(cuts[1].normal);
    const long double radius = s.r_a, tube = s.r_h;
    const Wide v = wide(s.v), first = v + radius * glm::cross(from, axis), last = v + radius * glm::cross(to, axis);
    const long double sine = glm::dot(axis, glm::cross(from, to)), cosine = glm::dot(from, to);
    const Wide corner = first + radius * sine / (1 + cosine) * from;
    const Wide half = tube * half_size(linear_part(m));
    Box box = empty_box;
    for (const Wide& p : {first, last, corner}) box = united(box, box_around(transform_point(m, p), half));
    return intersected(box, Tight{m}(s));
}

/// The box, larger by a few roundings of each coordinate and of the terms that were added up to it.
Box rounded_outward(Box box) {
    if (!is_finite(box)) return box;
    const auto widen = [](double& low, double& high) {
        const double margin = 8 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(low), std::fabs(high));
        low -= margin;
        high += margin;
    };
    widen(box.low.x, box.high.x);
    widen(box.low.y, box.high.y);
    widen(box.low.z, box.high.z);
    return box;
}

}  // namespace

SolidBoxes solid_boxes(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts,
                       const ArbFaces* faces) {
    if (!cuts.empty()) {
        const Box box = bend_box(std::get<Tor>(shape), matrix, cuts);
        return {rounded_outward(box), box};
    }
    const Box exact =
        faces != nullptr ? arb_box(std::get<Arb>(shape), matrix, *faces) : std::visit(Tight{matrix}, shape);
    return {rounded_outward(exact), std::visit(BrlCad{matrix, exact}, shape)};
}

namespace {

/// Calls `call` with the box of each node's subtree, in the order of the nodes.
template <class Call>
void for_each_subtree(const FlatTree& tree, const std::vector<Box>& boxes, const Call& call) {
    // The boxes of a set and of its complement. With the two boxes, the result does not depend on how a set's tree is
    // written.
    struct Both {
        Box inside, outside;
    };
    const auto both_in = [](const Box& a, const Box& b) {
        const Box box = intersected(a, b);
        return is_empty(box) ? empty_box : box;
    };
    std::vector<Both> stack;
    for (const FlatTree::Node& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back({boxes[node.solid], whole_space});
            call(stack.back().inside);
            continue;
        }
        const std::size_t first = stack.size() - node.arity;
        Both box = stack[first];
        for (std::size_t i = first + 1; i < stack.size(); ++i) {
            const Both& next = stack[i];
            if (node.op == Operator::union_) {
                box = {united(box.inside, next.inside), both_in(box.outside, next.outside)};
            } else if (node.op == Operator::intersection) {
                box = {both_in(box.inside, next.inside), united(box.outside, next.outside)};
            } else if (node.op == Operator::difference) {
                box = {both_in(box.inside, next.outside), united(box.outside, next.inside)};
            } else if (node.op == Operator::xor_) {
                box = {united(both_in(box.inside, next.outside), both_in(box.outside, next.inside)),
                       united(both_in(box.inside, next.inside), both_in(box.outside, next.outside))};
            }
        }
        if (node.op == Operator::not_) std::swap(box.inside, box.outside);
        stack.resize(first);
        stack.push_back(box);
        call(box.inside);
    }
}

}  // namespace

Box tree_box(const FlatTree& tree, const std::vector<Box>& boxes) {
    Box last = empty_box;
    for_each_subtree(tree, boxes, [&](const Box& box) { last = box; });
    return last;
}

std::vector<Box> subtree_boxes(const FlatTree& tree, const std::vector<Box>& boxes) {
    std::vector<Box> all;
    for_each_subtree(tree, boxes, [&](const Box& box) { all.push_back(box); });
    return all;
}

}  // namespace csgrt
