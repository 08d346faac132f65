#include "method.hpp"

#include "list.hpp"

namespace csgrt::bench {

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        meshes(),
    };
    return all;
}

}  // namespace csgrt::bench
