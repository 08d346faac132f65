// Unsupported: types of solids that csgrt knows only by name.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// One sentence: the reason why such a solid cannot be drawn, and a suggestion.
std::string why_left_out(const Unsupported& shape);

}  // namespace csgrt
