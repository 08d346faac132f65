// The kernels on the host in 113 bits, to show the effect of rounding in the other precisions.
#include "reference/quad_math.hpp"

#define CSGRT_NUMBERS        \
    using real = host::quad; \
    using wide = host::quad;
#define CSGRT_KERNELS quad
#define CSGRT_MAKE_KERNELS make_quad_kernels
#include "reference/precision/kernels_in.hpp"
#include "reference/precision/kernels_of.hpp"
