#include "scene/solids/arb_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/vector.hpp"

namespace csgrt {

namespace {

constexpr double most_uneven = 0.0005;          // millimetres
constexpr double most_uneven_relative = 1e-6;   // relative to the arb's size, if this gives less
constexpr double least_depth_relative = 4e-12;  // relative to the arb's size; above polyhedron.cpp's depth of flat arbs
constexpr double cancelled = 1e-9;              // relative to a sum's terms: below this, the sum counts as 0

double sum_of_sizes(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// A quick test, true only for convex arbs, and for most of them: does each face have the whole arb on one side, and
/// turn in the same direction at each corner?
bool plainly_convex(const Arb& arb) {
    constexpr double rounding = 1e-13;
    const auto& v = arb.vertices;
    double size = 0;
    for (std::size_t i = 1; i < 8; ++i) size = std::max(size, sum_of_sizes(v[i] - v[0]));
    for (const auto& face : arb_face_vertices) {
        const Vec3 &a = v[face[0]], &b = v[face[1]], &c = v[face[2]], &d = v[face[3]];
        if ((a == b && c == d) || (a == d && b == c)) continue;  // the face is an edge or a point
        const Vec3 ab = b - a, bc = c - b, cd = d - c, da = a - d, n = cross(c - a, d - b);
        const double steep = sum_of_sizes(n), slack = rounding * steep * size;
        if (!(steep > 1e-9 * size * size)) return false;
        double low = 0, high = 0;
        for (const Vec3& p : v) {
            const double off = dot(n, p - a);
            low = std::min(low, off);
            high = std::max(high, off);
        }
        if (low < -slack && high > slack) return false;
        const double least = -rounding * steep * size * size;
        if (dot(n, cross(ab, bc)) < least || dot(n, cross(bc, cd)) < least || dot(n, cross(cd, da)) < least ||
            dot(n, cross(da, ab)) < least)
            return false;
    }
    return true;
}

// Vectors of long double: with doubles, rounding would tilt the plane of a narrow face too much.
struct Wide {
    long double x = 0, y = 0, z = 0;
};
Wide from_to(const Vec3& a, const Vec3& b) {
    return {static_cast<long double>(b.x) - a.x, static_cast<long double>(b.y) - a.y,
            static_cast<long double>(b.z) - a.z};
}
long double dot(const Wide& a, const Wide& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Wide cross(const Wide& a, const Wide& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double length(const Wide& a) { return std::sqrt(dot(a, a)); }

/// A face's outline, without repeated vertices. Empty if the face has no area.
struct Outline {
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;
    Wide normal;        ///< the unit normal of the outline's widest triangle
    Vec3 on;            ///< a corner of this triangle
    double height = 0;  ///< the least of this triangle's three heights

    double above(const Vec3& p) const { return static_cast<double>(dot(normal, from_to(on, p))); }
};

Outline outline_of(const Arb& arb, std::size_t face) {
    Outline outline;
    for (std::uint32_t corner : arb_face_vertices[face]) {
        for (std::uint32_t i = 0; i < corner; ++i)
            if (arb.vertices[i] == arb.vertices[corner]) corner = i;
        if (outline.count == 0 || outline.corners[outline.count - 1] != corner)
            outline.corners[outline.count++] = corner;
    }
    while (outline.count > 1 && outline.corners[0] == outline.corners[outline.count - 1]) --outline.count;
    const auto& c = outline.corners;
    // Four corners of which two opposite ones are the same: the outline goes along an edge and back, and has no area.
    if (outline.count < 3 || (outline.count == 4 && (c[0] == c[2] || c[1] == c[3]))) return {};
    return outline;
}

void find_plane(const Arb& arb, Outline& outline) {
    long double widest = 0;
    const auto& c = outline.corners;
    for (std::size_t skip = outline.count == 3 ? 3 : 0; skip < 4; ++skip) {
        const std::size_t i = skip == 0 ? 1 : 0, j = skip <= 1 ? 2 : 1, k = skip <= 2 ? 3 : 2;
        const Vec3 &p = arb.vertices[c[i]], &q = arb.vertices[c[j]], &r = arb.vertices[c[k]];
        const Wide pq = from_to(p, q), qr = from_to(q, r), rp = from_to(r, p);
        const long double longest = std::max({length(pq), length(qr), length(rp)});
        // The normal is computed from the two shorter sides: these have the least rounding errors.
        const Wide n = longest == length(pq) ? cross(qr, rp) : longest == length(qr) ? cross(rp, pq) : cross(pq, qr);
        const long double area = length(n);
        if (!(area > widest)) continue;
        widest = area;
        outline.normal = {n.x / area, n.y / area, n.z / area};
        outline.on = p;
        outline.height = static_cast<double>(area / longest);
    }
    if (widest == 0) outline.count = 0;
}

/// All faces of an arb, and its size.
struct Form {
    std::array<Outline, 6> faces;
    double size = 0;
    double rounding = 0;  ///< the distance by which rounding may move vertices
    bool is_flat = false, is_concave = false;

    /// The distance from a face's plane within which a vertex counts as in the plane. It is larger for a narrow face,
    /// because its vertices' rounding tilts the plane.
    double depth_of(const Outline& face) const {
        return std::max(least_depth_relative * size, 4 * rounding * (1 + size / face.height));
    }
};

Form form_of(const Arb& arb) {
    Form form;
    double size = 0, reach = 0, uneven = 0;
    for (const Vec3& v : arb.vertices) {
        reach = std::max(reach, length(v));
        for (const Vec3& w : arb.vertices) size = std::max(size, length(v - w));
    }
    for (std::size_t i = 0; i < form.faces.size(); ++i) {
        Outline& face = form.faces[i];
        face = outline_of(arb, i);
        if (face.count > 0) find_plane(arb, face);
        for (std::size_t k = 0; k < face.count; ++k)
            uneven = std::max(uneven, std::abs(face.above(arb.vertices[face.corners[k]])));
    }
    if (uneven > std::min(most_uneven, most_uneven_relative * size)) return form;
    form.is_flat = true;
    form.size = size;
    form.rounding = uneven + 4 * std::numeric_limits<double>::epsilon() * reach;
    for (const Outline& face : form.faces) {
        if (face.count == 0) continue;
        double above = 0, below = 0;
        for (const Vec3& v : arb.vertices) {
            const double off = face.above(v);
            above = std::max(above, off);
            below = std::max(below, -off);
        }
        form.is_concave = form.is_concave || std::min(above, below) > form.depth_of(face);
    }
    return form;
}

bool crosses_itself(const Arb& arb, const Outline& face, double rounding) {
    if (face.count < 4) return false;
    const auto at = [&](std::size_t i) -> const Vec3& { return arb.vertices[face.corners[i % 4]]; };
    // Whether an edge's line separates two vertices: they lie strictly on different sides.
    const auto parts = [&](std::size_t edge, std::size_t p, std::size_t q) {
        const Wide along = from_to(at(edge), at(edge + 1)), side = cross(face.normal, along);
        const long double a = dot(side, from_to(at(edge), at(p))), b = dot(side, from_to(at(edge), at(q)));
        return std::min(std::abs(a), std::abs(b)) > 4 * rounding * length(along) && (a > 0) != (b > 0);
    };
    return (parts(0, 2, 3) && parts(2, 0, 1)) || (parts(1, 3, 0) && parts(3, 1, 2));
}

}  // namespace

bool is_concave(const Arb& arb) { return !plainly_convex(arb) && form_of(arb).is_concave; }

bool is_without_volume(const Arb& arb) {
    // This test suffices for most arbs.
    const auto& v = arb.vertices;
    double size = 0, rough = 0;
    for (std::size_t i = 1; i < 8; ++i) size = std::max(size, sum_of_sizes(v[i] - v[0]));
    for (const auto& face : arb_face_vertices)
        for (std::size_t i = 2; i < 4; ++i)
            rough += dot(v[face[0]] - v[0], cross(v[face[i - 1]] - v[0], v[face[i]] - v[0]));
    if (std::abs(rough) > 1e-9 * size * size * size) return false;
    const Form form = form_of(arb);
    if (!form.is_flat) return false;
    // An arb encloses nothing if in each plane the faces' signed areas cancel, and their first moments cancel, too.
    for (const Outline& plane : form.faces) {
        if (plane.count == 0) continue;
        const double near = form.depth_of(plane);
        long double area = 0, all = 0;
        Wide moment;
        for (const Outline& face : form.faces) {
            const auto lies_off = [&](std::uint32_t i) { return std::abs(plane.above(v[i])) > near; };
            if (std::any_of(face.corners.begin(), face.corners.begin() + static_cast<std::ptrdiff_t>(face.count),
                            lies_off))
                continue;
            for (std::size_t i = 2; i < face.count; ++i) {
                const Vec3 &p = v[face.corners[0]], &q = v[face.corners[i - 1]], &r = v[face.corners[i]];
                const long double part = dot(plane.normal, cross(from_to(p, q), from_to(p, r)));
                const Wide x = from_to(plane.on, p), y = from_to(plane.on, q), z = from_to(plane.on, r);
                area += part;
                all += std::abs(part);
                moment.x += part * (x.x + y.x + z.x);
                moment.y += part * (x.y + y.y + z.y);
                moment.z += part * (x.z + y.z + z.z);
            }
        }
        if (std::abs(area) > cancelled * all || length(moment) > cancelled * all * form.size) return false;
    }
    return true;
}

std::optional<std::size_t> crossing_face(const Arb& arb) {
    if (plainly_convex(arb)) return std::nullopt;
    const Form form = form_of(arb);
    if (!form.is_concave) return std::nullopt;
    for (std::size_t i = 0; i < form.faces.size(); ++i)
        if (crosses_itself(arb, form.faces[i], form.rounding)) return i;
    return std::nullopt;
}

std::vector<std::vector<std::uint32_t>> outlines_of(const Arb& arb) {
    std::vector<std::vector<std::uint32_t>> outlines;
    for (std::size_t i = 0; i < arb_face_vertices.size(); ++i)
        if (const Outline face = outline_of(arb, i); face.count > 0)
            outlines.emplace_back(face.corners.begin(), face.corners.begin() + static_cast<std::ptrdiff_t>(face.count));
    return outlines;
}

}  // namespace csgrt
