// The methods by file, for methods.cpp.
#pragma once

#include "method.hpp"

namespace csgrt::bench {

Method roth();

}  // namespace csgrt::bench
