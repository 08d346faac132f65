// Reader of csgrt's own scene format. scenes/README.md describes it, scenes/csgrt.schema.json is its schema.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

class TextSource;

/// The version of the format, the value of the key "csgrt".
inline constexpr int json_format_version = 1;

/// Reads a .json file. Throws Error (file) if the file cannot be read, and Error (scene) with every finding if it is
/// wrong.
Scene read_json(const std::string& path);

/// Reads a text in memory.
Scene parse_json_scene(const TextSource& source);

}  // namespace csgrt
