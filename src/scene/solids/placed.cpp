#include "scene/solids/placed.hpp"

#include <algorithm>
#include <cmath>

#include "scene/vector.hpp"

namespace csgrt {
namespace {

/// Moves points, displacements and lengths by a matrix.
class Mover {
public:
    explicit Mover(const Matrix& matrix) : m_(matrix) {
        const Vec3 x{m_[0], m_[4], m_[8]}, y{m_[1], m_[5], m_[9]}, z{m_[2], m_[6], m_[10]};
        scale_ = length(x);
        const double most = 1e-12 * scale_ * scale_;
        is_similar_ = std::max({std::abs(dot(x, y)), std::abs(dot(y, z)), std::abs(dot(z, x)),
                                std::abs(dot(y, y) - dot(x, x)), std::abs(dot(z, z) - dot(x, x))}) <= most;
        // Normals are moved by the inverse's transpose, but for a factor.
        normals_[0] = cross(y, z);
        normals_[1] = cross(z, x);
        normals_[2] = cross(x, y);
        volume_ = dot(x, normals_[0]);
    }

    std::optional<Shape> operator()(Ell s) const { return all(s, s.v, s.a, s.b, s.c); }
    std::optional<Shape> operator()(Tgc s) const { return all(s, s.v, s.h, s.a, s.b, s.c, s.d); }
    std::optional<Shape> operator()(Arb s) const {
        for (Vec3& vertex : s.vertices) move(vertex);
        return s;
    }
    std::optional<Shape> operator()(Arbn s) const {
        for (Plane& plane : s.planes) move(plane);
        return s;
    }
    std::optional<Shape> operator()(Half s) const {
        move(s.plane);
        return s;
    }
    std::optional<Shape> operator()(Tor s) const { return similar(s, {&s.v}, {&s.h}, {}, {&s.r_a, &s.r_h}); }
    std::optional<Shape> operator()(Ehy s) const { return similar(s, {&s.v}, {&s.h}, {&s.a}, {&s.r_1, &s.r_2, &s.c}); }
    std::optional<Shape> operator()(Part s) const { return similar(s, {&s.v}, {&s.h}, {}, {&s.r_v, &s.r_h}); }
    std::optional<Shape> operator()(Epa s) const { return similar(s, {&s.v}, {&s.h}, {&s.a}, {&s.r_1, &s.r_2}); }
    std::optional<Shape> operator()(Rpc s) const { return similar(s, {&s.v}, {&s.h, &s.b}, {}, {&s.r}); }
    std::optional<Shape> operator()(Rhc s) const { return similar(s, {&s.v}, {&s.h, &s.b}, {}, {&s.r, &s.c}); }
    std::optional<Shape> operator()(Eto s) const { return similar(s, {&s.v}, {&s.n, &s.c}, {}, {&s.r, &s.r_d}); }
    std::optional<Shape> operator()(Hyp s) const { return similar(s, {&s.v}, {&s.h, &s.a}, {}, {&s.b}); }
    std::optional<Shape> operator()(Superell s) const { return similar(s, {&s.v}, {&s.a, &s.b, &s.c}, {}, {}); }
    std::optional<Shape> operator()(Hrt s) const { return similar(s, {&s.v}, {&s.x, &s.y, &s.z}, {}, {&s.d}); }
    template <class Other>
    std::optional<Shape> operator()(const Other&) const {
        return {};
    }

private:
    Vec3 turned(const Vec3& d) const {
        return {m_[0] * d.x + m_[1] * d.y + m_[2] * d.z, m_[4] * d.x + m_[5] * d.y + m_[6] * d.z,
                m_[8] * d.x + m_[9] * d.y + m_[10] * d.z};
    }
    void move(Vec3& point) const { point = turned(point) + Vec3{m_[3], m_[7], m_[11]}; }
    void move(Plane& plane) const {
        const Vec3& n = plane.normal;
        Vec3 on = plane.distance / dot(n, n) * n;
        move(on);
        plane.normal = unit((volume_ < 0 ? -1 : 1) * (n.x * normals_[0] + n.y * normals_[1] + n.z * normals_[2]));
        plane.distance = dot(plane.normal, on);
    }
    template <class S, class... Displacements>
    std::optional<Shape> all(S& s, Vec3& point, Displacements&... displacements) const {
        move(point);
        ((displacements = turned(displacements)), ...);
        return s;
    }
    template <class S>
    std::optional<Shape> similar(S& s, std::initializer_list<Vec3*> points, std::initializer_list<Vec3*> displacements,
                                 std::initializer_list<Vec3*> directions,
                                 std::initializer_list<double*> lengths) const {
        if (!is_similar_) return {};
        for (Vec3* point : points) move(*point);
        for (Vec3* displacement : displacements) *displacement = turned(*displacement);
        for (Vec3* direction : directions) *direction = unit(turned(*direction));
        for (double* length : lengths) *length *= scale_;
        return s;
    }

    const Matrix& m_;
    double scale_ = 1, volume_ = 1;
    bool is_similar_ = true;
    Vec3 normals_[3];
};

}  // namespace

std::optional<Shape> placed(const Shape& shape, const Matrix& matrix) {
    std::optional<Shape> moved = std::visit(Mover(matrix), shape);
    if (moved && matrix == identity) moved = shape;  // to the bit
    return moved;
}

}  // namespace csgrt
