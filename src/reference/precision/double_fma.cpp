// The kernels on the host in double once more, for x86 processors with an fma instruction: the same bits, without a
// call of the C library for each fma.
#include "reference/precision/double_fma.hpp"

#ifdef CSGRT_DOUBLE_FMA
#include "kernel_host/kernels.hpp"
#include "reference/reference_kernels.hpp"

// The pragma covers the kernels' own functions alone: functions that they share with other files must run on any
// processor.
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("fma,prefer-vector-width=128")  // wider copies of structs have to wait until the parts are stored
#endif

#ifdef __OPTIMIZE__
#undef WHOLE_FN
#undef NOINLINE_FN
#define WHOLE_FN [[gnu::flatten]] FN
#define NOINLINE_FN FN __attribute__((noinline))
#define PART_FN NOINLINE_FN
#endif

namespace csgrt::fused {

using namespace kernel;  // records, and functions so small that they are inlined

#include "../kernels/traversal/camera.h"
#include "../kernels/geometry/collect.h"
#include "../kernels/geometry/beyond.h"
#include "../kernels/shading/pixel.h"
#include "../kernels/boolean/rows.h"

}  // namespace csgrt::fused

#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#define CSGRT_KERNELS fused
#define CSGRT_MAKE_KERNELS make_fused_kernels
#include "reference/precision/kernels_of.hpp"
#endif
