// The converter for kernels in double.
#define CSGRT_KERNELS kernel
#define CSGRT_MAKE_CONVERTER make_double_converter
#include "compile/records/converter_of.hpp"
