// What is wrong with an outline, whatever is made of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// One sentence a fault. Without any, every index is one of a vertex, every arc has a centre, every curve ends at its
/// first and last points, and `open_ends` may be asked.
std::vector<std::string> sketch_faults(const Sketch& sketch);

/// Vertices where an odd number of curves end, one for each such place. The other places are on closed loops.
std::vector<std::uint32_t> open_ends(const Sketch& sketch);

/// The least u of an arc of a sketch without faults: on its way it may come nearer to the axis than its ends.
double least_u(const Sketch& sketch, const Sketch::Arc& arc);

}  // namespace csgrt
