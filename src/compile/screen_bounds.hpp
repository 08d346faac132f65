// Which pixels of a picture can show anything: those before the boxes of the hierarchy's upper nodes.
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// A rectangle of whole tiles, cut off at the picture's edges, outside of which no ray of the frame meets a bounded
/// solid; all of the picture if some are unbounded, or the eye is among the boxes; nothing if there are none.
kernel::ScreenBounds screen_bounds(const CompiledScene& scene, const kernel::Frame& frame);

}  // namespace csgrt
