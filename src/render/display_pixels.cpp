#include <csgrt/image.hpp>

#include "base/display_bytes.hpp"

namespace csgrt {

std::vector<unsigned char> display_pixels(const Image& image) {
    const std::span<const float> colors[] = {image.channel("R"), image.channel("G"), image.channel("B")};
    std::span<const float> alpha;
    if (image.has_channel("A")) alpha = image.channel("A");
    std::vector<unsigned char> pixels(4 * colors[0].size(), 255);
    for (std::size_t i = 0; i < colors[0].size(); ++i) {
        const double weight = alpha.empty() ? 1 : alpha[i];
        if (!alpha.empty()) pixels[4 * i + 3] = display_byte(weight, true);
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = weight > 0 ? colors[c][i] / weight : colors[c][i];
            pixels[4 * i + c] = display_byte(value, image.display_values);
        }
    }
    return pixels;
}

}  // namespace csgrt
