// Repair: a lenient scene as a strict one.
#pragma once

#include <csgrt/scene.hpp>

namespace csgrt {

/// The scene with an empty combination for everything that its top objects use and that is left out of them. Solids of
/// unknown types stay.
Scene strict_scene(const Scene& scene);

}  // namespace csgrt
