#include "scene/solids/polytope.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "scene/vector.hpp"

namespace csgrt {

namespace {

using Loop = std::vector<Vec3>;  // the corners of a face, in order around it

/// A face and a sphere around it. Most planes miss most faces, and a test of the sphere tells this quickly.
struct Face {
    Loop loop;
    Vec3 center;
    double radius = 0;

    explicit Face(Loop corners) : loop(std::move(corners)) {
        if (!loop.empty()) center = loop.front();
        for (const Vec3& p : loop) radius = std::max(radius, length(p - center));
    }
};

/// Half the side of the first cube, in units of the farthest plane's distance.
constexpr double reach_factor = 1e6;

bool before(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The point where the edge from p to q meets a plane, from the points' distances to the plane. The two faces that
/// share the edge have it in opposite directions and must get the same bits, so the two points are sorted first.
Vec3 cut(Vec3 p, double p_distance, Vec3 q, double q_distance) {
    if (before(q, p)) {
        std::swap(p, q);
        std::swap(p_distance, q_distance);
    }
    return p + (p_distance / (p_distance - q_distance)) * (q - p);
}

std::vector<Face> cube(const Vec3& center, double reach) {
    const auto corner = [&](int i) {
        return center + Vec3{i & 1 ? reach : -reach, i & 2 ? reach : -reach, i & 4 ? reach : -reach};
    };
    std::vector<Face> faces;
    for (const auto& face : {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                             std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
        faces.emplace_back(Loop{corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
    }
    return faces;
}

/// The new face that a cut makes: sorts its corners around their middle.
Loop cap(const Vec3& normal, Loop corners) {
    std::sort(corners.begin(), corners.end(), before);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    Vec3 middle;
    for (const Vec3& corner : corners) middle = middle + (1.0 / static_cast<double>(corners.size())) * corner;
    const Vec3 across = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = unit(cross(normal, across)), v = cross(normal, u);
    const auto angle = [&](const Vec3& p) { return std::atan2(dot(p - middle, v), dot(p - middle, u)); };
    std::sort(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
    return corners;
}

void clip(std::vector<Face>& faces, const Plane& plane) {
    const auto distance = [&](const Vec3& p) { return dot(plane.normal, p) - plane.distance; };
    Loop corners;
    bool lost = false;
    for (Face& face : faces) {
        // Twice the radius is tested: so that a corner outside is not missed by rounding.
        if (distance(face.center) < -2 * face.radius) continue;
        const Loop& loop = face.loop;
        if (std::none_of(loop.begin(), loop.end(), [&](const Vec3& p) { return distance(p) > 0; })) continue;
        Loop kept;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &p = loop[i], &q = loop[(i + 1) % loop.size()];
            const double p_distance = distance(p), q_distance = distance(q);
            if (p_distance <= 0) kept.push_back(p);
            if ((p_distance <= 0) != (q_distance <= 0)) {
                kept.push_back(cut(p, p_distance, q, q_distance));
                corners.push_back(kept.back());
            }
        }
        lost = lost || kept.size() < 3;
        face = Face(std::move(kept));
    }
    if (lost) std::erase_if(faces, [](const Face& face) { return face.loop.size() < 3; });
    Loop last = cap(plane.normal, std::move(corners));
    if (last.size() >= 3) faces.emplace_back(std::move(last));
}

std::vector<Vec3> clipped_cube(const std::vector<Plane>& planes, const Vec3& center, double reach) {
    std::vector<Face> faces = cube(center, reach);
    for (const Plane& plane : planes) clip(faces, plane);
    std::vector<Vec3> vertices;
    for (const Face& face : faces) vertices.insert(vertices.end(), face.loop.begin(), face.loop.end());
    return vertices;
}

}  // namespace

Polytope intersect_half_spaces(const std::vector<Plane>& planes) {
    double farthest = 0;
    for (const Plane& plane : planes) farthest = std::max(farthest, std::abs(plane.distance));
    const double reach = farthest > 0 ? reach_factor * farthest : 1;

    Polytope result;
    result.vertices = clipped_cube(planes, {}, reach);
    if (result.vertices.empty()) return result;

    Vec3 low = result.vertices.front(), high = low;
    for (const Vec3& p : result.vertices) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double edge = reach * (1 - 1e-6);
    if (std::min({low.x, low.y, low.z}) <= -edge || std::max({high.x, high.y, high.z}) >= edge) {
        result.kind = Polytope::Kind::unbounded;
        result.vertices.clear();
        return result;
    }

    // The planes are clipped again, from a box close around the polytope, so that numbers are small and rounding is
    // less.
    const Vec3 center = 0.5 * (low + high);
    std::vector<Plane> near = planes;
    for (Plane& plane : near) plane.distance -= dot(plane.normal, center);
    result.vertices = clipped_cube(near, {}, std::max(length(high - low), 1e-9 * farthest));
    if (result.vertices.empty()) return result;

    Vec3 middle;
    for (Vec3& p : result.vertices) middle = middle + (1.0 / static_cast<double>(result.vertices.size())) * p;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * farthest;
    const bool inside = std::all_of(near.begin(), near.end(), [&](const Plane& plane) {
        return dot(plane.normal, middle) < plane.distance - rounding;
    });
    if (!inside) {
        result.vertices.clear();
        return result;
    }
    for (Vec3& p : result.vertices) p = p + center;
    result.kind = Polytope::Kind::bounded;
    return result;
}

}  // namespace csgrt
