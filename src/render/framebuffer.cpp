// Framebuffer: the memory of pictures, and the record of which tiles are background already.
#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include <csgrt/renderer.hpp>

#include "device/driver_call.hpp"
#include "kernel_host/kernels.hpp"
#include "pipeline/readback/registered_memory.hpp"

namespace csgrt {

Framebuffer::Framebuffer() = default;

Framebuffer::~Framebuffer() {
    // Memory that is registered with a GPU's driver cannot be unregistered after exit(), so it is never freed.
    if (!DriverCall::of_destructor(registered_ != nullptr).has_begun())
        static_cast<void>(new (std::nothrow) Image(std::move(image_)));
}

Framebuffer::Framebuffer(Framebuffer&& other) noexcept = default;

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    registered_ = nullptr;  // released before the image
    image_ = std::exchange(other.image_, {});
    background_ = std::exchange(other.background_, {});
    covered_ = std::exchange(other.covered_, {});
    drawn_by_ = std::exchange(other.drawn_by_, 0);
    registered_ = std::exchange(other.registered_, nullptr);
    return *this;
}

Framebuffer::Framebuffer(const Framebuffer& other)
    : image_(other.image_), background_(other.background_), covered_(other.covered_) {}

Framebuffer& Framebuffer::operator=(const Framebuffer& other) { return *this = Framebuffer(other); }

Image Framebuffer::take() {
    registered_ = nullptr;
    return std::exchange(*this, {}).image_;
}

/// Resizes the framebuffer to a picture of this form; new memory is background. Throws Error (interrupted) if `watch`
/// ends the work.
void Framebuffer::fit(int width, int height, std::vector<std::string> names, std::vector<float> background,
                      const Watch& watch) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };  // the values may be ids
    const auto tiles_along = [](int size) { return (static_cast<std::size_t>(size) + TILE - 1) / TILE; };
    const std::size_t tiles = tiles_along(width) * tiles_along(height);
    const bool fits =  // a moved-from image keeps its size, but has no tiles
        image_.width == width && image_.height == height && image_.names == names && covered_.size() == tiles;
    if (!fits) {
        *this = {};  // frees the memory before more is taken, and is valid if there is no more
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        Channels channels(pixels, background, &watch);
        image_.width = width;
        image_.height = height;
        image_.names = std::move(names);
        image_.channels = std::move(channels);
    }
    if (!fits)
        covered_.assign(tiles, 0);
    else if (!std::ranges::equal(background, background_, {}, bits, bits))
        std::fill(covered_.begin(), covered_.end(), std::uint8_t{1});
    background_ = std::move(background);
}

}  // namespace csgrt
