#include <csgrt/version.hpp>

namespace csgrt {

const char* version() { return CSGRT_VERSION_STRING; }

}  // namespace csgrt
