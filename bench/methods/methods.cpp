#include "method.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {};
    return all;
}

}  // namespace csgrt::bench
