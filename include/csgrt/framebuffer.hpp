// A picture's memory, to be drawn into again and again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/image.hpp>

namespace csgrt {

class KnownPicture;

/// A picture that is drawn again and again, as a viewer does. If the next frame has the same size, channels and
/// background as the last one, a Renderer writes only the 8 x 8 pixel blocks that show a solid now or did in the last
/// frame. From the second such frame of one Renderer on, its GPUs copy channels directly into this memory: as many as
/// there is room for on the device, at most 64 bytes a pixel. For that the memory is registered with their drivers,
/// which takes 0.1 s a gigabyte. A copy of a Framebuffer is deep, and not registered. One thread at a time.
class CSGRT_API Framebuffer {
public:
    /// No picture.
    Framebuffer();
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer& other);
    Framebuffer& operator=(const Framebuffer& other);

    /// The frame that was drawn last. If the last call threw, the picture may hold parts of two frames. The reference
    /// is valid as long as this object; the next frame replaces the values.
    const Image& image() const { return image_; }
    /// Moves the picture out. The Framebuffer is empty afterwards, and the next frame allocates memory.
    Image take();

private:
    friend class Renderer;
    void fit(int width, int height, std::vector<std::string> names, std::vector<float> background);

    Image image_;
    std::vector<float> background_;        ///< one value a channel
    std::vector<std::uint8_t> drawn_;      ///< one value a block of pixels; 0: the block is all background
    std::uint64_t drawn_by_ = 0;           ///< the number of the Renderer that drew the last frame
    std::shared_ptr<KnownPicture> known_;  ///< the registration with its devices; must not outlast the image
};

}  // namespace csgrt
