// The memory of pictures, and what of it is background already.
#include <algorithm>
#include <utility>

#include <csgrt/renderer.hpp>

#include "kernel_host.hpp"
#include "parallel.hpp"

namespace csgrt {

Image Framebuffer::take() { return std::exchange(*this, {}).image_; }

/// Makes it a picture of that form. True if its memory is new: all zeros.
bool Framebuffer::fit(int width, int height, std::vector<std::string> names, std::vector<float> background) {
    const auto blocks_along = [](int size) { return (static_cast<std::size_t>(size) + BLOCK - 1) / BLOCK; };
    const std::size_t blocks = blocks_along(width) * blocks_along(height);
    const bool fits =  // what was moved away keeps its size, but no blocks
        image_.width == width && image_.height == height && image_.names == names && drawn_.size() == blocks;
    if (!fits) {
        *this = {};  // before there is more memory; and whole, if there is none
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        std::vector<std::vector<float>> channels(names.size());
        // Cleared page by page: by several threads, if there is much.
        for_chunks(names.size(), 1, pixels > 200'000 ? 0 : 1,
                   [&](std::size_t i, std::size_t, std::size_t) { channels[i].resize(pixels); });
        image_.width = width;
        image_.height = height;
        image_.names = std::move(names);
        image_.channels = std::move(channels);
    }
    if (!fits || background != background_) {
        drawn_.assign(blocks, 1);
        background_ = std::move(background);
    }
    return !fits;
}

}  // namespace csgrt
