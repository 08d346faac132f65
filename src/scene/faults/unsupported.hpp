// Types of solids that csgrt knows by name only.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Why such a solid cannot be drawn, and what to do: one sentence.
std::string why_left_out(const Unsupported& shape);

}  // namespace csgrt
