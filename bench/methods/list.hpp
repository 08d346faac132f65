// The methods, in the chart's order: a file each, and a line here.
#pragma once

#include "method.hpp"

#define CSGRT_METHODS(METHOD) \
    METHOD(roth)              \
    METHOD(bit_sequential)    \
    METHOD(bit_parallel)      \
    METHOD(status_tree)       \
    METHOD(jansen_lists)      \
    METHOD(blist)             \
    METHOD(cst)               \
    METHOD(pruning)           \
    METHOD(layers)            \
    METHOD(kensler)           \
    METHOD(ulyanov)           \
    METHOD(bisection)         \
    METHOD(sphere_tracing)    \
    METHOD(yang_lists)        \
    METHOD(thesis)            \
    METHOD(depth_buffer)      \
    METHOD(meshes)

namespace csgrt::bench {

#define CSGRT_METHOD(name) Method name();
CSGRT_METHODS(CSGRT_METHOD)
#undef CSGRT_METHOD

}  // namespace csgrt::bench
