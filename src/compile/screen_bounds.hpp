// Screen bounds: the pixels of a picture that can show anything, by projection of the boxes of the hierarchy's upper
// nodes.
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A rectangle of whole tiles, cut off at the picture's edges. Outside the rectangle no ray of the frame meets a
/// bounded solid. It is the whole picture if some solids are unbounded, or the eye is among the boxes; empty if there
/// are no solids.
kernel::ScreenBounds screen_bounds(const CompiledScene& scene, const kernel::Frame& frame);

}  // namespace csgrt
