// The methods by file, for methods.cpp.
#pragma once

#include "method.hpp"

namespace csgrt::bench {

Method roth();
Method bit_sequential();
Method bit_parallel();
Method status_tree();
Method blist();
Method pruning();

}  // namespace csgrt::bench
