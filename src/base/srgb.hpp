// sRGB: display values (IEC 61966-2-1) and linear light. It computes with single operations that round the same
// everywhere, so that every machine gives the same bits; a library's power does not.
#pragma once

namespace csgrt {

/// The linear light of a display value. 0 is black in both, 1 white; a highlight has more.
inline double linear_of_display(double value) {
    if (!(value > 0.04045)) return value / 12.92;
    // The root is base^2.4 = base^2 * (base^2)^(1/5). Newton's steps towards it fall, from a tangent of base^0.4, which
    // lies above it, until rounding stops them.
    const double base = (value + 0.055) / 1.055, square = base * base;
    for (double root = 0.6 + 0.4 * base;;) {
        const double fourth = (root * root) * (root * root);
        const double next = (4 * root + square / fourth) / 5;
        if (!(next < root)) return square * root;
        root = next;
    }
}

}  // namespace csgrt
