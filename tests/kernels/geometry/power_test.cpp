// Our own powers against the standard library's in long double.
#include "catch.hpp"

#include <cmath>

#include "kernel_host/geometry.hpp"
#include "oracle/random.hpp"

using namespace csgrt;

TEST_CASE("geometry: powers are good to a few units in the last place") {
    oracle::Random random(3);
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double x = i % 2 == 0 ? random.between(0, 2) : random.power(-20, 0.3), y = random.power(-2, 2);
        const long double expected = std::pow(static_cast<long double>(x), static_cast<long double>(y));
        if (!(expected > 1e-300L)) continue;
        // y log2 x is rounded once or twice before 2 is raised to it.
        const double scale = 1 + std::abs(y * std::log2(x));
        const double off = static_cast<double>(std::abs(kernel::real_power(x, y) / expected - 1)) / scale;
        worst = std::max(worst, off);
    }
    CHECK(worst < 3e-16);
    CHECK(kernel::real_power(0, 0.3) == 0);
    CHECK(kernel::real_power(1, 0.3) == 1);
    CHECK(kernel::real_power(4, 0.5) == 2);
    CHECK(kernel::real_power(1e-300, 100) == 0);
}
