// The kernels' geometry, camera, shading and tree walk, compiled for the host.
#pragma once

#include "kernel_host/kernels.hpp"

namespace csgrt::kernel {

#include "../kernels/camera.h"
#include "../kernels/geometry/collect.h"
#include "../kernels/shading.h"

}  // namespace csgrt::kernel
