#include <algorithm>
#include <limits>

#include "scene/solids/arb_form.hpp"
#include "scene/solids/polytope.hpp"
#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// A quick test, true for most arbs: do three edges span a volume far above that of a flat solid? A solid of size s and
/// thickness t has at most the volume 3 t s^2, and s is at most 4 times the largest coordinate.
bool plainly_solid(const Arb& s) {
    double reach = 0;
    for (const Vec3& v : s.vertices) reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const Vec3& v = s.vertices[0];
    const double volume = dot(s.vertices[1] - v, cross(s.vertices[3] - v, s.vertices[4] - v));
    return reach > 1e-90 && std::abs(volume) > 1e-9 * reach * reach * reach;
}

void check_volume(Faults& faults, const Arb& s) {
    if (plainly_solid(s)) return;
    double size = 0, reach = 0;
    Vec3 normal;
    for (const Vec3& p : s.vertices) {
        reach = std::max(reach, length(p));
        size = std::max(size, length(p - s.vertices[0]));
        for (const Vec3& q : s.vertices) {
            const Vec3 candidate = cross(p - s.vertices[0], q - s.vertices[0]);
            if (length(candidate) > length(normal)) normal = candidate;
        }
    }
    double thickness = 0;
    for (const Vec3& p : s.vertices) {
        thickness = std::max(thickness, std::abs(dot(unit(normal), p - s.vertices[0])));
    }
    const double of_size = 1e-12 * size, rounding = 8 * std::numeric_limits<double>::epsilon() * reach;
    const double least = std::max(of_size, rounding), width = size > 0 ? length(normal) / size : 0;
    if (thickness > least && width > least) return;
    if (thickness > rounding && width > rounding) {
        faults.push_back("it is too thin: its vertices lie within " + rounded_text(std::min(thickness, width)) +
                         " mm of one plane, and within " + rounded_text(least) +
                         " mm, 1e-12 of its size, there is no " + "volume");
    } else {
        faults.push_back("the vertices lie in one plane: there is no volume");
    }
}

}  // namespace

/// Checks that the vertices do not lie in one plane, that the faces do not lie on one another, and that no face of a
/// concave arb crosses itself.
void check_further(Faults& faults, const Arb& s) {
    check_volume(faults, s);
    if (!faults.empty()) return;
    if (is_without_volume(s)) {
        faults.push_back("its faces lie on one another: there is no volume");
    } else if (const std::optional<std::size_t> face = crossing_face(s)) {
        std::string which;
        for (const std::uint32_t vertex : arb_face_vertices[*face]) which += " " + std::to_string(vertex);
        faults.push_back("its face" + which + " crosses itself: its vertices do not follow one another around it");
    }
}

void check_further(Faults& faults, const Arbn& s) {
    if (!faults.empty()) return;
    switch (intersect_half_spaces(s.planes).kind) {
        case Polytope::Kind::empty:
            return faults.push_back("its half-spaces have no volume in common");
        case Polytope::Kind::unbounded:
            return faults.push_back("its half-spaces do not bound it on all sides");
        case Polytope::Kind::bounded:
            break;
    }
}

}  // namespace csgrt
