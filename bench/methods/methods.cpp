#include "list.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
#define CSGRT_METHOD(name) name(),
    static const std::vector<Method> all = {CSGRT_METHODS(CSGRT_METHOD)};
    return all;
}

}  // namespace csgrt::bench
