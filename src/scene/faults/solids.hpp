// Faults of one solid, whoever made it.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The faults, one sentence each; empty: the solid has an inside that can be ray-traced. Unsupported solids have no
/// faults.
std::vector<std::string> solid_faults(const Shape& shape);

}  // namespace csgrt
