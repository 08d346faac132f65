// The kernels on the host in single precision, relative to the eye: the world in double, the geometry in float.
#include "reference/reference_kernels.hpp"

#define CSGRT_EYE_RELATIVE
#define CSGRT_NUMBERS   \
    using real = float; \
    using wide = double;
#define CSGRT_KERNELS single
#define CSGRT_MAKE_KERNELS make_single_kernels
#include "reference/precision/kernels_in.hpp"
#include "reference/precision/kernels_of.hpp"
