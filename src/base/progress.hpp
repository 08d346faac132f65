// How a caller follows long work.
#pragma once

#include <functional>

namespace csgrt {

/// Is told which part of the work is done, 0 to 1, and says whether to go on.
using Progress = std::function<bool(double)>;

}  // namespace csgrt
