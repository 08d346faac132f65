// The one function that decodes colours: the standard's formula, and the same bits everywhere.
#include <bit>
#include <cmath>
#include <limits>

#include "base/fnv1a.hpp"
#include "base/srgb.hpp"
#include "catch.hpp"

using namespace csgrt;

TEST_CASE("display values are decoded by the formula of sRGB, to the last bits", "[promise:colors]") {
    CHECK(linear_of_display(0) == 0);
    CHECK(linear_of_display(1) == 1);
    double before = -1, largest_error = 0;
    for (int i = 0; i <= 200'000; ++i) {  // highlights, too
        const double value = i / 100'000.0, light = linear_of_display(value);
        const double expected = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        largest_error = std::max(largest_error, std::abs(light - expected) / std::max(expected, 1e-300));
        REQUIRE(light > before);
        before = light;
    }
    CHECK(largest_error < 2e-15);
    for (const double extreme : {std::numeric_limits<double>::infinity(), 1e30, 1e100})
        CHECK(linear_of_display(extreme) == Approx(std::pow(extreme / 1.055, 2.4)));
    CHECK(std::isnan(linear_of_display(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("decoded display values have the same bits on every machine", "[promise:colors]") {
    CHECK(std::bit_cast<std::uint64_t>(linear_of_display(0.5)) == 0x3fcb65b3392f5354);
    Fnv1a bits;
    for (int byte = 0; byte < 256; ++byte) bits.add(linear_of_display(byte / 255.0));
    CHECK(bits.state() == 0xffcd1ca9a4594fbf);
}
