// On a processor first hits go by packets of eight rays: pictures that no packet fits, and rays that part ways in one.
#include <random>
#include <string>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "formats/json/parse_text.hpp"
#include "integration/same_answers.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"

using namespace csgrt;

namespace {

// Cones seen from above, so that some rays of a packet are steeper than their sides; quadrics, of which a ray may have
// two segments; a tapered cone and tori, of which packets tell only which rays may meet them; a particle, which they do
// not know; surfaces seen from within; and 70 shells one in another, more than a ray has room for while none is
// claimed.
std::string scene() {
    std::string text = R"({"csgrt": 1, "units": "mm", "solids": {
        "blunt": {"type": "cone", "base": [0, 0, 0], "height": [0, 0, 10], "radius": 9, "top_radius": 2},
        "sharp": {"type": "cone", "base": [20, 0, 0], "height": [0, 0, 10], "radius": 9, "top_radius": 0},
        "leaning": {"type": "tgc", "base": [-20, 0, 0], "height": [3, 0, 10], "a": [8, 0, 0], "b": [0, 5, 0],
                    "c": [3, 0, 0], "d": [0, 4, 0]},
        "ring": {"type": "tor", "center": [0, 20, 4], "axis": [0, 0.1, 1], "radius": 6, "tube": 2},
        "link": {"type": "pipe", "points": [{"position": [0, -20, 0], "outer": 3, "inner": 1, "bend": 5},
            {"position": [0, -32, 0], "outer": 3, "inner": 1, "bend": 5},
            {"position": [0, -32, 12], "outer": 3, "inner": 1, "bend": 5}]},
        "dome": {"type": "epa", "base": [20, -20, 0], "height": [0, 1, 9], "a": [8, 0, 0], "r1": 8, "r2": 5},
        "peak": {"type": "ehy", "base": [-20, -20, 0], "height": [1, 0, 9], "a": [0, 8, 0], "r1": 8, "r2": 6, "c": 2},
        "waist": {"type": "hyp", "base": [40, 0, 0], "height": [0, 0, 12], "a": [8, 0, 0], "b": 6, "neck": 0.4},
        "pill": {"type": "part", "base": [40, 20, 3], "height": [0, 8, 4], "radius": 3, "top_radius": 6},
        "ball": {"type": "sphere", "center": [20, 20, 5], "radius": 7},
        "box": {"type": "box", "low": [14, 14, 3], "high": [26, 26, 30]},
        "floor": {"type": "half", "normal": [0, 0, 1], "distance": -1})";
    std::string shells;
    for (int i = 0; i < 70; ++i) {
        const std::string name = "shell" + std::to_string(i), size = std::to_string(8 - 0.1 * i);
        text += ", \"" + name + R"(": {"type": "sphere", "center": [-20, 20, 5], "radius": )" + size + "}";
        shells += std::string(i == 0 ? "" : ", ") + "\"" + name + "\"";
    }
    return text + R"(}, "combinations": {
        "cones": {"region": true, "tree": {"union": ["blunt", "sharp", "leaning", "ring"]}},
        "others": {"region": true, "tree": {"union": ["link", "dome", "peak", "waist", "pill"]}},
        "bowl": {"region": true, "tree": {"difference": ["ball", "box"]}},
        "core": {"region": true, "tree": {"intersection": [)" +
           shells + R"(]}},
        "ground": {"region": true, "tree": {"difference": ["floor", "blunt", "box"]}}}})";
}

}  // namespace

TEST_CASE("first hits agree at every width, where cones are steep and where rays have no room", "[agreement]") {
    const Scene parsed = scene_of(scene());
    Settings by_reference{.reference = true};
    Renderer reference(parsed, {}, by_reference), device(parsed, {}, test::on_device());
    View view{.every_partition = false};
    int overflows = 0;  // pictures some of whose rays had no room
    constexpr int large = test::sanitized ? 40 : 96;
    for (const double elevation : {90.0, 60.0, 15.0})
        for (const double perspective : {0.0, 50.0})
            for (int width = 1; width <= large; width += width < 17 ? 1 : large - 17) {
                INFO("elevation " << elevation << ", perspective " << perspective << ", width " << width);
                view.width = width;
                view.height = width < 17 ? 5 : large;
                view.camera.azimuth = 35;
                view.camera.elevation = elevation;
                view.camera.perspective = perspective;
                test::require_same(device.render(view), reference.render(view));
                overflows += device.statistics().segments > 0;  // which the exact way alone counts
            }
    CHECK(overflows > 0);
}

// Its solids wait for one another: more meet a packet than may wait, and of some rays more than there is room for.
TEST_CASE("first hits of a scene larger than a processor's caches agree", "[agreement]") {
    constexpr int balls = test::sanitized ? 10'000 : 140'000;
    Scene parsed = scene_of(scene());
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * double(random() >> 8) / double(1u << 24);
    };
    for (int i = 0; i < balls; ++i) {  // a cloud, dense in its middle
        const double spread = i % 4 == 0 ? 2 : 30;
        const Vec3 at{10 + between(-spread, spread), between(-spread, spread), 22 + between(-spread, spread) / 4};
        Solid ball{"drop" + std::to_string(i), stress::ball(at, between(0.02, 0.1)), {}};
        parsed.top.push_back(ball.name);
        parsed.objects.push_back(std::move(ball));
    }
    Settings by_reference{.reference = true};
    Renderer reference(parsed, {}, by_reference), device(parsed, {}, test::on_device());
    View view{.every_partition = false};
    view.width = test::sanitized ? 12 : 61;
    view.height = test::sanitized ? 9 : 37;
    int overflows = 0;
    for (const double azimuth : {35.0, 200.0})
        for (const double elevation : {90.0, 12.0}) {
            INFO("azimuth " << azimuth << ", elevation " << elevation);
            view.camera.azimuth = azimuth;
            view.camera.elevation = elevation;
            const Image image = reference.render(view);
            test::require_same(device.render(view), image);
            overflows += device.statistics().segments > 0;
        }
    if (!test::sanitized) CHECK(overflows > 0);
}
