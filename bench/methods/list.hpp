// The methods, each in its own file.
#pragma once

#include "method.hpp"

namespace csgrt::bench {

Method roth();
Method bit_sequential();
Method bit_parallel();
Method status_tree();
Method blist();
Method pruning();
Method kensler();
Method bisection();
Method sphere_tracing();
Method depth_buffer();
Method meshes();

}  // namespace csgrt::bench
