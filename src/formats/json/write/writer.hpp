// Writer of csgrt's own scene format.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The text of a .json file that reads back to the same scene, bit for bit. Lengths are written in the scene's units if
/// every length reads back exactly, else in millimetres. Throws Error (scene), with every finding, for values that JSON
/// cannot hold: numbers that are not finite, names that are not UTF-8 or are repeated, nodes that do not form a tree.
std::string json_scene_text(const Scene& scene);

}  // namespace csgrt
