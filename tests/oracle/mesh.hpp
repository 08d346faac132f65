// Surfaces of triangles in 113 bits: what a ray crosses, how far a point is from the surface.
//
// Triangles are passed over only where doubles that know their error say for certain that they are not crossed and that
// no edge of theirs is near.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/renderer.hpp>

#include "sphere_tree.hpp"
#include "filter_numbers.hpp"

namespace csgrt::oracle {

struct MeshCrossing {
    quad t = 0;
    std::size_t triangle = 0;
    quad cosine = 0;  ///< |normal . d| / |d|
};

struct MeshCrossings {
    std::vector<MeshCrossing> all;  ///< ascending
    quad edge_distance = 0;  ///< of the ray to the nearest edge that bounds a crossed or an all but crossed triangle
};

/// Triangles in the world, each vertex placed in 113 bits.
class MeshSurface {
public:
    using Face = std::array<std::uint32_t, 3>;

    MeshSurface(const std::vector<Vec3>& vertices, const std::vector<Face>& faces, const QAffine& place)
        : faces_(faces) {
        const QAffine rounding = componentwise_absolute(place), inverse = componentwise_absolute(place.inverse());
        const QVec ones = rounding.direction(inverse.direction({1, 1, 1}));
        condition = to_double(larger(larger(ones.x, ones.y), larger(ones.z, 1)));
        for (const Vec3& vertex : vertices) {
            vertices_.push_back(place.point(vertex));
            rough_.push_back(triple<BoundedDouble>(vertices_.back()));
        }
        std::vector<bool> used(vertices.size(), false);
        for (const Face& face : faces)
            for (const std::uint32_t corner : face) used[corner] = true;
        QVec low = at(0, 0), high = low;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (!used[i]) continue;
            const QVec& p = vertices_[i];
            low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
            high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
            placement = std::max(placement, to_double(length(rounding.point(componentwise_absolute(vertices[i])))));
        }
        center = quad(0.5) * (low + high);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (used[i]) radius = std::max(radius, to_double(length(vertices_[i] - center)));
        std::vector<BoundingSphere> spheres;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const std::array<Vec3, 3> p{to_vec3(at(i, 0)), to_vec3(at(i, 1)), to_vec3(at(i, 2))};
            BoundingSphere sphere{
                {(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3, (p[0].z + p[1].z + p[2].z) / 3}, 0};
            const double size = std::abs(sphere.center.x) + std::abs(sphere.center.y) + std::abs(sphere.center.z);
            for (const Vec3& v : p)
                sphere.radius =
                    std::max(sphere.radius, 1.001 * distance_of(v, sphere.center) + 16 * double_epsilon * size);
            spheres.push_back(sphere);
            quad longest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const QVec e = at(i, k) - at(i, (k + 1) % 3);
                longest = larger(longest, dot(e, e));
            }
            const QVec n = cross(at(i, 1) - at(i, 0), at(i, 2) - at(i, 0));
            heights_.push_back(longest > 0 ? std::sqrt(to_double(dot(n, n) / longest)) : 0);
        }
        tree_ = SphereTree(std::move(spheres));
    }

    std::size_t size() const { return faces_.size(); }
    const QVec& at(std::size_t triangle, std::size_t corner) const { return vertices_[faces_[triangle][corner]]; }
    /// Unit; zero: it has no area.
    QVec normal(std::size_t i) const {
        const QVec n = cross(at(i, 1) - at(i, 0), at(i, 2) - at(i, 0));
        return dot(n, n) > 0 ? unit(n) : QVec{};
    }
    double height(std::size_t triangle) const { return heights_[triangle]; }  ///< the least of its three
    const Face& face(std::size_t triangle) const { return faces_[triangle]; }
    const std::vector<QVec>& vertices() const { return vertices_; }

    /// A ray through an edge crosses the triangle that it would cross a hair further aside. Edges nearer to the ray
    /// than `near` are told.
    MeshCrossings cross_all(const QVec& o, const QVec& d, double near) const {
        MeshCrossings found;
        const quad speed = length(d);
        const QVec aside = any_across(d), aside2 = cross(d, aside);
        found.edge_distance = 4 * quad(radius) + 1;
        const Vec3 from = to_vec3(o), way = to_vec3(d);
        const Triple<BoundedDouble> start = triple<BoundedDouble>(o), along = triple<BoundedDouble>(d);
        const auto crossed = [&](std::size_t i) {
            const QVec n = normal(i);
            const quad rate = dot(n, d);
            if (rate == 0) return;
            found.all.push_back({dot(n, at(i, 0) - o) / rate, i, absolute(rate) / speed});
        };
        tree_.each(from, way, near, [&](std::size_t i) {
            const Pass pass = far_from_edges(i, start, along, near);
            if (pass == Pass::through) crossed(i);
            if (pass != Pass::unsure || is_far(i, o, d, speed, near)) return;
            int sides[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3;
                const QVec p = at(i, k) - o, q = at(i, next) - o;
                found.edge_distance = smaller(found.edge_distance, distance_to_edge(p, q, d, speed));
                // The same number for both of an edge's triangles, with opposite signs.
                const bool forward = faces_[i][k] < faces_[i][next];
                const QVec &a = forward ? p : q, &b = forward ? q : p;
                quad turn = dot(d, cross(a, b));
                if (turn == 0) turn = dot(d, cross(b - a, aside));
                if (turn == 0) turn = dot(d, cross(b - a, aside2));
                sides[k] = (turn > 0 ? 1 : turn < 0 ? -1 : 0) * (forward ? 1 : -1);
            }
            if (sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]) crossed(i);
        });
        std::sort(found.all.begin(), found.all.end(),
                  [](const MeshCrossing& a, const MeshCrossing& b) { return a.t < b.t; });
        return found;
    }

    /// By parity, along a direction that no model has.
    bool contains(const QVec& p) const {
        const MeshCrossings found = cross_all(p, {quad(0.3178), quad(-0.5931), quad(0.7402)}, 0);
        std::size_t ahead = 0;
        for (const MeshCrossing& c : found.all) ahead += c.t > 0 ? 1 : 0;
        return ahead % 2 == 1;
    }

    /// From p to triangle i.
    quad distance(std::size_t i, const QVec& p) const {
        const QVec a = at(i, 0) - p, b = at(i, 1) - p, c = at(i, 2) - p, n = normal(i);
        quad nearest = smaller(to_segment(a, b), smaller(to_segment(b, c), to_segment(c, a)));
        if (dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0 && dot(n, n) > 0)
            nearest = smaller(nearest, absolute(dot(n, a)));
        return nearest;
    }
    /// Is p within `reach` of triangle i?
    bool is_near(std::size_t i, const QVec& p, quad reach) const {
        const BoundingSphere& sphere = tree_.spheres()[i];
        const QVec to_sphere = QVec(sphere.center) - p;
        const quad far = quad(sphere.radius) + reach;
        return dot(to_sphere, to_sphere) <= far * far && distance(i, p) <= reach;
    }
    bool is_near(const QVec& p, quad reach) const {
        for (std::size_t i = 0; i < faces_.size(); ++i)
            if (is_near(i, p, reach)) return true;
        return false;
    }

    QVec center;
    double radius = 0;
    double placement = 0;  ///< |M||v| + |translation|, see solid.hpp
    double condition = 1;

private:
    static double distance_of(const Vec3& a, const Vec3& b) {
        const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
        return std::sqrt(x * x + y * y + z * z);
    }
    enum class Pass { unsure, beside, through };
    /// Where the line passes triangle i, if it is certain that no edge is as near as `near`.
    Pass far_from_edges(std::size_t i, const Triple<BoundedDouble>& o, const Triple<BoundedDouble>& d,
                        double near) const {
        const auto across = [](const Triple<BoundedDouble>& a,
                               const Triple<BoundedDouble>& b) -> Triple<BoundedDouble> {
            return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
        };
        const auto most = [](const Triple<BoundedDouble>& v) {
            const double x = v.x.most(), y = v.y.most(), z = v.z.most();
            return 1.000001 * std::sqrt(x * x + y * y + z * z);
        };
        const std::array<Triple<BoundedDouble>, 3> p{rough_[faces_[i][0]] - o, rough_[faces_[i][1]] - o,
                                                     rough_[faces_[i][2]] - o};
        // Seen along d: on which side of an edge's line the ray is, and on which the third corner.
        int clear = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Triple<BoundedDouble> edge = p[(k + 1) % 3] - p[k], side = across(d, edge);
            const BoundedDouble ray = dot(side, p[k]), corner = dot(side, p[(k + 2) % 3] - p[k]);
            if (!(ray.least() > near * most(side)) || !(corner.least() > 0)) continue;
            if ((ray.v > 0) == (corner.v > 0)) return Pass::beside;
            ++clear;
        }
        if (clear == 3) return Pass::through;
        // A triangle seen edge-on: before or behind it?
        const Triple<BoundedDouble> u = p[1] - p[0], v = p[2] - p[0], n = across(u, v);
        const Triple<BoundedDouble> side =
            across(d, {BoundedDouble(n.x.v), BoundedDouble(n.y.v), BoundedDouble(n.z.v)});
        int ahead = 0, behind = 0;
        for (const Triple<BoundedDouble>& corner : p) {
            const BoundedDouble off = dot(side, corner);
            if (!(off.least() > near * most(side))) return Pass::unsure;
            ++(off.v > 0 ? ahead : behind);
        }
        return ahead == 0 || behind == 0 ? Pass::beside : Pass::unsure;
    }
    bool is_far(std::size_t i, const QVec& o, const QVec& d, quad speed, double near) const {
        const BoundingSphere& sphere = tree_.spheres()[i];
        const QVec across = cross(QVec(sphere.center) - o, d);
        const quad reach = (quad(sphere.radius) + quad(near)) * speed;
        return dot(across, across) > reach * reach;
    }
    static quad to_segment(const QVec& a, const QVec& b) {  // from 0
        const QVec e = b - a;
        const quad square = dot(e, e);
        quad s = square > 0 ? -dot(a, e) / square : quad(0);
        s = smaller(larger(s, 0), 1);
        return length(a + s * e);
    }
    /// Of the line along d through 0 to the segment from p to q: as both are seen along d.
    static quad distance_to_edge(const QVec& p, const QVec& q, const QVec& d, quad speed) {
        const QVec u = quad(1) / speed * d;
        return to_segment(p - dot(p, u) * u, q - dot(q, u) * u);
    }

    std::vector<QVec> vertices_;
    std::vector<Face> faces_;
    std::vector<Triple<BoundedDouble>> rough_;  ///< vertices
    SphereTree tree_;
    std::vector<double> heights_;
};

}  // namespace csgrt::oracle
