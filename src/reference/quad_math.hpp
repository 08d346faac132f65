// 113-bit arithmetic for the kernels' source: what host_math.hpp has for double. Not for speed.
#pragma once

#include <cmath>

namespace csgrt::host {

#if __LDBL_MANT_DIG__ == 113
using quad = long double;
#else
__extension__ typedef __float128 quad;
#endif

/// x 2^e; exact unless it leaves the range of quad.
inline quad scaled(quad x, int e) {
    for (; e > 1000; e -= 1000) x *= quad(0x1p1000);
    for (; e < -1000; e += 1000) x *= quad(0x1p-1000);
    return x * quad(std::ldexp(1.0, e));
}

/// Newton on the double's root, 53 -> 106 -> 113 bits: within an ulp.
inline quad root(quad x) {
    if (!(x > 0)) return x == 0 ? quad(0) : quad(std::sqrt(static_cast<double>(x)));
    quad y = std::sqrt(static_cast<double>(x));
    if (!(y > 0) || y > quad(1e300)) return y;  // beyond a double's range
    for (int i = 0; i < 2; ++i) y = (y + x / y) / 2;
    return y;
}

/// a b + c: the product is exact (Veltkamp's split), the sum has one rounding more than it should.
inline quad fma(quad a, quad b, quad c) {
    const quad product = a * b;
    if (!(product - product == 0)) return product + c;
    const auto high = [](quad x) {
        const quad t = x * quad(0x1p57 + 1);
        return t - (t - x);
    };
    const quad a1 = high(a), a2 = a - a1, b1 = high(b), b2 = b - b1;
    const quad lost = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
    const quad sum = product + c, back = sum - product;
    if (!(sum - sum == 0)) return sum;
    return sum + (((product - (sum - back)) + (c - back)) + lost);
}

/// Of either zero: 0.
inline quad abs(quad x) { return x > 0 ? x : 0 - x; }

inline quad floor(quad x) {
    if (!(x < quad(1e18) && x > quad(-1e18))) return x;
    const quad whole = static_cast<quad>(static_cast<long long>(x));
    return whole > x ? whole - 1 : whole;
}

/// 2^e <= x < 2^(e + 1); x > 0, within a double's range.
inline int exponent(quad x) {
    int e = std::ilogb(static_cast<double>(x));
    if (scaled(quad(1), e) > x) --e;  // the double was rounded up
    return e;
}

}  // namespace csgrt::host
