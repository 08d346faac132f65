// The fma of 113 bits, held against sums and products that have no rounding.
#include "reference/quad_math.hpp"

#include <random>

#include "catch.hpp"

using namespace csgrt;
using host::quad;

namespace {

struct Numbers {
    std::mt19937_64 random{7};
    /// Of either sign, with `bits` random bits, some of them run of zeros or ones, times 2^-spread to 2^spread.
    quad next(int bits, int spread) {
        quad x = 0;
        for (int have = 0; have < bits; have += 32) {
            const int take = std::min(32, bits - have);
            const std::uint64_t word = random() >> 3 & 1 ? random() : random() & 1 ? ~std::uint64_t{0} : 0;
            x = host::scaled(x, take) + quad(static_cast<double>(word >> (64 - take)));
        }
        const int e = static_cast<int>(random() % (2 * static_cast<std::uint64_t>(spread) + 1)) - spread;
        return host::scaled(random() & 1 ? x : 0 - x, e);
    }
};

/// Twice the spacing of numbers of this size, or more.
quad spacing(quad x) { return host::abs(x) * host::scaled(quad(1), -111); }

}  // namespace

TEST_CASE("quad fma: exact where the product and the sum are") {
    Numbers numbers;
    for (int i = 0; i < 200'000; ++i) {
        // 50 bits by 50 bits is exact, and so is the sum of what stands near.
        const quad a = numbers.next(50, 0), b = numbers.next(50, 0), c = numbers.next(100, 5);
        REQUIRE(host::fma(a, b, c) == a * b + c);
        REQUIRE(host::fma(a, b, 0 - a * b) == 0);
    }
}

TEST_CASE("quad fma: what a product loses to rounding, and one rounding only") {
    Numbers numbers;
    for (int i = 0; i < 200'000; ++i) {
        // (a1 + a0)(b1 + b0) in four exact parts.
        const quad a1 = numbers.next(56, 0), a0 = host::scaled(numbers.next(56, 0), -57);
        const quad b1 = numbers.next(56, 0), b0 = host::scaled(numbers.next(56, 0), -57);
        const quad a = a1 + a0, b = b1 + b0, product = a * b;
        const quad lost = ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0;
        REQUIRE(host::fma(a, b, 0 - product) == lost);

        // The answer is the number nearest to a b + c: what is left of it is half a spacing at most.
        const quad c = numbers.next(113, 300), sum = host::fma(a, b, c);
        const quad s = product + c, t = s - product, left = (product - (s - t)) + (c - t);  // exact (Knuth)
        REQUIRE(host::abs((s - sum) + (left + lost)) <= spacing(sum) / 4 * (1 + host::scaled(quad(1), -50)));
    }
}

TEST_CASE("quad fma: at the ends of the range and without numbers") {
    const quad tiny = host::scaled(quad(1), -16382), huge = host::scaled(quad(1), 16383), infinity = 2 * huge;
    CHECK(host::fma(tiny, quad(0.5), 0) == tiny / 2);
    CHECK(host::fma(tiny, quad(3), 0 - 2 * tiny) == tiny);
    CHECK(host::fma(tiny, quad(1.5), 0 - tiny) == tiny / 2);
    CHECK(host::fma(huge, quad(2), 0) == infinity);
    CHECK(host::fma(huge, quad(1), huge) == infinity);
    CHECK(host::fma(infinity, quad(1), 1) == infinity);
    const quad none = host::fma(infinity, quad(0), 1);
    CHECK_FALSE(none == none);
    CHECK(host::fma(quad(0), quad(5), 3) == 3);
    CHECK(host::fma(quad(3), quad(5), 0) == 15);
    CHECK(host::fma(huge, quad(1), 1) == huge);
    CHECK(host::fma(tiny, tiny, 1) == 1);
}
