// Sketches: checks an outline, for all solids that use sketches.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The faults, one sentence each. If there are none, every index is valid, every arc has a centre, every curve ends at
/// its first and last points, and `open_ends` may be called.
std::vector<std::string> sketch_faults(const Sketch& sketch);

/// Vertices where an odd number of curves end, one vertex for each position. All other curves form closed loops.
std::vector<std::uint32_t> open_ends(const Sketch& sketch);

/// The least u of an arc, which may be between its ends. The sketch must have no faults.
double least_u(const Sketch& sketch, const Sketch::Arc& arc);

}  // namespace csgrt
