// The kernels on the host in single precision throughout, in the world's coordinates.
#define CSGRT_NUMBERS   \
    using real = float; \
    using wide = float;
#define CSGRT_KERNELS single_world
#define CSGRT_MAKE_KERNELS make_single_world_kernels
#include "reference/precision/kernels_in.hpp"
#include "reference/precision/kernels_of.hpp"
