// The kernels on the host in double.
#include "kernel_host/geometry.hpp"

#define CSGRT_KERNELS kernel
#define CSGRT_MAKE_KERNELS make_double_kernels
#include "reference/precision/kernels_of.hpp"
