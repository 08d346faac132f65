// Families: functions that check several members of a solid together. Each file family_*.cpp checks one family of
// solids.
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

// Check several members together, and lists of millions of items. Called if all single numbers are finite. `faults`:
// has the faults of single members already, and gets the new ones.

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

/// The largest sine of the angle between vectors that count as parallel, and the largest cosine for perpendicular ones.
/// BRL-CAD's databases hold vectors in single precision, with errors of up to 1e-6, and its ray tracer accepts parallel
/// vectors whose cosine is at least 0.999.
inline constexpr double angle_slack = 1e-3;

/// Checks a count against its limit. Adds a fault and returns false if the count is above the limit.
inline bool require_at_most(Faults& faults, const std::string& what, std::size_t count, std::size_t limit) {
    if (count <= limit) return true;
    faults.push_back("it has " + std::to_string(count) + " " + what + "; at most " + std::to_string(limit) +
                     " are supported");
    return false;
}

/// The end of a sentence such as "face 3 uses vertex 9, but there are 5", from " uses" on.
inline std::string uses_missing_vertex(std::size_t vertex, std::size_t count) {
    return " uses vertex " + std::to_string(vertex) + ", but there " +
           (count == 0   ? "are no vertices"
            : count == 1 ? "is only vertex 0"
                         : "are only vertices 0 to " + std::to_string(count - 1));
}

}  // namespace csgrt
