#include "list.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        roth(),    bit_sequential(), bit_parallel(),   status_tree(),  blist(),  pruning(),
        kensler(), bisection(),      sphere_tracing(), depth_buffer(), meshes(),
    };
    return all;
}

}  // namespace csgrt::bench
