// sRGB: display values (IEC 61966-2-1) and linear light. The code uses operations that IEEE 754 rounds, and no
// library's power function, so that every machine gives the same bits.
#pragma once

namespace csgrt {

/// The linear light of a display value. In both, 0 is black, 1 is white, and a highlight is above 1.
inline double linear_of_display(double value) {
    if (!(value > 0.04045)) return value / 12.92;
    // The light is base^2.4 = base^2 * (base^2)^(1/5). Newton's method finds the fifth root. It starts above the root,
    // on a tangent of base^0.4, and its values fall until rounding stops them.
    const double base = (value + 0.055) / 1.055, square = base * base;
    for (double root = 0.6 + 0.4 * base;;) {
        const double fourth = (root * root) * (root * root);
        const double next = (4 * root + square / fourth) / 5;
        if (!(next < root)) return square * root;
        root = next;
    }
}

}  // namespace csgrt
