// What a GPU's batch brings of a picture: few rectangles of few pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/readback/picture.hpp"

namespace csgrt {

/// Rectangles of the screen's tiles from number `first` to `end` that hold all that is shown, and what the target holds from before and
/// is background now. `shown`: of each of these tiles, not 0 if it shows something.
std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown, const RenderTarget& target);

/// Tells the target that of these tiles it holds only what is shown.
void hold_shown(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint8_t> shown,
                const RenderTarget& target);

/// Lines of the screen that these tiles have: whole ones, of which the batch has some, maybe, in part.
Rectangle lines_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end);

}  // namespace csgrt
