// The laboratory's methods, one function and one file each.
#pragma once

#include "method.hpp"

namespace csgrt::bench {

Method meshes();

}  // namespace csgrt::bench
