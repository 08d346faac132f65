// Framebuffer: the memory of a picture that is drawn again and again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/image.hpp>

namespace csgrt {

class RegisteredMemory;

/// A picture that is drawn again and again, as a viewer does. If the next frame has the same size, channels and
/// background as the last one, a Renderer writes only the tiles of 8 x 8 pixels that show a solid now or did in the
/// last frame. From the second such frame of one Renderer on, its GPUs copy channels directly into this memory, if they
/// have as much free memory themselves. For this the memory is registered with their drivers, which takes 0.1 s for
/// each gigabyte. A copy of a Framebuffer is deep, and is not registered. One thread at a time.
class CSGRT_API Framebuffer {
public:
    /// An empty framebuffer.
    Framebuffer();
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer& other);
    Framebuffer& operator=(const Framebuffer& other);

    /// The last frame. If the last call threw, the picture may hold parts of two frames. The reference is valid as long
    /// as this object. The next frame replaces the values.
    const Image& image() const { return image_; }
    /// Moves the picture out. The Framebuffer is empty afterwards, and the next frame allocates memory.
    Image take();

private:
    friend class Renderer;
    void fit(int width, int height, std::vector<std::string> names, std::vector<float> background, const Watch& watch);

    Image image_;
    std::vector<float> background_;      ///< one value for each channel
    std::vector<std::uint8_t> covered_;  ///< one value for each tile of 8 x 8 pixels; 0: the tile shows only background
    std::uint64_t drawn_by_ = 0;         ///< the number of the Renderer that drew the last frame
    std::shared_ptr<RegisteredMemory> registered_;  ///< the registration with devices; destroyed before the image
};

}  // namespace csgrt
