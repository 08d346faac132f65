// Grid of rays: sets the camera of a frame, from which kernels make the grid's rays.
#pragma once

#include <csgrt/rays.hpp>

#include "kernel_host/geometry.hpp"

namespace csgrt {

/// Throws Error (usage) for a grid with a ray that Limits excludes.
void check_grid(const RayGrid& grid);

/// Sets the frame's camera: view_ray(column, row) is then the grid's ray.
void put_grid(const RayGrid& grid, kernel::Frame& frame);
RayGrid grid_of(const kernel::Frame& frame);

inline Ray ray_of(const kernel::world_ray& r) { return {{r.o.x, r.o.y, r.o.z}, {r.d.x, r.d.y, r.d.z}}; }

}  // namespace csgrt
