// The kernels once more, in the namespace CSGRT_KERNELS and with CSGRT_NUMBERS, for the file that includes this header.
#include "reference/reference_kernels.hpp"

#include "compile/records/in_precision.hpp"

namespace csgrt::CSGRT_KERNELS {

#include "../kernels/traversal/camera.h"
#include "../kernels/geometry/collect.h"
#include "../kernels/geometry/beyond.h"
#include "../kernels/shading/pixel.h"
#include "../kernels/boolean/rows.h"

}  // namespace csgrt::CSGRT_KERNELS
