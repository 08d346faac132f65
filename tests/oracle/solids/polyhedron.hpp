// arb4 to arb8 and arbn: the intersection of half-spaces.
//
// arb: each of the six faces (vertices 3210, 4567, 4730, 2651, 1540, 7623: BRL-CAD's order) lies in the plane through
// its first three vertices that differ and are not in line; a face with fewer is none. Outward is away from the mean of
// the eight vertices. A fourth vertex is only said to lie in that plane (BRL-CAD checks it, within a tolerance); if it
// does not, the half-spaces may meet far away, and what lies outside the box of the vertices is no part of the arb. The
// planes of that box come after the faces: to a convex arb they change nothing. An arb with flat faces that is not
// convex is no intersection of half-spaces: see concave_arb.hpp. condition: a plane through three points that are
// rounded by e tilts by e / (height of their triangle), and over the whole solid moves by e x radius / height.
//
// arbn: the half-spaces as given. Vertices are needed only for the bounding sphere.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "../concave_arb.hpp"
#include "../solid.hpp"

namespace csgrt::oracle {

struct Face {
    QVec normal;      ///< unit, of either side
    QVec on;          ///< a point of the plane
    quad height = 0;  ///< the least height of the triangle that gave it; 0: there is no face
};

/// Of arb's face with the four given vertices.
inline Face arb_face(const Arb& arb, const std::array<std::size_t, 4>& corners) {
    std::vector<QVec> points;
    for (const std::size_t corner : corners) {
        const QVec p = arb.vertices[corner];
        const bool known =
            std::any_of(points.begin(), points.end(), [&](const QVec& q) { return dot(p - q, p - q) == 0; });
        if (known) continue;
        points.push_back(p);
        if (points.size() < 3) continue;
        const QVec u = points[1] - points[0], v = points[2] - points[0], w = points[2] - points[1];
        const QVec n = cross(u, v);
        const quad longest = root(larger(larger(dot(u, u), dot(v, v)), dot(w, w))), height = length(n) / longest;
        if (height > longest * quad(1e-12)) return {unit(n), points[0], height};
        points.pop_back();  // in line with the two before it
    }
    return {};
}

inline ImplicitSolid implicit(const Arb& arb, const QAffine& place) {
    static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};
    if (is_concave(arb)) throw std::invalid_argument("an arb that is not convex is no intersection of half-spaces");
    ImplicitSolid solid;
    QVec mean;
    for (const Vec3& vertex : arb.vertices) mean = mean + quad(0.125) * QVec(vertex);
    add_frame(solid, place, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, mean});
    quad reach = 0, own_reach = 0;
    for (const Vec3& vertex : arb.vertices) {
        own_reach = larger(own_reach, length(QVec(vertex) - mean));
        reach = larger(reach, length(solid.to_world.direction(QVec(vertex) - mean)));
    }
    quad tilt = 1;
    bool convex = true;
    for (const auto& corners : faces) {
        const Face face = arb_face(arb, corners);
        if (!(face.height > 0)) continue;
        tilt = larger(tilt, own_reach / face.height);
        const quad distance = dot(face.normal, face.on - mean);
        const PlaneFunction outward =
            distance < 0 ? PlaneFunction{-face.normal, -distance} : PlaneFunction{face.normal, distance};
        for (const Vec3& vertex : arb.vertices)
            convex = convex && dot(outward.normal, QVec(vertex) - mean) <= outward.distance + quad(1e-12) * own_reach;
        solid.add(outward);
    }
    QVec low = QVec(arb.vertices[0]) - mean, high = low;
    for (const Vec3& vertex : arb.vertices) {
        const QVec p = QVec(vertex) - mean;
        low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
        high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
    }
    solid.add(PlaneFunction{{1, 0, 0}, high.x}), solid.add(PlaneFunction{{-1, 0, 0}, -low.x});
    solid.add(PlaneFunction{{0, 1, 0}, high.y}), solid.add(PlaneFunction{{0, -1, 0}, -low.y});
    solid.add(PlaneFunction{{0, 0, 1}, high.z}), solid.add(PlaneFunction{{0, 0, -1}, -low.z});
    solid.condition *= to_double(tilt);
    // The box of the vertices has corners up to sqrt(3) times as far away as they are, before it is stretched.
    const QAffine& w = solid.to_world;
    const quad stretch = root(dot(w.x, w.x) + dot(w.y, w.y) + dot(w.z, w.z));
    solid.size = 1.001 * to_double(reach);
    solid.radius = convex ? solid.size : 1.75 * to_double(stretch * own_reach);
    return solid;
}

/// The vertices of a bounded intersection of half-spaces: each triple of planes tried, first in double.
inline std::vector<QVec> vertices_of(const std::vector<Plane>& planes) {
    const auto inside = [&](const QVec& p) {
        const Vec3 q = to_vec3(p);
        const double slack = 1e-12 * (std::abs(q.x) + std::abs(q.y) + std::abs(q.z) + 1);
        return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
            const Vec3& n = plane.normal;
            const double limit = plane.distance + slack + 1e-15 * std::abs(plane.distance);
            if (n.x * q.x + n.y * q.y + n.z * q.z > limit + 1e-9 * (std::abs(limit) + slack * 1e12)) return false;
            return dot(QVec(n), p) <= limit;
        });
    };
    std::vector<QVec> vertices;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            const QVec a = planes[i].normal, b = planes[j].normal, edge = cross(a, b);
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                const QVec c = planes[k].normal;
                const quad volume = dot(edge, c);
                if (absolute(volume) < quad(1e-12)) continue;
                const QVec p =
                    (1 / volume) * (quad(planes[i].distance) * cross(b, c) + quad(planes[j].distance) * cross(c, a) +
                                    quad(planes[k].distance) * edge);
                if (inside(p)) vertices.push_back(p);
            }
        }
    return vertices;
}

inline ImplicitSolid implicit(const Arbn& arbn, const QAffine& place) {
    ImplicitSolid solid;
    const std::vector<QVec> vertices = vertices_of(arbn.planes);
    QVec mean;
    for (const QVec& vertex : vertices) mean = mean + (1 / quad(static_cast<double>(vertices.size()))) * vertex;
    add_frame(solid, place, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, mean});
    quad reach = 0;
    for (const QVec& vertex : vertices) reach = larger(reach, length(solid.to_world.direction(vertex - mean)));
    for (const Plane& plane : arbn.planes) {
        const QVec n = plane.normal;
        solid.add(PlaneFunction{n, plane.distance - dot(n, mean)});
        // The plane's own numbers are rounded, too: its distance from the origin counts like a placement.
        solid.placement =
            std::max(solid.placement, std::abs(plane.distance) * to_double(length(solid.to_world.direction(n))));
    }
    solid.radius = 1.001 * to_double(reach);
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
