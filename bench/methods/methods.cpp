#include "method.hpp"
#include "registry.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        roth(),
    };
    return all;
}

}  // namespace csgrt::bench
