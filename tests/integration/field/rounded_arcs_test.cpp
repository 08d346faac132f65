// Half circles whose radius was written with few digits, as CAD programs write them: the ends may lie farther apart
// than the diameter. Up to Limits::half_circle of it that is a half circle; beyond it is refused with the numbers.
#include "catch.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/json/parse_text.hpp"
#include "integration/field/judge.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

std::string digits(double x, int count) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", count, x);
    return text;
}

/// A half disc over the chord from (-chord / 2, 0) to (chord / 2, 0), 4 mm high.
std::string as_json(double chord, const std::string& radius) {
    const std::string half = digits(chord / 2, 17);
    return R"({"csgrt": 1, "solids": {"s": {"type": "extrude", "base": [0, 0, 0], "height": [0, 0, 4], "sketch":
        {"vertices": [[-)" +
           half + ", 0], [" + half + R"(, 0]], "curves": [{"line": [0, 1]}, {"arc": [1, 0], "radius": )" + radius +
           "}]}}}}";
}
std::string as_asc(double chord, const std::string& radius) {
    const std::string half = digits(chord / 2, 17);
    return "title {}\nunits mm\nput {k} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {-" + half + " 0} {" + half +
           " 0} } SL { { line S 0 E 1 } { carc S 1 E 0 R " + radius +
           " L 1 O 0 } }\nput {s} extrude V {0 0 0} H {0 0 4} A {1 0 0} B {0 1 0} S k\n";
}

std::string fault_of(const Scene& scene) {
    const std::vector<Diagnostic> found = validate(scene, {"s"});
    return found.empty() ? std::string() : found.front().message;
}

void check_arcs(std::uint64_t seed, int count) {
    Random random(seed);
    int taken = 0, refused = 0;
    for (int i = 0; i < count; ++i) {
        const double chord = random.between(1, 10) * random.power_of_ten(-2, 4);
        std::string radius = digits(chord / 2, random.whole(4, 9));
        const double short_of = chord / (2 * std::strtod(radius.c_str(), nullptr)) - 1;
        if (short_of < 0) continue;  // a circle's arc like others
        const bool is_half = short_of <= Limits::half_circle;
        for (const Scene& scene : {scene_of(as_json(chord, radius)), asc_test::parse(as_asc(chord, radius))}) {
            const std::string fault = fault_of(scene);
            INFO(chord << ", " << radius << ": " << fault);
            if (!is_half) {
                CHECK(fault.find("is an arc of too small a radius, ") != std::string::npos);
                CHECK(fault.find("at most 1e-05 is taken for a half circle") != std::string::npos);
                ++refused;
                continue;
            }
            REQUIRE(fault.empty());
            ++taken;
            const double y = random.between(0.01, 0.49) * chord;
            const std::vector<Ray> ray{{{-2 * chord, y, 1}, {1, 0, 0}}};
            const auto found = Renderer(scene, {"s"}, test::on_reference()).shoot(ray);
            test::require_same(Renderer(scene, {"s"}, test::on_device()).shoot(ray), found);
            REQUIRE(found[0].partitions.size() == 1);
            const double reach = std::sqrt((chord / 2 - y) * (chord / 2 + y));
            CHECK(found[0].partitions[0].in == Approx(2 * chord - reach).epsilon(1e-10));
            CHECK(found[0].partitions[0].out == Approx(2 * chord + reach).epsilon(1e-10));
        }
    }
    CHECK(taken * 5 > count);
    CHECK(refused * 40 > count);
}

}  // namespace

TEST_CASE("a half circle of a radius of few digits is a half circle", "[field][promise:scenes]") { check_arcs(1, 120); }
TEST_CASE("a half circle of a radius of few digits is a half circle, 10^4 of them", "[.long][promise:scenes]") {
    check_arcs(2, 10'000);
}
