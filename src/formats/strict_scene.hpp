// Strict scene: turns a lenient scene into a strict one.
#pragma once

#include <csgrt/scene.hpp>

namespace csgrt {

/// The scene with empty combinations in place of objects and members that compilation would leave out. Solids of
/// unknown types stay.
Scene strict_scene(const Scene& scene);

}  // namespace csgrt
