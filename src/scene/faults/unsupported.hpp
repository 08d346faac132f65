// Unsupported: types of solids that csgrt knows only by name.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The reason why such a solid cannot be drawn, and what to do: one sentence.
std::string why_left_out(const Unsupported& shape);

}  // namespace csgrt
