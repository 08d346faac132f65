// What the kernels leave of a batch's rays -> the planes of an image.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "kernel_host/kernels.hpp"

namespace csgrt {

class KnownPicture;

/// One channel of an image: width x height floats, by row from the top left, and its value where nothing is seen.
struct ChannelPlane {
    float* pixels = nullptr;
    float background = 0;
};

/// What a frame is drawn into.
struct RenderTarget {
    std::span<const ChannelPlane> planes;
    std::span<std::uint8_t> drawn;  ///< a tile of the picture: 0 if it holds nothing but the background, else 1
    unsigned threads = 0;           ///< that put pixels into it; 0: all
    const KnownPicture* known = nullptr;  ///< their memory, as devices know it
};

/// Fills the pixels of the screen's tiles from number `first` to `end`. `drawn`: those that were drawn, in any order; `values`: for
/// each plane the floats of their rays, tile by tile. The others get the background, where the target does not hold it.
void put_tiles(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
                const float* values, const RenderTarget& target);

/// Fills the tiles outside of the frame's screen that hold anything with the background.
void clear_around(const kernel::Frame& frame, const RenderTarget& target);

/// Pixels of a picture: columns left ... right - 1, lines top ... bottom - 1.
struct Rectangle {
    std::size_t left = 0, right = 0, top = 0, bottom = 0;
    std::size_t begin = 0;  ///< among floats of rectangles: of each plane its lines

    std::size_t columns() const { return right - left; }
    std::size_t lines() const { return bottom - top; }
    std::size_t size() const { return columns() * lines(); }
};

/// Fills rectangles' pixels. `arrived`, if there is one, is called with i before what the i-th plane of them all holds is read, by
/// several threads.
void put_rectangles(const kernel::Frame& frame, std::span<const Rectangle> rectangles, const float* values,
                    const RenderTarget& target, const std::function<void(std::size_t)>& arrived = nullptr);

/// Fills the pixels of single rays: `values` has for each plane a float a ray.
void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target);

}  // namespace csgrt
