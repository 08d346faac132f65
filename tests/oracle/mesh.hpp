// Surfaces of triangles in 113 bits, without a hierarchy: what a ray crosses, how far a point is from the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/renderer.hpp>

#include "reach.hpp"

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
        for (const Vec3& vertex : vertices) vertices_.push_back(place.point(vertex));
        QVec low = at(0, 0), high = low;
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const QVec &p = at(i, k), local = vertices[faces[i][k]];
                low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
                high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
                placement = std::max(placement, to_double(length(rounding.point(componentwise_absolute(local)))));
            }
        center = quad(0.5) * (low + high);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            QVec middle;
            for (std::size_t k = 0; k < 3; ++k) {
                radius = std::max(radius, to_double(length(at(i, k) - center)));
                middle = middle + quad(1) / 3 * at(i, k);
            }
            Reach ball{to_vec3(middle), 0};
            for (std::size_t k = 0; k < 3; ++k)
                ball.radius = std::max(ball.radius, 1.001 * to_double(length(at(i, k) - middle)));
            balls_.push_back(ball);
            const QVec n = cross(at(i, 1) - at(i, 0), at(i, 2) - at(i, 0));
            normals_.push_back(dot(n, n) > 0 ? unit(n) : QVec{});
            quad longest = 0;
            for (std::size_t k = 0; k < 3; ++k) longest = larger(longest, length(at(i, k) - at(i, (k + 1) % 3)));
            heights_.push_back(longest > 0 ? to_double(length(n) / longest) : 0);
        }
    }

    std::size_t size() const { return faces_.size(); }
    const QVec& at(std::size_t triangle, std::size_t corner) const { return vertices_[faces_[triangle][corner]]; }
    const QVec& normal(std::size_t triangle) const { return normals_[triangle]; }  ///< unit; zero: it has no area
    double height(std::size_t triangle) const { return heights_[triangle]; }       ///< the least of its three
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
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (balls_[i].is_passed_by(from, way, near) || is_far(i, o, d, speed, near)) continue;
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
            if (sides[0] == 0 || sides[0] != sides[1] || sides[1] != sides[2]) continue;
            const quad rate = dot(normals_[i], d);
            if (rate == 0) continue;
            found.all.push_back({dot(normals_[i], at(i, 0) - o) / rate, i, absolute(rate) / speed});
        }
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
        const QVec a = at(i, 0) - p, b = at(i, 1) - p, c = at(i, 2) - p, n = normals_[i];
        quad nearest = smaller(to_segment(a, b), smaller(to_segment(b, c), to_segment(c, a)));
        if (dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0 && dot(n, n) > 0)
            nearest = smaller(nearest, absolute(dot(n, a)));
        return nearest;
    }
    /// Is p within `reach` of triangle i?
    bool is_near(std::size_t i, const QVec& p, quad reach) const {
        const QVec to_ball = QVec(balls_[i].center) - p;
        const quad far = quad(balls_[i].radius) + reach;
        return dot(to_ball, to_ball) <= far * far && distance(i, p) <= reach;
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
    bool is_far(std::size_t i, const QVec& o, const QVec& d, quad speed, double near) const {
        const QVec across = cross(QVec(balls_[i].center) - o, d);
        const quad reach = (quad(balls_[i].radius) + quad(near)) * speed;
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
    std::vector<Reach> balls_;
    std::vector<QVec> normals_;
    std::vector<double> heights_;
};

}  // namespace csgrt::oracle
