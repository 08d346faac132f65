// Geometry: the kernels' geometry, camera, shading and tree walk, compiled for the host.
#pragma once

#include "kernel_host/kernels.hpp"

namespace csgrt::kernel {

#include "../kernels/traversal/camera.h"
#include "../kernels/geometry/collect.h"
#include "../kernels/geometry/beyond.h"
#include "../kernels/shading/edge.h"
#include "../kernels/shading/pixel.h"
#include "../kernels/boolean/rows.h"

}  // namespace csgrt::kernel
