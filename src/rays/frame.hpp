// List frames: everything that kernels need to know about a list of rays.
#pragma once

#include "compile/frame.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// Prepares the frame of a list of rays: no camera, no lights, every partition along the whole line. A negative
/// `tolerance` means the scene's tolerance.
PreparedFrame prepare_rays(const CompiledScene& scene, std::uint32_t count, double tolerance = -1);

/// The frame of a list whose rows go to `receiver`, with the camera of a grid and the list's planes.
kernel::Frame frame_of(const CompiledScene& scene, const RayList& list, const RowReceiver& receiver, double tolerance);

}  // namespace csgrt
