// A grid of rays as kernels make it: the camera of a frame.
#pragma once

#include <csgrt/rays.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

/// Throws Error (usage) for a grid that has a ray which Limits excludes.
void check_grid(const RayGrid& grid);

/// The frame's view_ray(column, row) is the grid's ray.
void put_grid(const RayGrid& grid, kernel::Frame& frame);
RayGrid grid_of(const kernel::Frame& frame);

}  // namespace csgrt
