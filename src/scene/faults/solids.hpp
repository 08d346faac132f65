// Faults of one solid, which a reader or a program made.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The faults, one sentence each. Without faults, the solid encloses space and can be traced. Unsupported solids have
/// no faults.
std::vector<std::string> solid_faults(const Shape& shape);

}  // namespace csgrt
