// The measurer through the library.
#include <csgrt/measure.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "bodies.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "figures.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::block, test::leg, test::region, test::thrown_by;

namespace {

Settings on_native() { return {.device = "native"}; }

const Measured& part(const Measurement& result, const std::string& name) {
    const auto found =
        std::find_if(result.parts.begin(), result.parts.end(), [&name](const Measured& m) { return m.name == name; });
    INFO(name);
    REQUIRE(found != result.parts.end());
    return *found;
}

Measurement measured(const Scene& scene, const MeasureRequest& request = {}, Settings settings = on_native()) {
    return Measurer(Model(scene, {}, settings), settings).measure(request);
}

/// All that may not depend on a device, as bytes.
std::string bytes_of(const Measurement& result) {
    std::string bytes = std::to_string(result.rays);
    for (const Measured& m : result.parts) {
        bytes += m.name;
        for (const Estimate& e : test::estimates_of(m))
            for (const double value : {e.value, e.half_width})
                bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return bytes;
}

void check_near(const Estimate& estimate, double truth) {
    CAPTURE(estimate.value, estimate.half_width, truth);
    CHECK(std::abs(estimate.value - truth) <= 2.5 * estimate.half_width + 1e-12 * std::abs(truth));
}

/// A block of 10 x 10 x 10 and one that overlaps its half, in an assembly; and a third on its own.
Scene blocks() {
    Combination first = region("first", {leg("a")}), second = region("second", {leg("b")}, 1001),
                third = region("third", {leg("c")}, 1002);
    first.material_id = 2;
    second.material_id = third.material_id = 3;
    third.los = 50;
    return test::scene({block("a", {0, 0, 0}, {10, 10, 10}), block("b", {5, 0, 0}, {15, 10, 10}),
                        block("c", {100, 0, 0}, {110, 10, 10}), first, second, third,
                        test::group("pair", {leg("first"), leg("second"), test::either}),
                        test::group("all", {leg("pair"), leg("third"), test::either})});
}

}  // namespace

TEST_CASE("figures of known bodies are within their intervals, which are small", "[promise:measure]") {
    for (const test::Body& body : test::bodies()) {
        CAPTURE(body.name);
        const Measurement result = measured(body.scene);
        const Measured& m = part(result, "/" + body.name);
        CHECK(result.reached);
        CHECK(m.volume.half_width <= 0.01 * m.volume.value);
        const std::vector<double> truths = test::truths_of(body);
        const std::vector<Estimate> estimates = test::estimates_of(m);
        for (std::size_t i = 0; i < truths.size(); ++i) {
            CAPTURE(i);
            check_near(estimates[i], truths[i]);
        }
        CHECK(m.area.half_width < 0.02 * m.area.value);
        CHECK(m.centroid[0].half_width < 0.2);
    }
}

TEST_CASE("gqa's documented models are measured to 1 %", "[promise:measure]") {
    // Of 10 m: a box, a closed box, a box that is open at one side, its air, half of it; and a ball of 1 m.
    const Vec3 o = {0, 0, 0}, m10 = {1e4, 1e4, 1e4}, m1 = {1e3, 1e3, 1e3}, m9 = {9e3, 9e3, 9e3};
    const Scene scene =
        test::scene({block("outer", o, m10), block("inner", m1, m9), block("open", {1e3, 1e3, 1e3}, {1e4, 9e3, 9e3}),
                     block("half", m1, {9e3, 9e3, 5e3}), test::ball("ball", {}, 1000), region("box", {leg("outer")}),
                     region("closed", {leg("outer"), leg("inner"), test::less}),
                     region("exposed", {leg("outer"), leg("open"), test::less}), region("air", {leg("open")}),
                     region("adjacent", {leg("half")}), region("sphere", {leg("ball")})});
    const std::pair<const char*, double> known[] = {{"box", 1000}, {"closed", 488},   {"exposed", 424},
                                                    {"air", 576},  {"adjacent", 256}, {"sphere", 4.18879}};
    for (const auto& [name, volume] : known) {
        CAPTURE(name);
        Settings settings = on_native();
        const Measurement result = Measurer(Model(scene, {name}, settings), settings).measure();
        CHECK(result.parts[0].volume.half_width <= 0.01 * volume * 1e9);
        check_near(result.parts[0].volume, volume * 1e9);
    }
}

TEST_CASE("a measure has the same bits on every device and number of threads", "[promise:measure]") {
    const Scene scene = blocks();
    const MeasureRequest request{.rel_error = 1e-3};
    const std::string bytes = bytes_of(measured(scene, request));
    for (const unsigned threads : {1u, 2u, 16u})
        CHECK(bytes_of(measured(scene, request, {.device = "native", .threads = threads})) == bytes);
    CHECK(bytes_of(measured(scene, {.rel_error = 1e-3, .seed = 2})) != bytes);
    const std::string few = bytes_of(measured(scene, {.rays = 5000}));
    CHECK(bytes_of(measured(scene, {.rays = 5000}, {.reference = true})) == few);
    for (const DeviceInfo& device : devices())
        CHECK(bytes_of(measured(scene, {.rays = 5000}, {.device = device.name})) == few);
}

TEST_CASE("a measurer that measures twice answers the same", "[promise:measure]") {
    Measurer measurer(Model(blocks(), {}, on_native()), on_native());
    const Measurement first = measurer.measure({.rel_error = 1e-3, .densities = {{.material_id = 2, .density = 1}}});
    CHECK(bytes_of(measurer.measure({.rel_error = 1e-3})) == bytes_of(measured(blocks(), {.rel_error = 1e-3})));
    CHECK(first.has_densities);
}

TEST_CASE("an overlap is owned once, and claimed by each", "[promise:measure]") {
    const Measurement result = measured(blocks(), {.rel_error = 1e-3});
    check_near(part(result, "/all/pair/first").volume, 1000);
    check_near(part(result, "/all/pair/second").volume, 500);
    check_near(part(result, "/all/pair/second").claimed, 1000);
    check_near(part(result, "/all/pair").volume, 1500);
    check_near(part(result, "/all/pair").claimed, 2000);
    check_near(part(result, "/all/pair").area, 600 + 400);  // the face between both counts twice
    check_near(part(result, "all").volume, 2500);
    check_near(part(result, "/all/pair").centroid[0], 7.5);
    CHECK(part(result, "/all/pair").box.high == Vec3{15, 10, 10});
    CHECK(part(result, "material 3").regions == 2);
    check_near(part(result, "material 3").volume, 1500);
}

TEST_CASE("densities give masses, and the later row counts", "[promise:measure]") {
    const Scene scene = blocks();
    const Measurement own = measured(scene, {.rel_error = 1e-3,
                                             .densities = {{.material_id = 2, .density = 7.85, .name = "steel"},
                                                           {.material_id = 3, .density = 2.7}}});
    REQUIRE(own.has_densities);
    check_near(part(own, "/all/pair/first").mass, 7.85e-3);
    check_near(part(own, "/all/third").mass, 0.5 * 2.7e-3);  // los
    check_near(part(own, "steel").mass, 7.85e-3);
    check_near(part(own, "/all/pair").centroid[0], (7.85 * 5 + 1.35 * 12.5) / (7.85 + 1.35));
    check_near(part(own, "/all/pair/first").central[0], 7.85e-3 * 1000 / 1000 * (100.0 + 100) / 12);
    CHECK(part(own, "all").weightless == 0);

    const Measurement given = measured(
        scene,
        {.rel_error = 1e-3, .densities = {{.material_id = 2, .density = 1}, {.path = "all/pair/", .density = 2}}});
    check_near(part(given, "/all/pair/first").mass, 2e-3);
    check_near(part(given, "/all/pair").mass, 3e-3);
    CHECK(part(given, "all").weightless == 1);
    CHECK(part(given, "/all/third").mass.value == 0);
    CHECK(std::isnan(part(given, "/all/third").centroid[0].value));
}

TEST_CASE("a region that no ray meets is listed with a bound", "[promise:measure]") {
    const Scene scene =
        test::scene({block("a", {0, 0, 0}, {10, 10, 10}), block("b", {2, 2, 2}, {8, 8, 8}),
                     block("c", {20, 0, 0}, {30, 10, 10}), region("outer", {leg("a")}),
                     region("inner", {leg("b")}, 1001), region("nothing", {leg("a"), leg("c"), test::both}, 1002)});
    const Measurement result = measured(scene);
    const Measured& inner = part(result, "/inner");
    CHECK(inner.volume.value == 0);
    CHECK(inner.unmet == 1);
    CHECK((inner.unmet_bound > 0 && inner.unmet_bound < 0.1));
    check_near(inner.claimed, 216);
    CHECK(part(result, "all").unmet == 1);
    CHECK(part(result, "/nothing").unmet == 0);
    CHECK(part(result, "/nothing").reached == 1);
    CHECK(!result.reached);
    check_near(part(result, "all").volume, 1000);
}

TEST_CASE("the smallest wall of a body is found exactly, whatever the seed", "[promise:measure]") {
    const std::map<std::string, double> known = {{"ball", 20},      {"box", 7},          {"torus", 6},
                                                 {"pipe", 0.1},     {"shell", 0.001},    {"plate", 0.02},
                                                 {"Steinmetz", 10}, {"two scales", 0.02}};
    for (const test::Body& body : test::bodies()) {
        CAPTURE(body.name);
        for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
            const Measurement result = measured(body.scene, {.seed = seed, .walls = true});
            const Wall& wall = part(result, "/" + body.name).wall;
            CAPTURE(seed, wall.thickness);
            if (body.name == "cone") {
                CHECK(wall.thickness == 0);  // its tip is an edge
            } else if (const auto found = known.find(body.name); found != known.end()) {
                CHECK(std::abs(wall.thickness - found->second) < 1e-9);
                CHECK(!wall.is_tapered);
                const Vec3 a = wall.from, b = wall.to;
                CHECK(std::abs(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) - wall.thickness) < 1e-9);
                double shares = 0;
                for (const double share : wall.shares) shares += share;
                CHECK(std::abs(shares - 1) < 1e-12);
            } else if (body.name == "lens") {
                CHECK(wall.is_tapered);
                CHECK((wall.thickness > 7.5 && wall.thickness < 8));
            }
        }
    }
}

TEST_CASE("a round wall does not hide a smaller plane one", "[promise:measure]") {
    // The plate is 5 thick, and there are 7 between its bore and its sides.
    const Scene scene =
        test::scene({block("a", {0, 0, 0}, {20, 20, 5}),
                     test::solid("b", Tgc{{10, 10, -1}, {0, 0, 7}, {3, 0, 0}, {0, 3, 0}, {3, 0, 0}, {0, 3, 0}}),
                     region("plate", {leg("a"), leg("b"), test::less})});
    for (const std::uint64_t seed : {1, 2, 3, 4, 5})
        CHECK(measured(scene, {.seed = seed, .walls = true}).parts[0].wall.thickness == 5);
}

TEST_CASE("a limit of walls counts thinner ones, and none of its own thickness", "[promise:measure]") {
    const std::pair<double, std::uint64_t> limits[] = {{9.9, 0}, {10, 0}, {10 * (1 + 5e-10), 0}, {10.0001, 3}};
    for (const auto& [limit, thin] : limits) {
        CAPTURE(limit);
        const Measurement result = measured(blocks(), {.wall_limit = limit});
        CHECK(part(result, "/all/pair/first").wall.thickness == 10);
        CHECK(part(result, "/all/pair/second").wall.thickness == 5);  // what it owns
        CHECK(part(result, "all").thin == thin + (thin == 0));
        CHECK(part(result, "all").wall.thickness == 5);
    }
    CHECK(measured(blocks()).parts[0].wall.thickness == 0);
}

TEST_CASE("a measure ends when it is told to, with what it has", "[promise:measure]") {
    const MeasureRequest endless{.rel_error = 1e-12};
    Measurer measurer(Model(blocks(), {}, on_native()), on_native());
    int looks = 0;
    const Measurement stopped = measurer.measure(endless, [&looks](const Measurement& so_far) {
        CHECK(so_far.parts.size() == 1);
        return ++looks < 2;
    });
    CHECK(looks == 2);
    CHECK(!stopped.reached);
    check_near(stopped.parts[0].volume, 2500);
    const Measurement timed = measurer.measure({.rel_error = 1e-12, .time = 0.05});
    CHECK(!timed.reached);
    check_near(timed.parts[0].volume, 2500);

    const auto ends_at_once = [](double) { return false; };
    Settings settings = on_native();
    settings.progress = ends_at_once;
    Measurer interrupted(Model(blocks(), {}, on_native()), settings);
    CHECK(thrown_by([&] { interrupted.measure(); }).status == Status::interrupted);
}

TEST_CASE("what cannot be measured is refused", "[promise:measure]") {
    Scene endless = test::scene({test::solid("h", Half{{{0, 0, 1}, 0}}), region("ground", {leg("h")})});
    const test::Thrown thrown = thrown_by([&] { measured(endless); });
    CHECK(thrown.status == Status::usage);
    CHECK(test::says(thrown.text, "/ground has no end"));
    for (const MeasureRequest& request : {MeasureRequest{.rel_error = 0},
                                          {.rel_error = std::nan("")},
                                          {.abs_error = -1},
                                          {.time = -1},
                                          {.densities = {{.density = -1}}},
                                          {.densities = {{.path = "/nothing", .density = 1}}},
                                          {.wall_limit = -1}})
        CHECK(thrown_by([&] { measured(blocks(), request); }).status == Status::usage);
    const Measurement empty = measured(test::scene({block("a", {0, 0, 0}, {1, 1, 1}), block("b", {3, 0, 0}, {4, 1, 1}),
                                                    region("none", {leg("a"), leg("b"), test::both})}));
    CHECK(empty.reached);
    CHECK(empty.parts[0].volume.value == 0);
}
