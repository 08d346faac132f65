// What a GPU's tile brings of a picture: few rectangles of few pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/picture.hpp"

namespace csgrt {

/// Rectangles of the blocks from number `first` to `end` that hold all that is shown, and what the target holds from before and
/// is background now. `extents`: find_shown's (kernels/picture_lines.cl), of each row of blocks.
std::vector<Rectangle> find_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint32_t> extents, const RenderTarget& target);

/// Tells the target that of these blocks it holds only what is shown.
void mark_shown(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> extents,
                const RenderTarget& target);

/// Rows of blocks, some of them maybe in part, that those from `first` to `end` stand in.
std::size_t rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end);

}  // namespace csgrt
