// The solids of a scene file.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"

namespace csgrt {

/// Reads {"type": ..., ...}. The friendly types (sphere, cylinder, cone, box) answer for their numbers here; whether
/// the general ones enclose anything is for `validate` to say, since other readers and programs make them too.
Shape read_json_solid(const JsonNode& node);

/// What "type" may say.
std::vector<std::string_view> json_solid_types();

}  // namespace csgrt
