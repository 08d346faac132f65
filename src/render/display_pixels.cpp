#include <algorithm>
#include <array>

#include <csgrt/image.hpp>

#include "base/srgb.hpp"

namespace csgrt {
namespace {

constexpr int most = 255;

/// The nearest byte; of no number, 0.
unsigned char byte_of(double value) {
    return static_cast<unsigned char>(value > 0 ? std::min(value, 1.0) * most + 0.5 : 0);
}

/// From linear light to the nearest byte of sRGB. The bounds between bytes are decoded once, so nothing is encoded.
class SrgbBytes {
public:
    SrgbBytes() {
        for (int byte = 0; byte <= most; ++byte) ends_[byte] = linear_of_display((byte + 0.5) / most);
        unsigned char byte = 0;
        for (int cell = 0; cell < cells; ++cell) {
            while (double(cell) / cells >= ends_[byte]) ++byte;
            first_[cell] = byte;
        }
    }
    unsigned char operator()(double light) const {
        if (!(light > 0)) return 0;
        if (light >= 1) return most;
        unsigned char byte = first_[static_cast<std::size_t>(light * cells)];
        while (light >= ends_[byte]) ++byte;
        return byte;
    }

private:
    static constexpr int cells = 4096;        // so many that few bounds lie in one
    std::array<double, most + 1> ends_;       // of each byte: the light with which the next begins; the last is over 1
    std::array<unsigned char, cells> first_;  // of equal parts of 0 to 1: the byte at the lower end
};

}  // namespace

std::vector<unsigned char> display_pixels(const Image& image) {
    static const SrgbBytes srgb_byte_of;
    const std::span<const float> colors[] = {image.channel("R"), image.channel("G"), image.channel("B")};
    std::span<const float> alpha;
    if (image.has_channel("A")) alpha = image.channel("A");
    std::vector<unsigned char> pixels(4 * colors[0].size(), most);
    for (std::size_t i = 0; i < colors[0].size(); ++i) {
        const double weight = alpha.empty() ? 1 : alpha[i];
        if (!alpha.empty()) pixels[4 * i + 3] = byte_of(weight);
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = weight > 0 ? colors[c][i] / weight : colors[c][i];
            pixels[4 * i + c] = image.display_values ? byte_of(value) : srgb_byte_of(value);
        }
    }
    return pixels;
}

}  // namespace csgrt
