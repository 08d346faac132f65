// Display bytes: converts the colours of pictures to a display's bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/srgb.hpp"

namespace csgrt {

inline constexpr int last_byte = 255;

/// Converts linear light to the nearest byte of sRGB. The light between each two bytes is computed once, so a
/// conversion only searches a table.
class SrgbBytes {
public:
    SrgbBytes() {
        for (int byte = 0; byte <= last_byte; ++byte) ends_[byte] = linear_of_display((byte + 0.5) / last_byte);
        unsigned char byte = 0;
        for (int cell = 0; cell < cells; ++cell) {
            while (double(cell) / cells >= ends_[byte]) ++byte;
            first_[cell] = byte;
        }
    }
    unsigned char operator()(double light) const {
        if (!(light > 0)) return 0;
        if (light >= 1) return last_byte;
        unsigned char byte = first_[static_cast<std::size_t>(light * cells)];
        while (light >= ends_[byte]) ++byte;
        return byte;
    }

private:
    static constexpr int cells = 4096;        // many, so that few bounds lie in one cell
    std::array<double, last_byte + 1> ends_;  // for each byte: the light where the next byte begins; the last is over 1
    std::array<unsigned char, cells> first_;  // one for each equal part of 0 to 1: the byte at its lower bound
};

/// The byte nearest to a display value, or to the sRGB value of linear light. 0 if the value is not a number.
inline unsigned char display_byte(double value, bool is_display_value) {
    static const auto* const of_light = new SrgbBytes;  // never destroyed: threads use it while the process ends
    if (!is_display_value) return (*of_light)(value);
    return static_cast<unsigned char>(value > 0 ? std::min(value, 1.0) * last_byte + 0.5 : 0);
}

/// The least float from 0 to 1 whose display byte is above `byte`.
inline float display_end(int byte, bool is_display_value) {
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);  // positive floats are ordered as their bits
    while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (display_byte(double{std::bit_cast<float>(middle)}, is_display_value) > byte)
            high = middle;
        else
            low = middle + 1;
    }
    return std::bit_cast<float>(low);
}

}  // namespace csgrt
