// Display values (sRGB, IEC 61966-2-1) and linear light. Of single operations that round the same everywhere, so that
// every machine gives the same bits; no library's power does.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace csgrt {

/// The linear light of a display value. 0 is black in both, 1 white; a highlight has more.
inline double linear_of_display(double value) {
    if (!(value > 0.04045)) return value / 12.92;
    // base^2.4 = base^2 * (base^2)^(1/5). Newton's steps towards that root fall, from a tangent of base^0.4, which lies
    // above it, until rounding stops them.
    const double base = (value + 0.055) / 1.055, square = base * base;
    for (double root = 0.6 + 0.4 * base;;) {
        const double fourth = (root * root) * (root * root);
        const double next = (4 * root + square / fourth) / 5;
        if (!(next < root)) return square * root;
        root = next;
    }
}

/// What byte of a display shows so much linear light, or such a display value: the nearest; of no number, 0.
inline unsigned char display_byte(double value, bool is_display_value) {
    constexpr int most = 255;
    if (!(value > 0)) return 0;
    if (is_display_value) return static_cast<unsigned char>(std::min(value, 1.0) * most + 0.5);
    int byte = 0;
    for (int step = 128; step > 0; step /= 2)
        if (byte + step <= most && value >= linear_of_display((byte + step - 0.5) / most)) byte += step;
    return static_cast<unsigned char>(byte);
}

/// The least float from 0 to 1 that a byte above this one shows.
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
