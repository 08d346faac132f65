// What of a batch's pixels a GPU copies: few rectangles of few pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/readback/picture.hpp"

namespace csgrt {

/// Rectangles that cover, of the screen's tiles from number `first` to `end`, those that show something and those that
/// were covered before. `shown`: of each of these tiles a byte, not 0 if it shows something.
std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown, const RenderTarget& target);

/// Of these tiles the target is covered where they show something.
void mark_covered(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                  std::span<const std::uint8_t> shown, const RenderTarget& target);

/// The whole rows of pixels within the screen bounds that these tiles touch.
Rectangle rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end);

}  // namespace csgrt
