// What the kernels leave of a tile's rays -> the planes of an image.
#pragma once

#include <cstdint>
#include <span>

#include "kernel_host.hpp"

namespace csgrt {

/// One channel of an image: width x height floats, by row from the top left, and its value where nothing is seen.
struct ChannelPlane {
    float* pixels = nullptr;
    float background = 0;
    bool is_background = false;  ///< all of it, before the frame
};

/// What a frame is drawn into.
struct RenderTarget {
    std::span<const ChannelPlane> planes;
    std::span<std::uint8_t> drawn;  ///< a block of the picture: 0 if it holds nothing but the background
    unsigned threads = 0;           ///< that put pixels into it; 0: all
};

/// Fills the pixels of the blocks from number `first` to `end`. `drawn`: those that were drawn, ascending; `places`: where
/// each stands in `values`, for each plane the floats of their rays, block by block. The others get the background, where
/// the target does not hold it.
void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::span<const std::uint32_t> drawn,
                std::span<const std::uint32_t> places, const float* values, const RenderTarget& target);

/// The same for single rays.
void put_rays(const kernel::Frame& frame, std::span<const std::uint32_t> numbers, const float* values,
              const RenderTarget& target);

}  // namespace csgrt
