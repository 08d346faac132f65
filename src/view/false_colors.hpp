// False colours: paints values other than colours, and outlines of ghosts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <csgrt/image.hpp>

#include "view/page_request.hpp"

namespace csgrt {

/// The channels (View::channels) that paint() needs.
std::uint32_t channels_for(Show show, bool has_ghosts);

/// Paints pixels for a display: R G B A, one byte each, R in the lowest byte. `pixels` has one value for each pixel.
/// `selected` has one for each region, for marks. Returns the range of the values, where colours mean some.
std::optional<std::pair<double, double>> paint(const Image& image, Show show, const std::vector<bool>& selected,
                                               std::span<std::uint32_t> pixels);

}  // namespace csgrt
