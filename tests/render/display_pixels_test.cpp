// Pictures as bytes for a display.
#include <cmath>
#include <limits>
#include <random>

#include <csgrt/image.hpp>

#include "base/srgb.hpp"
#include "catch.hpp"

using namespace csgrt;

namespace {

using Bytes = std::vector<unsigned char>;

/// One row; the colours are gray.
Image row(const std::vector<float>& values, const std::vector<float>& alpha = {}) {
    Image image{.width = static_cast<int>(values.size()), .height = 1, .names = {"R", "G", "B"}};
    std::vector<std::vector<float>> channels(3, values);
    if (!alpha.empty()) {
        image.names.emplace_back("A");
        channels.push_back(alpha);
    }
    image.channels = channels;
    return image;
}

}  // namespace

TEST_CASE("display pixels: each byte comes back from its linear light", "[promise:colors]") {
    std::vector<float> light, display;
    Bytes expected;
    for (int byte = 0; byte < 256; ++byte) {
        display.push_back(static_cast<float>(byte / 255.0));
        light.push_back(static_cast<float>(linear_of_display(byte / 255.0)));
        expected.insert(expected.end(), 3, static_cast<unsigned char>(byte));
        expected.push_back(255);
    }
    Image image = row(light);
    CHECK(display_pixels(image) == expected);
    image = row(display);
    CHECK(display_pixels(image) != expected);
    image.display_values = true;
    CHECK(display_pixels(image) == expected);
}

TEST_CASE("display pixels: rounded to the nearest byte, cut off, and 0 where there is no number") {
    std::mt19937_64 random(5);
    std::vector<float> values(100'000);
    for (float& value : values) value = std::uniform_real_distribution<float>(-0.1f, 1.1f)(random);
    const Bytes pixels = display_pixels(row(values));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double light = std::clamp(double(values[i]), 0.0, 1.0);
        const double display = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        REQUIRE(std::abs(pixels[4 * i + 1] - 255 * display) < 0.5 + 1e-5);
    }
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const bool display_values : {false, true}) {
        Image image = row({-infinity, -1, nan, infinity, 7, 1});
        image.display_values = display_values;
        const Bytes bytes = display_pixels(image);
        for (std::size_t i = 0; i < 6; ++i) CHECK(bytes[4 * i] == (i < 3 ? 0 : 255));
    }
}

TEST_CASE("display pixels: alpha is not associated, and stays linear", "[promise:colors]") {
    const float half = 0.5f, light = static_cast<float>(linear_of_display(100 / 255.0));
    CHECK(display_pixels(row({light, half * light, 0}, {1, half, 0})) ==
          Bytes{100, 100, 100, 255, 100, 100, 100, 128, 0, 0, 0, 0});
    Image weighed = row({half * 100 / 255}, {half});
    weighed.display_values = true;
    CHECK(display_pixels(weighed) == Bytes{100, 100, 100, 128});
}
