#include "compile/solids/polyhedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace csgrt {

namespace {

// Limits below which two corners are one, for an arb that is not convex by its exact numbers. BRL-CAD merges at 0.0005
// mm, whatever the size; a small arb needs a finer limit.
constexpr long double same_corner = 0.0005L;         // millimetres
constexpr long double same_corner_relative = 1e-6L;  // of the arb's diagonal, if this is less
// The distance that rounding leaves between equal corners.
constexpr long double equal_corner_relative = 1e-15L;
// A third corner closer to the line through the first two than this, relative to their distance, does not fix the
// plane; the limit is `equal_corner_relative` for arbs that are convex by their exact numbers.
constexpr long double in_line_relative = 1e-6L;
// The distance by which a corner may leave its plane, relative to the arb's diagonal, without making a twisted face.
constexpr long double flat = 1e-12L;

Vec3 without_negative_zero(const Vec3& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

Plane plane_of(const Wide& p, const Wide& unit) {
    return {without_negative_zero(narrow(unit)), static_cast<double>(glm::dot(unit, p)) + 0.0};
}

}  // namespace

Plane plane_through(const Wide& p, const Wide& normal) { return plane_of(p, glm::normalize(normal)); }

Plane transform_plane(const Matrix& matrix, const Plane& plane) {
    const Wide n = wide(plane.normal);
    const Wide on = transform_point(matrix, n * (plane.distance / glm::dot(n, n)));
    return plane_through(on, glm::transpose(glm::inverse(linear_part(matrix))) * n);
}

std::vector<Plane> arbn_faces(const Arbn& arbn, const Matrix& matrix) {
    std::vector<Plane> planes;
    planes.reserve(arbn.planes.size());
    for (const Plane& plane : arbn.planes) planes.push_back(transform_plane(matrix, plane));
    return planes;
}

namespace {

// Clips to the box of the corners. The half-spaces of a concave arb's faces can meet far away from the arb, but the arb
// has no part outside the corners' box.
void clip_to_corners(const Arb& arb, const Matrix& matrix, std::vector<Plane>& planes) {
    Box box = empty_box;
    for (const Vec3& corner : arb.vertices) extend(box, corner);
    for (const Plane& side :
         {Plane{{1, 0, 0}, box.high.x}, Plane{{-1, 0, 0}, -box.low.x}, Plane{{0, 1, 0}, box.high.y},
          Plane{{0, -1, 0}, -box.low.y}, Plane{{0, 0, 1}, box.high.z}, Plane{{0, 0, -1}, -box.low.z}})
        planes.push_back(transform_plane(matrix, side));
}

/// sqrt(a) > sqrt(b), with rounded roots. The roots are computed only where the squares differ by very little.
bool longer(long double a, long double b) {
    if (a <= b) return false;
    return a > b * (1 + 1e-17L) || std::sqrt(a) > std::sqrt(b);
}

/// Are two vectors closer than `limit`? The components are tested first, which is faster.
bool closer(const Wide& a, const Wide& b, long double limit) {
    const Wide d = a - b;
    if (std::fabs(d.x) >= limit || std::fabs(d.y) >= limit || std::fabs(d.z) >= limit) return false;
    return glm::length(d) < limit;
}

/// A vector perpendicular to a triangle, twice its area long, from its two shorter sides: the rounding of a cross
/// product is relative to the product of the lengths, and in a sliver the two long sides would leave little but
/// rounding.
Wide normal_of(const Wide& a, const Wide& b, const Wide& c) {
    const std::array<Wide, 3> sides{b - a, c - b, a - c};
    std::array<long double, 3> squares;
    for (std::size_t i = 0; i < 3; ++i) squares[i] = glm::dot(sides[i], sides[i]);
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (longer(squares[i], squares[longest])) longest = i;
    return glm::cross(sides[(longest + 1) % 3], sides[(longest + 2) % 3]);
}

/// The rule that chooses three corners of a face; the face's plane goes through them.
enum class Through {
    first,   ///< the first three that span a plane, as BRL-CAD chooses; this matters where a face is twisted
    widest,  ///< the widest triangle, whose rounding tilts the plane least; this matters where one end of a face is a
             ///< sliver
};

struct Triangle {
    Wide corner, normal;
};

/// Corners 0, 1, 2 if they are as wide as any three: opposite sides are equal to the last bit and shorter than both
/// diagonals, so all four triangles have the same two shorter sides. nullopt: a closer test is needed.
std::optional<Triangle> half_of_rectangle(const std::array<Wide, 4>& corners, long double in_line) {
    const Wide u = corners[1] - corners[0], v = corners[2] - corners[1];
    if (corners[2] - corners[3] != u || corners[3] - corners[0] != v) return std::nullopt;
    const Wide d = corners[2] - corners[0], e = corners[3] - corners[1];
    const long double uu = glm::dot(u, u), shorter = std::min(glm::dot(d, d), glm::dot(e, e));
    if (!longer(shorter, uu) || !longer(shorter, glm::dot(v, v))) return std::nullopt;
    const Wide normal = glm::cross(u, v);
    const long double square = glm::dot(normal, normal), least = in_line * uu;
    if (!(square > least * least * (1 + 1e-17L))) return std::nullopt;
    return Triangle{corners[0], normal};
}

/// The three corners that span a face. `corners`: the `count` corners of a face, each once. nullopt: all corners are
/// nearly in line.
std::optional<Triangle> spanning(const std::array<Wide, 4>& corners, std::size_t count, long double in_line,
                                 Through through) {
    if (count == 4 && through == Through::widest)
        if (const std::optional<Triangle> half = half_of_rectangle(corners, in_line)) return half;
    std::optional<Triangle> best;
    long double best_square = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            for (std::size_t k = j + 1; k < count; ++k) {
                const Wide normal = normal_of(corners[i], corners[j], corners[k]), along = corners[j] - corners[i];
                const long double square = glm::dot(normal, normal), least = in_line * glm::dot(along, along);
                if (!(square > least * least * (1 + 1e-17L)) && std::sqrt(square) < least) continue;
                if (best && !longer(square, best_square)) continue;
                best = Triangle{corners[i], normal};
                best_square = square;
                if (through == Through::first) return best;
            }
    return best;
}

/// The faces through the corners. Corners closer than `same` are one, and corners nearly in line span no face.
ArbFaces faces_through(const std::array<Wide, 8>& corners, long double same, long double in_line, long double size,
                       Through through) {
    static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};

    Wide mean(0);
    for (const Wide& corner : corners) mean += corner * 0.125L;

    // Equal corners become one, the first of them, in every face.
    std::array<std::size_t, 8> first_of{};
    for (std::size_t i = 0; i < 8; ++i) {
        first_of[i] = i;
        for (std::size_t j = 0; j < i; ++j) {
            if (closer(corners[i], corners[j], same)) {
                first_of[i] = first_of[j];
                break;
            }
        }
    }

    ArbFaces result;
    result.is_hull = true;
    result.planes.reserve(faces.size());
    const long double above_flat = flat * size;
    for (const auto& face : faces) {
        std::array<std::size_t, 4> distinct;
        std::array<Wide, 4> of_face;
        std::size_t count = 0;
        for (const std::size_t corner : face) {
            const auto end = distinct.begin() + static_cast<std::ptrdiff_t>(count);
            if (std::find(distinct.begin(), end, first_of[corner]) != end) continue;
            distinct[count] = first_of[corner];
            of_face[count++] = corners[first_of[corner]];
        }
        const std::optional<Triangle> triangle = spanning(of_face, count, in_line, through);
        if (!triangle) continue;
        const Wide on = triangle->corner;
        Wide normal = triangle->normal;
        if (glm::dot(normal, on - mean) < 0) normal = -normal;
        const Wide unit = glm::normalize(normal);
        result.planes.push_back(plane_of(on, unit));

        std::array<bool, 8> below;
        for (std::size_t i = 0; i < 8; ++i) {
            const long double above = glm::dot(unit, corners[i] - on);
            if (above > above_flat) result.is_hull = false;
            below[i] = above < -above_flat;
        }
        for (const std::size_t i : face)
            if (below[i]) result.is_hull = false;
    }
    if (result.planes.size() < 4) result.is_hull = false;
    return result;
}

}  // namespace

ArbFaces arb_faces(const Arb& arb, const Matrix& matrix) {
    std::array<Wide, 8> corners;
    Wide low(infinity), high(-infinity);
    for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = transform_point(matrix, wide(arb.vertices[i]));
        low = glm::min(low, corners[i]);
        high = glm::max(high, corners[i]);
    }
    const long double size = glm::length(high - low);
    // An arb that is convex by its exact numbers is used as it is, however thin. In other arbs nearly equal corners may
    // span a face that is only rounding.
    ArbFaces result =
        faces_through(corners, equal_corner_relative * size, equal_corner_relative, size, Through::widest);
    if (result.is_hull) return result;
    result = faces_through(corners, std::min(same_corner, same_corner_relative * size), in_line_relative, size,
                           Through::first);
    if (!result.is_hull) clip_to_corners(arb, matrix, result.planes);
    return result;
}

}  // namespace csgrt
