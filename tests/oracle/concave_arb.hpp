// An arb whose faces are flat, but which is not convex: the polyhedron that its faces enclose.
//
// A face is the outline through its vertices that differ, in BRL-CAD's order. It is flat if no vertex lies off the
// plane of its widest triangle by more than the lesser of 0.0005 mm and 1e-6 of the arb's size. A polyhedron is convex
// if it lies on one side of the plane of each of its faces. Where it is not, a point is inside if any ray from it meets
// the faces an odd number of times (Jordan's theorem); a point of a face's plane is in the face if any ray in the plane
// meets the outline an odd number of times.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mesh_solids.hpp"

namespace csgrt::oracle {

struct ArbOutline {
    std::vector<QVec> ring;  ///< 3 or 4 vertices
    QVec normal, on;         ///< of its widest triangle; unit
    quad height = 0;         ///< the least of that triangle's
};

/// The faces of an arb that have an area.
inline std::vector<ArbOutline> outlines_of(const Arb& arb) {
    static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};
    const auto same = [](const QVec& a, const QVec& b) { return dot(a - b, a - b) == 0; };
    std::vector<ArbOutline> outlines;
    for (const auto& face : faces) {
        ArbOutline outline;
        std::vector<QVec>& ring = outline.ring;
        for (const std::size_t corner : face)
            if (ring.empty() || !same(ring.back(), arb.vertices[corner])) ring.push_back(arb.vertices[corner]);
        while (ring.size() > 1 && same(ring.front(), ring.back())) ring.pop_back();
        if (ring.size() < 3 || (ring.size() == 4 && (same(ring[0], ring[2]) || same(ring[1], ring[3])))) continue;
        quad widest = 0;
        for (std::size_t skip = 0; skip < (ring.size() == 3 ? 1 : ring.size()); ++skip) {
            std::vector<QVec> t = ring;
            if (t.size() == 4) t.erase(t.begin() + static_cast<std::ptrdiff_t>(skip));
            const QVec n = cross(t[1] - t[0], t[2] - t[0]);
            const quad area = length(n);
            if (!(area > widest)) continue;
            widest = area;
            quad longest = 0;
            for (std::size_t k = 0; k < 3; ++k) longest = larger(longest, length(t[(k + 1) % 3] - t[k]));
            outline.normal = unit(n);
            outline.on = t[0];
            outline.height = area / longest;
        }
        if (widest > 0) outlines.push_back(std::move(outline));
    }
    return outlines;
}

/// Are its faces flat, and does it lie on both sides of one of them, by more than rounding may displace a vertex?
inline bool is_concave(const Arb& arb) {
    QVec low = arb.vertices[0], high = low;
    quad reach = 0;
    for (const Vec3& vertex : arb.vertices) {
        const QVec p = vertex;
        low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
        high = {larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z)};
        reach = larger(reach, length(p));
    }
    const quad size = length(high - low);
    const std::vector<ArbOutline> outlines = outlines_of(arb);
    quad uneven = 0;
    for (const ArbOutline& face : outlines)
        for (const QVec& p : face.ring) uneven = larger(uneven, absolute(dot(face.normal, p - face.on)));
    if (uneven > smaller(quad(0.0005), quad(1e-6) * size)) return false;
    const quad rounding = uneven + quad(2 * double_epsilon) * reach;
    return std::any_of(outlines.begin(), outlines.end(), [&](const ArbOutline& face) {
        quad above = 0, below = 0;
        for (const Vec3& vertex : arb.vertices) {
            const quad off = dot(face.normal, QVec(vertex) - face.on);
            above = larger(above, off), below = larger(below, -off);
        }
        return smaller(above, below) > larger(quad(1e-12) * size, 4 * rounding * (1 + size / face.height));
    });
}

/// Is a point inside the polyhedron of the arb's faces? By a ray in a direction that no model has.
inline bool contains(const Arb& arb, const QVec& p) {
    const QVec d{quad(0.3178), quad(-0.5931), quad(0.7402)};
    bool inside = false;
    for (const ArbOutline& face : outlines_of(arb)) {
        const quad rate = dot(face.normal, d);
        if (rate == 0) continue;
        const quad t = dot(face.normal, face.on - p) / rate;
        if (!(t > 0)) continue;
        const QVec x = any_across(face.normal), y = cross(face.normal, x), at = p + t * d;
        bool within = false;
        for (std::size_t i = 0, n = face.ring.size(); i < n; ++i) {
            const QVec a = face.ring[i] - at, b = face.ring[(i + 1) % n] - at;
            const quad ay = dot(a, y), by = dot(b, y);
            if ((ay > 0) == (by > 0)) continue;
            const quad ax = dot(a, x), bx = dot(b, x);
            if (ax + (bx - ax) * ay / (ay - by) > 0) within = !within;
        }
        inside = inside != within;
    }
    return inside;
}

/// Its surface. Of the two diagonals of a face the one that lies within it makes two triangles that turn the same way.
inline Parts parts_of(const Arb& arb) {
    Parts parts;
    for (const ArbOutline& face : outlines_of(arb)) {
        const std::vector<QVec>& r = face.ring;
        const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
            return dot(face.normal, cross(r[b] - r[a], r[c] - r[a]));
        };
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            parts.triangle(to_vec3(r[a]), to_vec3(r[b]), to_vec3(r[c]));
        };
        if (r.size() == 3) {
            triangle(0, 1, 2);
        } else if ((turn(0, 1, 2) >= 0) == (turn(0, 2, 3) >= 0)) {
            triangle(0, 1, 2), triangle(0, 2, 3);
        } else {
            triangle(0, 1, 3), triangle(1, 2, 3);
        }
    }
    return parts;
}

}  // namespace csgrt::oracle
