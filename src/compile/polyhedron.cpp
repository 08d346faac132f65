#include "compile/polyhedron.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace csgrt {

namespace {

// Corners closer than this are one, where an arb is not convex as its numbers say. BRL-CAD merges at 0.0005 mm,
// whatever the size; a small arb needs a finer measure.
constexpr long double same_corner = 0.0005L;         // millimetres
constexpr long double same_corner_relative = 1e-6L;  // of the arb's diagonal, if that is less
// What rounding leaves between corners that are one.
constexpr long double equal_corner_relative = 1e-15L;
// A third corner closer to the line through the first two than this, relative to their distance, says nothing of the
// plane; `equal_corner_relative` where thin arbs are taken at their word.
constexpr long double in_line_relative = 1e-6L;
// Corners may leave their plane by this, relative to the arb's diagonal, without being seen as a twisted face.
constexpr long double flat = 1e-12L;

Vec3 without_negative_zero(const Vec3& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

}  // namespace

Plane plane_through(const Wide& p, const Wide& normal) {
    const Wide n = glm::normalize(normal);
    return {without_negative_zero(narrow(n)), static_cast<double>(glm::dot(n, p)) + 0.0};
}

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

// The half-spaces of a concave arb's faces can meet far away from it. What lies outside the box of its own corners is
// no part of it.
void clip_to_corners(const Arb& arb, const Matrix& matrix, std::vector<Plane>& planes) {
    Box box = empty_box;
    for (const Vec3& corner : arb.vertices) extend(box, corner);
    for (const Plane& side :
         {Plane{{1, 0, 0}, box.high.x}, Plane{{-1, 0, 0}, -box.low.x}, Plane{{0, 1, 0}, box.high.y},
          Plane{{0, -1, 0}, -box.low.y}, Plane{{0, 0, 1}, box.high.z}, Plane{{0, 0, -1}, -box.low.z}})
        planes.push_back(transform_plane(matrix, side));
}

/// Perpendicular to a triangle, twice its area long. Of its two shorter sides: a cross product rounds by the product of
/// its factors, and in a sliver that of the long ones is little else.
Wide normal_of(const Wide& a, const Wide& b, const Wide& c) {
    const std::array<Wide, 3> sides{b - a, c - b, a - c};
    const std::array<long double, 3> lengths{glm::length(sides[0]), glm::length(sides[1]), glm::length(sides[2])};
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (lengths[i] > lengths[longest]) longest = i;
    return glm::cross(sides[(longest + 1) % 3], sides[(longest + 2) % 3]);
}

/// Which three of a face's corners its plane goes through.
enum class Through {
    first,   ///< that span one: as BRL-CAD chooses, which matters where a face is twisted
    widest,  ///< whose rounding tilts the plane least: where one end of a face is a sliver
};

struct Triangle {
    Wide corner, normal;
};

/// `corners`: a face's, each once. None: all are as good as in line.
std::optional<Triangle> spanning(const std::vector<Wide>& corners, long double in_line, Through through) {
    std::optional<Triangle> best;
    long double best_length = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j)
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                const Wide normal = normal_of(corners[i], corners[j], corners[k]), along = corners[j] - corners[i];
                const long double length = glm::length(normal);
                if (length < in_line * glm::dot(along, along)) continue;
                if (best && length <= best_length) continue;
                best = Triangle{corners[i], normal};
                best_length = length;
                if (through == Through::first) return best;
            }
    return best;
}

/// The faces through the corners, of which those closer than `same` are one and those as good as in line span none.
ArbFaces faces_through(const std::array<Wide, 8>& corners, long double same, long double in_line, long double size,
                       Through through) {
    static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};

    Wide mean(0);
    for (const Wide& corner : corners) mean += corner / 8.0L;

    // Equal corners become one, the first of them, in every face.
    std::array<std::size_t, 8> first_of{};
    for (std::size_t i = 0; i < 8; ++i) {
        first_of[i] = i;
        for (std::size_t j = 0; j < i; ++j) {
            if (glm::length(corners[i] - corners[j]) < same) {
                first_of[i] = first_of[j];
                break;
            }
        }
    }

    ArbFaces result;
    result.is_hull = true;
    result.planes.reserve(faces.size());
    std::vector<std::size_t> distinct;
    std::vector<Wide> of_face;
    for (const auto& face : faces) {
        distinct.clear();
        of_face.clear();
        for (const std::size_t corner : face) {
            if (std::find(distinct.begin(), distinct.end(), first_of[corner]) != distinct.end()) continue;
            distinct.push_back(first_of[corner]);
            of_face.push_back(corners[first_of[corner]]);
        }
        const std::optional<Triangle> triangle = spanning(of_face, in_line, through);
        if (!triangle) continue;
        const Wide on = triangle->corner;
        Wide normal = triangle->normal;
        if (glm::dot(normal, on - mean) < 0) normal = -normal;
        result.planes.push_back(plane_through(on, normal));

        const Wide unit = glm::normalize(normal);
        for (std::size_t i = 0; i < 8; ++i) {
            const long double above = glm::dot(unit, corners[i] - on);
            const bool in_face = std::find(face.begin(), face.end(), i) != face.end();
            if (above > flat * size || (in_face && above < -flat * size)) result.is_hull = false;
        }
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
    // However thin, a convex arb is what its numbers say. Else corners that are nearly one may span a face that is
    // rounding.
    ArbFaces result =
        faces_through(corners, equal_corner_relative * size, equal_corner_relative, size, Through::widest);
    if (result.is_hull) return result;
    result = faces_through(corners, std::min(same_corner, same_corner_relative * size), in_line_relative, size,
                           Through::first);
    if (!result.is_hull) clip_to_corners(arb, matrix, result.planes);
    return result;
}

}  // namespace csgrt
