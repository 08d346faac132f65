#include "scene/solid_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/curved_faults.hpp"
#include "scene/fault_rules.hpp"
#include "scene/mesh_faults.hpp"
#include "scene/polytope.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// Three vectors whose box has less than this part of the volume of a right-angled one lie in a plane, as far as
/// double precision can tell after they have been inverted.
constexpr double least_volume = 1e-10;

bool dependent(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::abs(dot(unit(a), cross(unit(b), unit(c)))) < least_volume;
}

/// The end of a tgc that tapers along `end` must keep the direction of `start`.
void require_parallel(Faults& faults, const char* names, const Vec3& start, const Vec3& end) {
    if (length(start) == 0 || length(end) == 0) return;
    if (length(cross(unit(start), unit(end))) > angle_slack) {
        faults.push_back(std::string("the axes ") + names + " must be parallel");
    } else if (dot(unit(start), unit(end)) < 0) {
        faults.push_back(std::string("the axes ") + names + " must not point in opposite directions");
    }
}

void check_plane(Faults& faults, const Plane& plane, const std::string& which) {
    if (length(plane.normal) == 0) {
        faults.push_back("the normal" + which + " has length 0");
    } else if (!is_unit(plane.normal)) {
        faults.push_back("the normal" + which + " is not of length 1");
    }
}

struct FaultsOf {
    Faults operator()(const Ell& s) const {
        Faults faults;
        if (!all_finite(faults, s.v, s.a, s.b, s.c)) return faults;
        for (const auto& [name, axis] : {std::pair{"a", s.a}, std::pair{"b", s.b}, std::pair{"c", s.c}}) {
            if (length(axis) == 0) faults.push_back(std::string("the axis ") + name + " has length 0");
        }
        if (faults.empty() && dependent(s.a, s.b, s.c)) faults.push_back("the axes a, b and c lie in one plane");
        return faults;
    }

    Faults operator()(const Tgc& s) const {
        Faults faults;
        if (!all_finite(faults, s.v, s.h, s.a, s.b, s.c, s.d)) return faults;
        if (length(s.h) == 0) faults.push_back("the height has length 0");
        const bool a = length(s.a) > 0, b = length(s.b) > 0, c = length(s.c) > 0, d = length(s.d) > 0;
        if (!a && !b && !c && !d) {
            faults.push_back("base and top are both points: a radius at one end at least must be greater than 0");
        } else if (a != b) {
            faults.push_back(
                std::string("the axis ") + (a ? "b" : "a") +
                " of the base has length 0: the base is an ellipse or a point, only the top may be an edge");
        } else if (!a && c != d) {
            faults.push_back("the base is a point and the top an edge, which encloses nothing");
        } else if (faults.empty() && dependent(a ? s.a : s.c, a ? s.b : s.d, s.h)) {
            faults.push_back(a ? "the axes a and b and the height lie in one plane"
                               : "the axes c and d and the height lie in one plane");
        }
        require_parallel(faults, "a and c", s.a, s.c);
        require_parallel(faults, "b and d", s.b, s.d);
        return faults;
    }

    /// Some triangle of vertices has an area, and some vertex lies off its plane.
    Faults operator()(const Arb& s) const {
        Faults faults;
        for (const Vec3& vertex : s.vertices) {
            if (!all_finite(faults, vertex)) return faults;
        }
        double size = 0, farthest = 0;
        Vec3 normal;
        for (const Vec3& p : s.vertices) {
            farthest = std::max(farthest, length(p));
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
        const double rounding = 8 * std::numeric_limits<double>::epsilon() * farthest;
        const bool flat = thickness <= std::max(1e-12 * size, rounding);
        if (flat || length(normal) <= size * std::max(1e-12 * size, rounding)) {
            faults.push_back("the vertices lie in one plane: there is no volume");
        }
        return faults;
    }

    Faults operator()(const Arbn& s) const {
        Faults faults;
        if (s.planes.size() > Limits::faces) {
            return {"it has " + std::to_string(s.planes.size()) + " planes; at most " + std::to_string(Limits::faces) +
                    " are supported"};
        }
        for (std::size_t i = 0; i < s.planes.size(); ++i) {
            const Plane& plane = s.planes[i];
            if (!all_finite(faults, plane.normal, plane.distance)) return faults;
            check_plane(faults, plane, " of plane " + std::to_string(i));
        }
        if (!faults.empty()) return faults;
        switch (intersect_half_spaces(s.planes).kind) {
            case Polytope::Kind::empty:
                return {"its half-spaces have no volume in common"};
            case Polytope::Kind::unbounded:
                return {"its half-spaces do not bound it on all sides"};
            case Polytope::Kind::bounded:
                break;
        }
        return faults;
    }

    Faults operator()(const Half& s) const {
        Faults faults;
        if (all_finite(faults, s.plane.normal, s.plane.distance)) check_plane(faults, s.plane, "");
        return faults;
    }

    Faults operator()(const Tor& s) const {
        Faults faults;
        if (!all_finite(faults, s.v, s.h, s.r_a, s.r_h)) return faults;
        if (length(s.h) == 0) faults.push_back("the axis has length 0");
        require_positive(faults, "the radius", s.r_a);
        require_positive(faults, "the radius of the tube", s.r_h);
        if (s.r_a > 0 && s.r_h > s.r_a) {
            faults.push_back("the radius of the tube must not be greater than that of the circle");
        }
        return faults;
    }

    Faults operator()(const Ehy& s) const {
        Faults faults;
        if (!all_finite(faults, s.v, s.h, s.a, s.r_1, s.r_2, s.c)) return faults;
        if (length(s.h) == 0) faults.push_back("the height has length 0");
        if (length(s.a) == 0) {
            faults.push_back("the direction a has length 0");
        } else if (!is_unit(s.a)) {
            faults.push_back("the direction a is not of length 1");
        } else if (std::abs(dot(s.a, unit(s.h))) > angle_slack) {
            faults.push_back("the direction a must be perpendicular to the height");
        }
        require_positive(faults, "the semi-axis r1", s.r_1);
        require_positive(faults, "the semi-axis r2", s.r_2);
        require_positive(faults, "c, the distance from the apex to the asymptotes,", s.c);
        return faults;
    }

    Faults operator()(const Part& s) const { return curved_faults(s); }
    Faults operator()(const Epa& s) const { return curved_faults(s); }
    Faults operator()(const Rpc& s) const { return curved_faults(s); }
    Faults operator()(const Rhc& s) const { return curved_faults(s); }
    Faults operator()(const Eto& s) const { return curved_faults(s); }
    Faults operator()(const Hyp& s) const { return curved_faults(s); }
    Faults operator()(const Superell& s) const { return curved_faults(s); }
    Faults operator()(const Hrt& s) const { return curved_faults(s); }
    Faults operator()(const Metaball& s) const { return curved_faults(s); }
    Faults operator()(const Bot& s) const { return mesh_faults(s); }
    Faults operator()(const Ars& s) const { return mesh_faults(s); }
    Faults operator()(const Nmg& s) const { return mesh_faults(s); }
    Faults operator()(const Vol& s) const { return mesh_faults(s); }
    Faults operator()(const Dsp& s) const { return mesh_faults(s); }

    template <class Other>
    Faults operator()(const Other&) const {
        return {};
    }
};

}  // namespace

std::vector<std::string> solid_faults(const Shape& shape) { return std::visit(FaultsOf{}, shape); }

}  // namespace csgrt
