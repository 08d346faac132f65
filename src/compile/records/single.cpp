// The converter for kernels in single precision, relative to the eye: the world in double, the geometry in float.
#include "compile/compiled_scene.hpp"

#define CSGRT_EYE_RELATIVE
#define CSGRT_NUMBERS   \
    using real = float; \
    using wide = double;
#define CSGRT_KERNELS single
#define CSGRT_MAKE_CONVERTER make_single_converter
#include "compile/records/in_precision.hpp"
#include "compile/records/converter_of.hpp"
