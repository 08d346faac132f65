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

// What is wrong with several members together, and with lists that have millions of items. Called when all single
// numbers are finite; `faults` has what is wrong with single members.

template <class S>
void check_further(Faults&, const S&) {}

// family_polyhedra.cpp
void check_further(Faults& faults, const Arb& s);
void check_further(Faults& faults, const Arbn& s);

// family_curved.cpp
void check_further(Faults& faults, const Tgc& s);
void check_further(Faults& faults, const Part& s);
void check_further(Faults& faults, const Tor& s);
void check_further(Faults& faults, const Eto& s);
void check_further(Faults& faults, const Metaball& s);

// family_pipes.cpp
void check_further(Faults& faults, const Pipe& s);

// family_meshes.cpp
void check_further(Faults& faults, const Bot& s);
void check_further(Faults& faults, const Ars& s);
void check_further(Faults& faults, const Nmg& s);

// family_cells.cpp
void check_further(Faults& faults, const Ebm& s);
void check_further(Faults& faults, const Vol& s);
void check_further(Faults& faults, const Dsp& s);

// family_sketches.cpp
void check_further(Faults& faults, const Extrude& s);
void check_further(Faults& faults, const Revolve& s);

/// Sine of the angle that vectors called parallel (cosine: perpendicular) may differ by. BRL-CAD's databases keep
/// vectors of single precision, off by up to 1e-6; its ray tracer refuses beyond a cosine of 0.999.
inline constexpr double angle_slack = 1e-3;

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
