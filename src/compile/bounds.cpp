#include "compile/bounds.hpp"

#include <cmath>

#include "compile/linear.hpp"
#include "compile/polyhedron.hpp"

namespace csgrt {

namespace {

/// Half the size of an ellipsoid's box: columns are its semi-axes. An ellipse has a zero column.
Wide half_size(const WideMatrix& axes) {
    return {std::hypot(axes[0].x, axes[1].x, axes[2].x), std::hypot(axes[0].y, axes[1].y, axes[2].y),
            std::hypot(axes[0].z, axes[1].z, axes[2].z)};
}

Box box_around(const Wide& center, const Wide& half) { return {narrow(center - half), narrow(center + half)}; }

Box ellipse_box(const Matrix& m, const Wide& center, const Wide& a, const Wide& b) {
    return box_around(transform_point(m, center),
                      half_size({transform_direction(m, a), transform_direction(m, b), Wide(0)}));
}

Box parallelogram_box(const Matrix& m, const Wide& center, const Wide& a, const Wide& b) {
    return box_around(transform_point(m, center),
                      glm::abs(transform_direction(m, a)) + glm::abs(transform_direction(m, b)));
}

Box corners_box(const Arb& arb, const Matrix& m) {
    Box box = empty_box;
    for (const Vec3& vertex : arb.vertices) extend(box, narrow(transform_point(m, wide(vertex))));
    return box;
}

struct Tight {
    const Matrix& m;

    Box operator()(const Ell& s) const {
        return box_around(transform_point(m, wide(s.v)),
                          half_size(linear_part(m) * WideMatrix(wide(s.a), wide(s.b), wide(s.c))));
    }
    Box operator()(const Tgc& s) const {
        return united(ellipse_box(m, wide(s.v), wide(s.a), wide(s.b)),
                      ellipse_box(m, wide(s.v) + wide(s.h), wide(s.c), wide(s.d)));
    }
    Box operator()(const Arb& s) const {
        const ArbFaces faces = arb_faces(s, m);
        return faces.is_hull ? corners_box(s, m)
                             : around_planes(faces.planes, narrow(transform_point(m, wide(s.vertices[0]))));
    }
    Box operator()(const Arbn& s) const { return around_planes(arbn_faces(s, m)); }
    Box operator()(const Half&) const { return whole_space; }
    // The circle's box, and around it that of the tube's ball.
    Box operator()(const Tor& s) const {
        const Wide h = glm::normalize(wide(s.h));
        // The plane of the circle is that of the projections of x, y, z; its box comes from |e_i - (e_i . h) h|.
        const WideMatrix linear = linear_part(m);
        const WideMatrix disc = linear * (WideMatrix(1) - glm::outerProduct(h, h));
        return box_around(transform_point(m, wide(s.v)), static_cast<long double>(s.r_a) * half_size(disc) +
                                                             static_cast<long double>(s.r_h) * half_size(linear));
    }
    // Inside the cylinder over its base.
    Box operator()(const Ehy& s) const {
        const Wide a = glm::normalize(wide(s.a));
        const Wide b = glm::normalize(glm::cross(wide(s.h), a)) * static_cast<long double>(s.r_2);
        return united(ellipse_box(m, wide(s.v), a * static_cast<long double>(s.r_1), b),
                      ellipse_box(m, wide(s.v) + wide(s.h), a * static_cast<long double>(s.r_1), b));
    }
    Box operator()(const Unsupported&) const { return {}; }

    static Box around_planes(const std::vector<Plane>& planes, const Vec3& near = {}) {
        const Box box = polyhedron_box(planes, near);
        if (!is_finite(box)) return box;
        if (is_empty(box)) {
            // Never hit; any place will do.
            const Vec3 foot =
                planes.empty() ? Vec3{} : narrow(wide(planes[0].normal) * static_cast<long double>(planes[0].distance));
            return {foot, foot};
        }
        // Vertices are found to about 1e-15 of the cube that they were sought in, which is not much larger than the
        // solid.
        const double pad = 1e-9 * diagonal(box);
        return {{box.low.x - pad, box.low.y - pad, box.low.z - pad},
                {box.high.x + pad, box.high.y + pad, box.high.z + pad}};
    }
};

/// BRL-CAD takes a cone for a right elliptical cylinder, with an exact box, within these tolerances.
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

struct BrlCad {
    const Matrix& m;

    Box operator()(const Tgc& s) const {
        if (is_right_cylinder(s, m)) return Tight{m}(s);
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
    template <class Other>
    Box operator()(const Other& s) const {
        return Tight{m}(s);
    }
};

}  // namespace

Box solid_box(const Shape& shape, const Matrix& matrix) {
    Box box = std::visit(Tight{matrix}, shape);
    if (!is_finite(box)) return box;
    // A few roundings of each coordinate, and of what was added up to it.
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

Box brlcad_box(const Shape& shape, const Matrix& matrix) { return std::visit(BrlCad{matrix}, shape); }

Box tree_box(const FlatTree& tree, const std::vector<Box>& boxes) {
    std::vector<Box> stack;
    for (const FlatTree::Node& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back(boxes[node.solid]);
            continue;
        }
        const std::size_t first = stack.size() - node.arity;
        Box box = stack[first];
        for (std::size_t i = first + 1; i < stack.size(); ++i) {
            if (node.op == Operator::union_ || node.op == Operator::xor_) box = united(box, stack[i]);
            if (node.op == Operator::intersection) box = intersected(box, stack[i]);
        }
        if (is_empty(box)) box = empty_box;
        if (node.op == Operator::not_) box = whole_space;
        stack.resize(first);
        stack.push_back(box);
    }
    return stack.empty() ? empty_box : stack.back();
}

}  // namespace csgrt
