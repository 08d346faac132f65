// Quad arithmetic: 113 bits, for the kernels' source, in place of src/kernel_host/math.hpp. It is not fast.
#pragma once

#include <bit>
#include <cmath>
#include <utility>

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

/// The square root by Newton's steps from the root in double, 53 -> 106 -> 113 bits: within an ulp.
inline quad root(quad x) {
    if (!(x > 0)) return x == 0 ? quad(0) : quad(std::sqrt(static_cast<double>(x)));
    quad y = std::sqrt(static_cast<double>(x));
    if (!(y > 0) || y > quad(1e300)) return y;  // beyond a double's range
    for (int i = 0; i < 2; ++i) y = (y + x / y) / 2;
    return y;
}

/// The parts of a number: magnitude 2^exponent, where the magnitude has 113 bits.
__extension__ typedef unsigned __int128 Bits;
/// The parts of a number, for exact products and sums.
struct QuadParts {
    Bits magnitude;
    int exponent;
    bool negative, normal;  ///< not normal: 0, subnormal, infinite or NaN
};
inline QuadParts parts_of(quad x) {
    static_assert(sizeof(quad) == sizeof(Bits));
    const Bits bits = std::bit_cast<Bits>(x), leading = Bits(1) << 112;
    const int biased = static_cast<int>(bits >> 112) & 0x7fff;
    return {(bits & (leading - 1)) | leading, biased - 16383 - 112, (bits >> 127) != 0,
            biased != 0 && biased != 0x7fff};
}

/// An integer of 256 bits.
struct Wide {
    Bits high, low;

    /// The number shifted to the right; the last bit is set if a lost bit was set.
    Wide moved(int by) const {
        if (by == 0) return *this;
        if (by > 255) return {0, Bits((high | low) != 0)};
        const Bits lost = by < 128 ? low << (128 - by) : by == 128 ? low : low | (high << (256 - by));
        const Bits sticky = lost != 0;
        if (by < 128) return {high >> by, (high << (128 - by)) | (low >> by) | sticky};
        return {0, (high >> (by - 128)) | sticky};
    }
};

/// a b + c with one rounding.
///
///     a b   |<- 113 + 113 bits ->|                both stand in 256 bits, the larger one's leading bit at 253 or 254;
///     c            |<- 113 ->|                    what the smaller one loses to the right is one bit that is set
inline quad fma(quad a, quad b, quad c) {
    const QuadParts x = parts_of(a), y = parts_of(b), z = parts_of(c);
    if (!x.normal || !y.normal || !z.normal) return a * b + c;
    const Bits half = 0xffffffffffffffffu;
    const Bits x1 = x.magnitude >> 64, x0 = x.magnitude & half, y1 = y.magnitude >> 64, y0 = y.magnitude & half;
    const Bits low = x0 * y0, middle = x0 * y1 + (low >> 64), other = x1 * y0 + (middle & half);
    const Wide product{x1 * y1 + (middle >> 64) + (other >> 64), (other << 64) | (low & half)};
    // The product's leading bit, 224 or 225, is shifted to 252 or 253; the leading bit of c, 112, is shifted to 253.
    Wide p{(product.high << 28) | (product.low >> 100), product.low << 28}, q{z.magnitude << 13, 0};
    const int p_exponent = x.exponent + y.exponent - 28, q_exponent = z.exponent - 141;
    const int exponent = p_exponent > q_exponent ? p_exponent : q_exponent;
    p = p.moved(exponent - p_exponent);
    q = q.moved(exponent - q_exponent);
    bool negative = x.negative != y.negative;
    Wide sum;
    if (negative == z.negative) {
        sum = {p.high + q.high, p.low + q.low};
        sum.high += sum.low < p.low;
    } else {
        if (p.high < q.high || (p.high == q.high && p.low < q.low)) {
            std::swap(p, q);
            negative = z.negative;
        }
        sum = {p.high - q.high - (p.low < q.low), p.low - q.low};
        if ((sum.high | sum.low) == 0) return 0;
    }
    int leading = 0;  // zeros
    while (sum.high == 0) {
        sum = {sum.low, 0};
        leading += 128;
    }
    const auto top = static_cast<unsigned long long>(sum.high >> 64);
    const int zeros = top ? std::countl_zero(top) : 64 + std::countl_zero(static_cast<unsigned long long>(sum.high));
    if (zeros) sum = {(sum.high << zeros) | (sum.low >> (128 - zeros)), sum.low << zeros};
    leading += zeros;
    Bits magnitude = sum.high >> 15;
    const Bits rest = (sum.high & 0x7fff) << 1 | Bits(sum.low != 0), tie = 0x8000;
    magnitude += rest > tie || (rest == tie && (magnitude & 1));
    // If rounding makes the magnitude 2^113, it carries into the exponent, as it should.
    const int biased = exponent + 143 - leading + 112 + 16383;
    if (biased < 1 || biased > 0x7ffd) return a * b + c;  // beyond the normal numbers
    const Bits leading_one = Bits(1) << 112;
    return std::bit_cast<quad>((Bits(negative) << 127) |
                               ((Bits(static_cast<unsigned>(biased)) << 112) + (magnitude - leading_one)));
}

/// The absolute value; 0 for both zeros.
inline quad abs(quad x) { return x > 0 ? x : 0 - x; }

inline quad floor(quad x) {
    if (!(x < quad(1e18) && x > quad(-1e18))) return x;
    const quad whole = static_cast<quad>(static_cast<long long>(x));
    return whole > x ? whole - 1 : whole;
}

/// The exponent e with 2^e <= x < 2^(e + 1); x > 0, within a double's range.
inline int exponent(quad x) {
    int e = std::ilogb(static_cast<double>(x));
    if (scaled(quad(1), e) > x) --e;  // the double was rounded up
    return e;
}

}  // namespace csgrt::host
