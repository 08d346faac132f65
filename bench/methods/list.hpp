// The methods, each in its own file.
#pragma once

#include "method.hpp"

namespace csgrt::bench {

Method kensler();
Method bisection();
Method sphere_tracing();
Method depth_buffer();

}  // namespace csgrt::bench
