// Sketches: checks an outline, whatever solid is made of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The faults, one sentence each. If there are none, every index is a vertex's, every arc has a centre, every curve
/// ends at its first and last points, and `open_ends` may be called.
std::vector<std::string> sketch_faults(const Sketch& sketch);

/// Vertices where an odd number of curves end, one for each position. All other positions are on closed loops.
std::vector<std::uint32_t> open_ends(const Sketch& sketch);

/// The least u of an arc of a sketch without faults: between its ends it may come nearer to the axis than they are.
double least_u(const Sketch& sketch, const Sketch::Arc& arc);

}  // namespace csgrt
