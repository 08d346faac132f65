// Pack curved: packs solids of a closed form.
#include <algorithm>
#include <cmath>

#include "compile/bvh/build.hpp"
#include "compile/solids/curved_frames.hpp"
#include "compile/solids/packer.hpp"
#include "compile/solids/polyhedron.hpp"
#include "compile/solids/sketch_writer.hpp"

namespace csgrt {

namespace {

constexpr long double log2_e = 1.44269504088896340736L;

}  // namespace

void Packer::face(const Wide& point, const Wide& a, const Wide& b, const Wide& inside) {
    Wide normal = glm::cross(transform_direction(matrix, a), transform_direction(matrix, b));
    if (glm::dot(normal, transform_direction(matrix, inside - point)) > 0) normal = -normal;
    face(plane_through(transform_point(matrix, point), normal));
}

void Packer::operator()(const Epa& s) {
    record.type = SOLID_QUADRIC;
    const Wide v = wide(s.v);
    const WideMatrix axes = axes_of(s);
    frame(v, axes);
    for (const long double q : {1, 1, 0, 1, -1}) real(q);
    face(v, axes[0], axes[1], v + axes[2]);
}

void Packer::operator()(const Rpc& s) {
    record.type = SOLID_QUADRIC;
    const Wide v = wide(s.v), h = wide(s.h);
    const WideMatrix axes = axes_of(s);
    frame(v + 0.5L * h, axes);
    for (const long double q : {0, 1, 0, 1, -1}) real(q);
    face(v, axes[0], axes[1], v + axes[2]);
    face(v, axes[1], axes[2], v + h);
    face(v + h, axes[1], axes[2], v);
}

// Local z is the depth below the vertex line, so that a hyperbola that is nearly a parabola keeps its digits.
void Packer::operator()(const Rhc& s) {
    record.type = SOLID_QUADRIC;
    const Wide v = wide(s.v), h = wide(s.h), b = wide(s.b);
    WideMatrix axes = axes_of(s);
    const long double c = static_cast<long double>(s.c) / glm::length(b), k = 1 / (1 + 2 * c);
    axes[2] = -axes[2];
    frame(v + 0.5L * h + b, axes);
    for (const long double q : {0.0L, 1.0L, -k, -2 * c * k, 0.0L}) real(q);
    face(v, axes[0], axes[1], v + b);
    face(v, axes[1], axes[2], v + h);
    face(v + h, axes[1], axes[2], v);
    face(v + (1 + c) * b, axes[0], axes[1], v);  // half-way to the other branch
}

void Packer::operator()(const Hyp& s) {
    record.type = SOLID_QUADRIC;
    const Wide v = wide(s.v), h = wide(s.h);
    const WideMatrix axes = axes_of(s);
    const long double neck2 = static_cast<long double>(s.neck) * s.neck;
    frame(v + 0.5L * h, axes);
    for (const long double q : {1.0L, 1.0L, neck2 - 1, 0.0L, -neck2}) real(q);
    face(v, axes[0], axes[1], v + h);
    face(v + h, axes[0], axes[1], v);
}

void Packer::operator()(const Eto& s) {
    record.type = SOLID_ETO;
    const EtoFrame f = frame_of(s);
    frame(wide(s.v), f.axes);
    // The quadratic form (u . p)^2 / C^2 + (w . p)^2 / D^2 of p = (rho - 1, z); u and w are the directions of the
    // semi-axes.
    const long double u = 1 / (f.long_axis * f.long_axis), w = 1 / (f.short_axis * f.short_axis);
    const long double out = f.radial, up = f.axial;
    real(out * out * u + up * up * w);
    real(out * up * (u - w));
    real(up * up * u + out * out * w);
    real(std::hypot(up * f.long_axis, out * f.short_axis));
    const long double reach = std::hypot(out * f.long_axis, up * f.short_axis);
    real(1 + reach);
    // An ellipse that touches the axis may cross it by rounding.
    if (reach > 1 + 1e-15L)
        crossed(out * out * u + up * up * w, out * up * (u - w), up * up * u + out * out * w, u * w, reach);
}

/// The pivots of an eto whose ellipse crosses the axis (crossed_eto.h). With F = 0 at rho = 0, z = (beta +- s) / gamma,
/// s^2 = beta^2 - gamma (alpha - 1) = determinant (reach^2 - 1); and F(rho) = F(-rho) = 0 off the axis where z = alpha
/// / beta and alpha rho^2 = 1 - alpha determinant / beta^2.
void Packer::crossed(long double alpha, long double beta, long double gamma, long double determinant,
                     long double reach) {
    record.type = SOLID_CROSSED_ETO;
    const long double s = std::sqrt(determinant * (reach - 1) * (reach + 1));
    const auto pivot = [&](long double height, long double lin, long double odd, long double radius) {
        for (const long double value : {height, lin, odd, radius}) real(value);
    };
    for (const long double side : {-s, s})
        pivot((beta + side) / gamma, 2 * side, 2 * (beta * side - determinant) / gamma, 0);
    const long double rest = beta * beta - alpha * determinant;
    if (rest > 0)
        pivot(alpha / beta, 2 * determinant / beta, 0, std::sqrt(rest / alpha) / std::fabs(beta));
    else
        pivot(0, 0, 0, -1);
}

void Packer::operator()(const Part& s) {
    record.type = SOLID_PART;
    const Wide h = wide(s.h);
    const long double length = glm::length(h), first = s.r_v, second = s.r_h;
    const Wide axis = length > 0 ? h / length : Wide(0, 0, 1);
    const long double low = std::min(-first, length - second), high = std::max(first, length + second);
    const long double unit = 0.5L * (high - low);
    const long double middle = first == 0 ? 0 : second == 0 ? length : 0.5L * (high + low);
    const Wide x = across(axis);
    frame(wide(s.v) + middle * axis, {x * unit, glm::cross(axis, x) * unit, axis * unit});
    const long double z0 = -middle / unit, z1 = (length - middle) / unit, r0 = first / unit, r1 = second / unit;
    for (const long double q : {z0, r0, z1, r1}) real(q);
    // The cone leans by the angle whose sine is (r0 - r1) / |h|: it touches each ball where z is the centre's z plus
    // sine x radius.
    const bool has_cone = std::fabs(first - second) < length;
    const long double sine = has_cone ? (first - second) / length : 0, cosine = std::sqrt((1 - sine) * (1 + sine));
    const long double slope = -sine / cosine;
    real(first == 0 || second == 0 ? 0 : r0 / cosine - slope * z0);
    real(slope);
    real(has_cone ? z0 + r0 * sine : 1);
    real(has_cone ? z1 + r1 * sine : -1);
}

void Packer::operator()(const Superell& s) {
    record.type = SOLID_SUPERELL;
    frame(wide(s.v), {wide(s.a), wide(s.b), wide(s.c)});
    const long double e = s.e, n = s.n;
    real(2 / e);
    real(e / n);
    real(2 / n);
}

void Packer::operator()(const Hrt& s) {
    record.type = SOLID_HRT;
    frame(wide(s.v), {wide(s.x), wide(s.y), wide(s.z)});
}

void Packer::operator()(const Metaball& s) {
    record.type = SOLID_METABALL;
    const MetaballFrame f = frame_of(s);
    const auto local = [&](const Metaball::Point& p) { return (wide(p.position) - f.center) / f.reach; };
    // The box of the ball in which a point's field is searched.
    const auto box_of = [&](std::size_t i) {
        constexpr long double searched = 1.001L;
        const long double reach = field_radius(s, s.points[i]) / f.reach;
        const Wide at = local(s.points[i]), most(searched);
        return Box{narrow(glm::max(at - Wide(reach), -most)), narrow(glm::min(at + Wide(reach), most))};
    };
    constexpr std::size_t few = 16;
    Hierarchy hierarchy;
    if (s.method != Metaball::Method::isopotential && s.points.size() > few)
        hierarchy = build_bvh(s.points.size(), box_of, {}, 1, 0);
    record.first_word = position_of(scene.words.size());
    for (const std::size_t word : {s.points.size(), scene.inner_nodes.size(), hierarchy.nodes.size()})
        scene.words.push_back(position_of(word));
    scene.inner_nodes.insert(scene.inner_nodes.end(), hierarchy.nodes.begin(), hierarchy.nodes.end());

    frame(f.center, WideMatrix(f.reach));
    real(s.method == Metaball::Method::metaball ? 0 : s.method == Metaball::Method::isopotential ? 1 : 2);
    real(s.threshold);
    real(faint(s) * log2_e);
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const Metaball::Point& point = s.points[hierarchy.order.empty() ? i : hierarchy.order[i]];
        const Wide at = local(point);
        for (int k = 0; k < 3; ++k) real(at[k]);
        const long double strength = point.strength / f.reach, strength2 = strength * strength;
        const long double softness = point.softness * log2_e;
        switch (s.method) {
            case Metaball::Method::metaball:
                real(0);
                real(1 / strength2);
                break;
            case Metaball::Method::isopotential:
                real(strength2);
                real(0);
                break;
            case Metaball::Method::blob:
                real(softness);
                real(softness / strength2);
                break;
        }
    }
}

}  // namespace csgrt
