// The kernels' records once more, in the namespace CSGRT_KERNELS and with CSGRT_NUMBERS, for the file that includes
// this header. The headers that src/compile includes in double come first, and their guards are lifted. Warnings about
// narrowing are off, because this source is compiled for several types of numbers.
#include <cmath>
#include <limits>

#include "compile/compiled_scene.hpp"

#undef CSGRT_SHARED_BASE_H
#undef CSGRT_SHARED_VECTORS_H
#undef CSGRT_SHARED_LAYOUT_H
#undef SOLID_CENTER
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"

namespace csgrt::CSGRT_KERNELS {

CSGRT_NUMBERS
using u32 = std::uint32_t;
inline const real REAL_INFINITY = static_cast<real>(std::numeric_limits<double>::infinity());

#include "../kernels/shared/base.h"
#include "../kernels/shared/layout.h"

}  // namespace csgrt::CSGRT_KERNELS
