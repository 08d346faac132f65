#include <csgrt/renderer.hpp>

namespace csgrt {

const char* version() {
    return CSGRT_VERSION;
}

}  // namespace csgrt
