#include "method.hpp"

#include "list.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        kensler(),
        bisection(),
        sphere_tracing(),
        depth_buffer(),
    };
    return all;
}

}  // namespace csgrt::bench
