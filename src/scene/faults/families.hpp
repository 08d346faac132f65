// What the files that check solids by family share.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {

using Faults = std::vector<std::string>;

struct FaultsOf {
    // solid_faults_polyhedra.cpp
    Faults operator()(const Arb& s) const;
    Faults operator()(const Arbn& s) const;
    Faults operator()(const Half& s) const;

    // solid_faults_quadrics.cpp
    Faults operator()(const Ell& s) const;
    Faults operator()(const Tgc& s) const;
    Faults operator()(const Ehy& s) const;
    Faults operator()(const Part& s) const;
    Faults operator()(const Epa& s) const;
    Faults operator()(const Rpc& s) const;
    Faults operator()(const Rhc& s) const;
    Faults operator()(const Hyp& s) const;

    // solid_faults_curved.cpp
    Faults operator()(const Tor& s) const;
    Faults operator()(const Eto& s) const;
    Faults operator()(const Superell& s) const;
    Faults operator()(const Hrt& s) const;
    Faults operator()(const Metaball& s) const;

    // solid_faults_pipes.cpp
    Faults operator()(const Pipe& s) const;
    Faults operator()(const Cline& s) const;

    // solid_faults_meshes.cpp
    Faults operator()(const Bot& s) const;
    Faults operator()(const Ars& s) const;
    Faults operator()(const Nmg& s) const;

    // solid_faults_cells.cpp
    Faults operator()(const Ebm& s) const;
    Faults operator()(const Vol& s) const;
    Faults operator()(const Dsp& s) const;

    // solid_faults_sketches.cpp
    Faults operator()(const Extrude& s) const;
    Faults operator()(const Revolve& s) const;

    Faults operator()(const Unsupported&) const { return {}; }
};

/// Sine of the angle that vectors called parallel (cosine: perpendicular) may differ by. BRL-CAD's databases keep
/// vectors of single precision, off by up to 1e-6; its ray tracer refuses beyond a cosine of 0.999.
inline constexpr double angle_slack = 1e-3;

struct IsFinite {
    bool operator()(double x) const { return std::isfinite(x); }
    bool operator()(const Vec3& v) const { return is_finite(v); }
};

/// Reports a number that is not finite or beyond the largest length, once a solid. Nothing else is worth saying about
/// such a solid.
template <class... Numbers>
bool all_finite(Faults& faults, const Numbers&... numbers) {
    const IsFinite finite;
    if (!(finite(numbers) && ...)) {
        faults.push_back("it has a number that is not finite");
        return false;
    }
    const double most = std::max({largest(numbers)...});
    if (most <= Limits::length) return true;
    faults.push_back("it has the number " + number_text(most) + "; " + length_limit());
    return false;
}

inline void require_positive(Faults& faults, const std::string& name, double value) {
    if (!(value > 0)) faults.push_back(name + " must be greater than 0");
}

inline void require_not_negative(Faults& faults, const std::string& name, double value) {
    if (!(value >= 0)) faults.push_back(name + " must be 0 or more");
}

/// False, and a fault, if the vector has length 0.
inline bool require_length(Faults& faults, const std::string& name, const Vec3& v) {
    if (length(v) > 0) return true;
    faults.push_back(name + " has length 0");
    return false;
}

/// Says nothing of vectors of length 0.
inline void require_perpendicular(Faults& faults, const std::string& name, const Vec3& v, const std::string& other,
                                  const Vec3& w) {
    if (std::abs(dot(unit(v), unit(w))) > angle_slack) {
        faults.push_back(name + " must be perpendicular to " + other);
    }
}

/// A direction of length 1, perpendicular to the height.
inline void require_direction_across(Faults& faults, const std::string& name, const Vec3& a, const Vec3& h) {
    if (!require_length(faults, "the direction " + name, a)) return;
    if (!is_unit(a)) {
        faults.push_back("the direction " + name + " is not of length 1");
    } else {
        require_perpendicular(faults, "the direction " + name, a, "the height", h);
    }
}

/// Three axes that span a volume.
inline void require_independent(Faults& faults, const char* const (&names)[3], const Vec3 (&axes)[3]) {
    if (plainly_independent(axes[0], axes[1], axes[2])) return;
    bool sound = true;
    for (std::size_t i = 0; i < 3; ++i) sound &= require_length(faults, std::string("the axis ") + names[i], axes[i]);
    if (sound && dependent(axes[0], axes[1], axes[2])) {
        faults.push_back(std::string("the axes ") + names[0] + ", " + names[1] + " and " + names[2] +
                         " lie in one plane");
    }
}

/// A count that must not pass its limit. False, and a fault, if it does.
inline bool require_at_most(Faults& faults, const std::string& what, std::size_t count, std::size_t limit) {
    if (count <= limit) return true;
    faults.push_back("it has " + std::to_string(count) + " " + what + "; at most " + std::to_string(limit) +
                     " are supported");
    return false;
}

/// "face 3 uses vertex 9, and there are 5", ...: after the name of who uses it.
inline std::string uses_missing_vertex(std::size_t vertex, std::size_t count) {
    return " uses vertex " + std::to_string(vertex) + ", but there " +
           (count == 0   ? "are no vertices"
            : count == 1 ? "is only vertex 0"
                         : "are only vertices 0 to " + std::to_string(count - 1));
}

}  // namespace csgrt
