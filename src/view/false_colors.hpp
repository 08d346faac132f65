// False colours: pictures of values other than colours, and the outlines of ghosts.
#pragma once

#include <cstdint>
#include <span>

#include <csgrt/image.hpp>

#include "view/page_request.hpp"

namespace csgrt {

/// The channels (View::channels) that paint() needs.
std::uint32_t channels_for(Show show, bool has_ghosts);

/// Paints pixels for a display: R G B A, a byte each from the lowest byte on. `pixels` has one value for each of the
/// picture's.
void paint(const Image& image, Show show, std::span<std::uint32_t> pixels);

}  // namespace csgrt
