// Solids of a scene file.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"

namespace csgrt {

/// Reads {"type": ..., ...}. The numbers of simple types (sphere, cylinder, cone, box) are checked here. `validate`
/// checks the general types, because other readers and programs make them, too.
Shape read_json_solid(const JsonNode& node);

/// The values of "type".
std::vector<std::string_view> json_solid_types();

}  // namespace csgrt
