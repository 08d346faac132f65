// List frames: what kernels have to know about a list of rays.
#pragma once

#include "compile/frame.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// Prepares the frame of a list of rays: no camera, no lights, everything along the whole line. A negative `tolerance`
/// means the scene's.
PreparedFrame prepare_rays(const CompiledScene& scene, std::uint32_t count, double tolerance = -1);

/// The frame of a list whose rows `receiver` gets: with the camera of a grid, and the list's planes.
kernel::Frame frame_of(const CompiledScene& scene, const RayList& list, const RowReceiver& receiver, double tolerance);

}  // namespace csgrt
