// Picture: writes the pixels of batches into the channels of an image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel_host/kernels.hpp"

namespace csgrt {

class RegisteredMemory;

/// One channel of an image: width x height floats, row by row from the top left, and the value of pixels that see
/// nothing. Without memory, the channel stays on the device, where a frame's edges need it.
struct ChannelMemory {
    float* pixels = nullptr;
    float background = 0;

    bool has_memory() const { return pixels != nullptr; }
};

/// The memory that a frame is drawn into.
struct RenderTarget {
    std::span<const ChannelMemory> channels;
    std::span<std::uint8_t> covered;               ///< one a tile of the picture: 0 if it is all background, else 1
    const RegisteredMemory* registered = nullptr;  ///< the part of the channels' memory that devices copy into
};

/// A rectangle of a picture's pixels: columns left ... right - 1, lines top ... bottom - 1.
struct Rectangle {
    std::size_t left = 0, right = 0, top = 0, bottom = 0;

    std::size_t columns() const { return right - left; }
    std::size_t lines() const { return bottom - top; }
    std::size_t size() const { return columns() * lines(); }
};

// A batch is the screen's tiles from number `first` to `end`: whole rows of tiles, or a part of one row.

/// Writes the pixels of a batch. `drawn`: the tiles that were drawn, in any order; `values`: for each channel the
/// floats of the tiles' rays, tile by tile. The other tiles become background if they were covered.
void put_tiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
               const float* values, const RenderTarget& target);

/// Writes the background into the covered tiles outside of the frame's screen bounds.
void clear_around(const kernel::Frame& frame, const RenderTarget& target);

/// Returns the rectangles of a batch that a GPU copies: a few rectangles that contain all tiles that show something and
/// all tiles that were covered before. `shown`: one byte a tile, 1 if the tile shows something, else 0. `shown`
/// replaces the batch's part of `covered`.
std::vector<Rectangle> take_rectangles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                                       std::span<const std::uint8_t> shown, const RenderTarget& target);

/// The whole rows of pixels within the screen bounds that a batch's tiles touch.
Rectangle rows_of(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end);

/// Writes the pixels of single rays: `values` has for each channel a float a ray.
void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target);

}  // namespace csgrt
