// The converter for kernels in single precision throughout, in the world's coordinates.
#define CSGRT_NUMBERS   \
    using real = float; \
    using wide = float;
#define CSGRT_KERNELS single_world
#define CSGRT_MAKE_CONVERTER make_single_world_converter
#include "compile/records/in_precision.hpp"
#include "compile/records/converter_of.hpp"
