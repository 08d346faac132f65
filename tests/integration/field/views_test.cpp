// What a picture shows: lights of regions, judged by the terms of the plastic computed here in double; parallel views
// that zoom; the eye, the point that it looks at, and what is up.
#include "catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/laboratory.hpp"
#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/json/reader.hpp"
#include "formats/json/write/writer.hpp"
#include "formats/json/parse_text.hpp"
#include "integration/same_answers.hpp"
#include "stress/build.hpp"
#include "integration/stress/check.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

double size_of(const Vec3& v) { return std::sqrt(dot(v, v)); }

/// A light as BRL-CAD describes it, which the test places itself.
struct Lamp {
    Vec3 center;
    double red = 1;  // of its colour; the others 1
    double intensity = 1, fraction = 0, angle = 180;
    std::optional<Vec3> target;
    bool infinite = false;

    std::string shader() const {
        std::string text = "light {v 0 b " + std::to_string(intensity);
        if (fraction > 0) text += " f " + std::to_string(fraction);
        if (angle < 180) text += " a " + std::to_string(angle);
        if (target)
            text += " t {" + std::to_string(target->x) + " " + std::to_string(target->y) + " " +
                    std::to_string(target->z) + "}";
        if (infinite) text += " i 1";
        return text + "}";
    }
};

/// A block whose face x = 100 a view from +x looks at, and lamps of radius 3, as text of BRL-CAD's v5.
std::string lit_block(const std::vector<Lamp>& lamps) {
    std::string text =
        "title {lit}\nunits mm\n"
        "put {block.s} arb8 V1 {-100 -100 -100} V2 {100 -100 -100} V3 {100 100 -100} V4 {-100 100 -100} "
        "V5 {-100 -100 100} V6 {100 -100 100} V7 {100 100 100} V8 {-100 100 100}\n"
        "put {block.r} comb region yes tree {l block.s}\n"
        "attr set {block.r} {region} {R} {rgb} {255/128/64}\n";
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const std::string name = "lamp" + std::to_string(i);
        const Vec3& c = lamps[i].center;
        text += "put {" + name + ".s} ell V {" + std::to_string(c.x) + " " + std::to_string(c.y) + " " +
                std::to_string(c.z) + "} A {3 0 0} B {0 3 0} C {0 0 3}\n";
        text += "put {" + name + ".r} comb region yes tree {l " + name + ".s}\n";
        text += "attr set {" + name + ".r} {region} {R} {rgb} {" + std::to_string(int(255 * lamps[i].red + 0.5)) +
                "/255/255} {oshader} {" + lamps[i].shader() + "}\n";
    }
    return text;
}

/// The red and green of the face at `p`, by the textbook: ambient, Lambert and Phong terms, in linear light or as
/// BRL-CAD has them. Nothing where the edge of a beam is so near that rounding decides.
std::optional<std::pair<double, double>> shade(const std::vector<Lamp>& lamps, const Vec3& p, bool display_shading) {
    const auto shaded = [&](double x) {
        if (display_shading) return x;
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    const Vec3 n{1, 0, 0}, to_eye{1, 0, 0};
    const double color[2] = {1, shaded(128.0 / 255)};
    double brightest = 0, seen[2] = {0.4 * color[0], 0.4 * color[1]};
    for (const Lamp& lamp : lamps)
        if (lamp.fraction == 0) brightest = std::max(brightest, lamp.intensity);
    for (const Lamp& lamp : lamps) {
        const double share = lamp.fraction > 0 ? lamp.fraction : lamp.intensity / (brightest * 1.2);
        const Vec3 way = lamp.infinite ? lamp.center : lamp.center - p;
        const Vec3 l = (1 / size_of(way)) * way;
        const double cosine = dot(n, l);
        if (cosine <= 0) continue;
        if (lamp.angle < 180) {
            const Vec3 axis = lamp.target ? *lamp.target - lamp.center : Vec3{0, 0, -1};
            const double within = -dot(l, axis) / size_of(axis),
                         edge = std::cos(lamp.angle * 3.14159265358979323846 / 180);
            if (std::abs(within - edge) < 1e-6) return std::nullopt;
            if (within < edge) continue;
        }
        const double mirrored = dot(2 * cosine * n - l, to_eye),
                     gloss = mirrored > 0 ? 0.7 * std::pow(mirrored, 10) : 0;
        const double red = shaded(int(255 * lamp.red + 0.5) / 255.0);
        seen[0] += share * red * (0.3 * cosine * color[0] + gloss);
        seen[1] += share * (0.3 * cosine * color[1] + gloss);
    }
    return std::pair(seen[0], seen[1]);
}

View from_x(int size, double view_size) {
    View view{size, size, {}};
    view.camera.azimuth = view.camera.elevation = 0;
    view.camera.center = Vec3{};
    view.camera.view_size = view_size;
    return view;
}

std::vector<Lamp> some_lamps(std::uint64_t seed) {
    Random random(seed);
    std::vector<Lamp> lamps;
    for (int i = random.whole(1, 3); i > 0; --i) {
        Lamp lamp;
        // The numbers of the text have six digits behind the point.
        const auto coordinate = [&](double from, double to) {
            return std::round(random.between(from, to) * 100) / 100;
        };
        lamp.center = {coordinate(-50, 400), coordinate(-300, 300), coordinate(-300, 300)};
        lamp.red = random.whole(0, 4) / 4.0;
        lamp.intensity = random.whole(1, 8) / 4.0;
        if (random.whole(0, 2) == 0) lamp.fraction = random.whole(1, 8) / 8.0;
        if (random.whole(0, 1) == 0) lamp.angle = random.whole(10, 170);
        if (random.whole(0, 1) == 0) lamp.target = Vec3{100, coordinate(-100, 100), coordinate(-100, 100)};
        lamp.infinite = random.whole(0, 3) == 0;
        lamps.push_back(lamp);
    }
    return lamps;
}

std::span<const float> channel_of(const Image& image, const char* name) { return image.channel(name); }

/// How many pixels of the face were compared.
std::size_t check_lamps(std::uint64_t seed) {
    const std::vector<Lamp> lamps = some_lamps(seed);
    const Scene scene = parse_brlcad_asc(TextSource("lit.asc", lit_block(lamps)));
    constexpr int size = 16;
    constexpr double view_size = 320;
    View view = from_x(size, view_size);
    Settings on_device, on_reference = test::on_reference();
    on_device.display_shading = on_reference.display_shading = seed % 2 == 0;
    Renderer reference(scene, {}, on_reference);
    const Image image = reference.render(view);
    // The same through JSON, and on a device; every partition, or first hits alone.
    const Scene again = scene_of(json_scene_text(scene));
    test::require_same(image, Renderer(again, {}, on_reference).render(view));
    if (!devices().empty()) {
        Renderer device(scene, {}, on_device);
        test::require_same(image, device.render(view));
        view.every_partition = false;
        test::require_same(reference.render(view), device.render(view));
    }
    std::size_t compared = 0;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const std::size_t i = static_cast<std::size_t>(row * size + column);
            const double pitch = view_size / size;
            const Vec3 p{100, (column + 0.5 - size / 2) * pitch, (size / 2 - row - 0.5) * pitch};
            const bool on_face = std::max(std::abs(p.y), std::abs(p.z)) < 100;
            INFO("seed " << seed << ", pixel " << column << " " << row);
            CHECK((image.ids("region")[i] != 0) == on_face);
            const auto expected = shade(lamps, p, on_device.display_shading);
            if (!on_face || !expected) continue;
            CHECK_THAT(channel_of(image, "R")[i], Catch::Matchers::WithinAbs(expected->first, 2e-6));
            CHECK_THAT(channel_of(image, "G")[i], Catch::Matchers::WithinAbs(expected->second, 2e-6));
            ++compared;
        }
    return compared;
}

/// Some solids and regions, in a ball of radius 20 or so.
Scene some_scene(std::uint64_t seed) {
    Builder to("views", seed, 1);
    Random& random = to.random();
    for (int i = random.whole(2, 5); i > 0; --i) {
        std::vector<std::string> solids;
        for (int k = random.whole(1, 3); k > 0; --k) solids.push_back(some_solid(to));
        to.region(some_tree(solids, random));
    }
    return to.take().scene;
}

/// The pixels of a view along an axis that zooms, and those of the whole view on the same lines. Returns how many
/// differ.
std::size_t differing(const Scene& scene, std::uint64_t seed, std::size_t& compared) {
    constexpr double angles[][2] = {{0, 0}, {90, 0}, {180, 0}, {270, 0}, {0, 90}, {0, -90}};
    constexpr int whole_size = 64, part_size = 16;
    Random random(seed);
    Renderer renderer(scene, {}, test::on_reference());
    View whole{whole_size, whole_size, {}};
    whole.camera.azimuth = angles[seed % 6][0];
    whole.camera.elevation = angles[seed % 6][1];
    whole.camera.center = Vec3{};
    whole.camera.view_size = 128;
    View part = whole;
    part.width = part.height = part_size;
    part.camera.view_size = 32;
    const int right = random.whole(-4, 4), up = random.whole(-4, 4);  // 2 mm a pixel
    const Vec3 moves[][2] = {{{0, 1, 0}, {0, 0, 1}}, {{-1, 0, 0}, {0, 0, 1}}, {{0, -1, 0}, {0, 0, 1}},
                             {{1, 0, 0}, {0, 0, 1}}, {{0, 1, 0}, {-1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}}};
    const auto& [u, v] = moves[seed % 6];
    part.camera.center = 2.0 * right * u + 2.0 * up * v;
    const Image all = renderer.render(whole), some = renderer.render(part);
    std::size_t different = 0;
    std::optional<double> moved;
    for (int row = 0; row < part_size; ++row)
        for (int column = 0; column < part_size; ++column) {
            const auto i = static_cast<std::size_t>(row * part_size + column);
            const auto k = static_cast<std::size_t>((row + 24 - up) * whole_size + column + 24 + right);
            bool same = true;
            for (const char* name : {"region", "solid"}) same = same && all.ids(name)[k] == some.ids(name)[i];
            for (const char* name : {"partitions", "depth"})
                same = same && channel_of(all, name)[k] == channel_of(some, name)[i];
            for (const char* name : {"R", "G", "B", "N.X", "N.Y", "N.Z"})
                same = same && std::abs(channel_of(all, name)[k] - channel_of(some, name)[i]) < 1e-5;
            if (some.ids("region")[i] != 0) {  // the rays start on another plane, and that is all
                const double far = channel_of(all, "Z")[k] - channel_of(some, "Z")[i];
                if (!moved) moved = far;
                same = same && std::abs(far - *moved) < 1e-4;
            }
            different += !same;
            ++compared;
        }
    return different;
}

/// Of pixels that show one region in both, the largest difference of a colour.
double largest_difference(const Image& a, const Image& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.channels[0].size(); ++i) {
        if (a.ids("solid")[i] != b.ids("solid")[i]) continue;
        for (const char* name : {"R", "G", "B"})
            most = std::max(most, double(std::abs(channel_of(a, name)[i] - channel_of(b, name)[i])));
    }
    return most;
}

std::string refusal(const Scene& scene, const Camera& camera) {
    return test::failure(Status::usage, [&] { Renderer(scene, {}, test::on_reference()).render({8, 8, camera}); });
}

Scene block_scene() { return parse_brlcad_asc(TextSource("lit.asc", lit_block({}))); }

}  // namespace

TEST_CASE("field: regions of the shader light give the terms of plastic at every pixel", "[field][promise:colors]") {
    std::size_t compared = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) compared += check_lamps(seed);
    CHECK(compared > 1500);
}

TEST_CASE("field: many lights", "[.long]") {
    std::size_t compared = 0;
    for (std::uint64_t seed = 100; seed < 1100; ++seed) compared += check_lamps(seed);
    CHECK(compared > 90'000);
}

namespace {

/// A lamp that stands before the face and reaches into the block.
Scene lamp_in_block() {
    Lamp lamp;
    lamp.center = {100, 0, 0};
    return parse_brlcad_asc(TextSource("lit.asc", lit_block({lamp})));
}

void require_lamp_on_device(Settings settings) {
    if (devices().empty()) return;
    Renderer device(lamp_in_block(), {}, settings);
    settings.reference = true;
    Renderer reference(lamp_in_block(), {}, settings);
    View view = from_x(16, 16);
    for (const bool every : {true, false}) {
        view.every_partition = every;
        test::require_same(device.render(view), reference.render(view));
    }
    test::require_same(device.shoot({{{500, 1, 1}, {-1, 0, 0}}}), reference.shoot({{{500, 1, 1}, {-1, 0, 0}}}));
}

}  // namespace

TEST_CASE("views: a light that is not visible, in single precision", "[.pocl][promise:colors]") {
    require_lamp_on_device({.precision = Precision::single});
    require_lamp_on_device(with_methods({.single_world = true}));
}

TEST_CASE("views: a light that is not visible is not drawn, yields to what stands in it, and is met by rays",
          "[promise:colors]") {
    require_lamp_on_device({});
    Scene scene = lamp_in_block();
    const View view = from_x(16, 16);
    const Image image = Renderer(scene, {}, test::on_reference()).render(view);
    for (std::size_t i = 0; i < 256; ++i) CHECK(image.ids("region")[i] == 1);
    Renderer renderer(scene, {}, test::on_reference());
    const auto answer = renderer.shoot({{{500, 1, 1}, {-1, 0, 0}}});
    REQUIRE(answer[0].partitions.size() == 2);
    CHECK(renderer.model().regions()[answer[0].partitions[0].region].path == "/lamp0.r");
    CHECK(renderer.model().regions()[answer[0].partitions[1].region].path == "/block.r");
    CHECK_THAT(answer[0].partitions[1].in, Catch::Matchers::WithinAbs(400, 1e-9));
    CHECK(answer[0].overlaps.empty());

    // A visible one is a bright ball: half of its colour, and half by how far it faces the eye.
    std::get<Combination>(scene.objects[3]).finish->light->visible = true;
    const Image bright = Renderer(scene, {}, test::on_reference()).render(view);
    for (std::size_t i = 0; i < 256; ++i) {
        const double y = (double(i % 16) - 7.5), z = (7.5 - double(i / 16)), inside = 9 - y * y - z * z;
        if (inside <= 0) continue;
        CHECK(bright.ids("region")[i] == 2);
        CHECK_THAT(channel_of(bright, "G")[i],
                   Catch::Matchers::WithinAbs((0.5 + 0.5 * std::sqrt(inside) / 3) / 1.2, 1e-6));
    }
}

TEST_CASE("field: a parallel view that zooms shows what the whole view shows on the same lines",
          "[field][promise:views]") {
    std::size_t compared = 0, different = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) different += differing(some_scene(seed), seed, compared);
    CHECK(compared == 24 * 256);
    CHECK(different == 0);
}

TEST_CASE("field: many parallel views that zoom", "[.long]") {
    std::size_t compared = 0, different = 0;
    for (std::uint64_t seed = 100; seed < 500; ++seed) different += differing(some_scene(seed), seed, compared);
    CHECK(compared == 400 * 256);
    CHECK(different == 0);
}

TEST_CASE("field: a perspective of nearly 0 is lit as none", "[field]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        INFO("seed " << seed);
        Renderer renderer(some_scene(seed), {}, test::on_reference());
        View parallel{24, 24, {}};
        parallel.camera.azimuth = 30 * double(seed);
        if (seed % 2 == 0) {
            parallel.camera.view_size = 12;
            parallel.camera.center = Vec3{1, 2, -1};
        }
        View narrow = parallel;
        narrow.camera.perspective = 1e-3;
        const Image a = renderer.render(parallel), b = renderer.render(narrow);
        CHECK(largest_difference(a, b) < 2e-3);
        std::size_t shown = 0, same = 0;
        for (std::size_t i = 0; i < a.channels[0].size(); ++i) {
            shown += a.ids("solid")[i] != 0;
            same += a.ids("solid")[i] != 0 && a.ids("solid")[i] == b.ids("solid")[i];
        }
        CHECK(shown > 0);
        CHECK(same + 2 >= shown);  // edges may move by a thousandth of a pixel
    }
}

TEST_CASE("views: the light by the eye goes on smoothly from far to near", "[promise:colors]") {
    const Scene scene = block_scene();
    Renderer renderer(scene, {}, test::on_reference());
    // One pixel, which shows the same point of the face throughout.
    std::optional<float> before;
    float least = 1, most = 0;
    for (int step = 0; step <= 600; ++step) {
        View view{1, 1, {}};
        const double far = 20 * std::pow(1.01, step);
        view.camera.eye = Vec3{100 + far, 0.1 * far, 0.2 * far};
        view.camera.look_at = Vec3{100, 0, 0};
        view.camera.perspective = 10;
        const Image image = renderer.render(view);
        const float red = channel_of(image, "R")[0];
        if (before) CHECK(std::abs(red - *before) < 0.02);
        before = red;
        least = std::min(least, red);
        most = std::max(most, red);
    }
    CHECK(most - least > 0.1);  // the light does move
}

TEST_CASE("views: an eye gives what azimuth and elevation give", "[promise:views]") {
    const Scene scene = some_scene(3);
    Renderer renderer(scene, {}, test::on_reference());
    constexpr std::array<double, 2> angles[] = {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}};
    const Vec3 backs[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::size_t i = 0; i < 6; ++i) {
        INFO(i);
        View by_angles{16, 16, {}}, by_eye{16, 16, {}};
        by_angles.camera.azimuth = angles[i][0];
        by_angles.camera.elevation = angles[i][1];
        by_angles.camera.center = by_eye.camera.look_at = Vec3{1, 2, 3};
        by_eye.camera.eye = Vec3{1, 2, 3} + 64.0 * backs[i];
        test::require_same(renderer.render(by_angles), renderer.render(by_eye));
        // The angle of view makes the size: 64 mm away, 2 x 64 x tan(half of it).
        by_angles.camera.perspective = by_eye.camera.perspective = 90;
        by_angles.camera.view_size = 128;
        const Image a = renderer.render(by_angles), b = renderer.render(by_eye);
        for (const char* name : {"region", "solid"}) CHECK(std::ranges::equal(a.ids(name), b.ids(name)));
    }
    // In between, the axes are those of the textbook: the picture's middle looks from the eye at the point, and right
    // is level.
    View view{33, 33, {}};
    view.camera.eye = Vec3{30, -40, 50};
    view.camera.look_at = Vec3{1, 2, 3};
    view.camera.perspective = 20;
    const Image image = renderer.render(view);
    const Vec3 to_eye = *view.camera.eye - *view.camera.look_at, back = (1 / size_of(to_eye)) * to_eye;
    const Vec3 level{-back.y, back.x, 0}, right = (1 / size_of(level)) * level, up = cross(back, right);
    const std::vector<float>& matrix = image.matrices.at("worldToCamera");
    for (std::size_t k = 0; k < 3; ++k) {
        const double expected[3] = {k == 0   ? right.x
                                    : k == 1 ? right.y
                                             : right.z,
                                    k == 0   ? up.x
                                    : k == 1 ? up.y
                                             : up.z,
                                    k == 0   ? back.x
                                    : k == 1 ? back.y
                                             : back.z};
        for (std::size_t row = 0; row < 3; ++row)
            CHECK_THAT(matrix[4 * row + k], Catch::Matchers::WithinAbs(expected[row], 1e-6));
    }
}

TEST_CASE("views: what is up turns the picture", "[promise:views]") {
    Renderer renderer(some_scene(5), {}, test::on_reference());
    View upright{16, 16, {}};
    upright.camera.azimuth = upright.camera.elevation = 0;
    upright.camera.view_size = 64;
    View turned = upright;
    turned.camera.up = Vec3{0, 3, 0};  // what was right is up now, what was up is left
    const Image a = renderer.render(upright), b = renderer.render(turned);
    std::size_t shown = 0;
    for (std::size_t row = 0; row < 16; ++row)
        for (std::size_t column = 0; column < 16; ++column) {
            const std::uint32_t region = b.ids("region")[row * 16 + column];
            CHECK(region == a.ids("region")[column * 16 + (15 - row)]);
            shown += region != 0;
        }
    CHECK(shown > 10);
}

TEST_CASE("views: what makes no sense is refused in words", "[promise:views]") {
    const Scene scene = block_scene();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    struct {
        std::function<void(Camera&)> change;
        const char* says;
    } const cases[] = {
        {[](Camera& c) { c.eye = Vec3{}; }, "the eye stands at the point that it looks at"},
        {[&](Camera& c) {
             c.eye = Vec3{nan, 0, 0};
         },
         "the place of the eye must be a finite number"},
        {[](Camera& c) {
             c.eye = Vec3{1e19, 0, 0};
         },
         "the place of the eye is 1e+19"},
        {[](Camera& c) { c.center = c.look_at = Vec3{}; }, "look_at cannot be combined with center"},
        {[](Camera& c) {
             c.perspective = 30, c.view_size = 5, c.eye = Vec3{500, 0, 0};
         },
         "view_size cannot be combined with eye"},
        {[](Camera& c) {
             c.eye = Vec3{0, 0, 500}, c.up = Vec3{0, 0, -2};
         },
         "the direction upward runs along the line of sight"},
        {[](Camera& c) {
             c.elevation = 90, c.up = Vec3{0, 0, 1};
         },
         "the direction upward runs along the line of sight"},
        {[](Camera& c) { c.up = Vec3{}; }, "the direction upward has no length"},
        {[&](Camera& c) {
             c.up = Vec3{0, nan, 0};
         },
         "the direction upward must be a finite number"},
        {[&](Camera& c) { c.view_size = nan; }, "the size of the view must be positive"},
        {[](Camera& c) { c.view_size = -1; }, "the size of the view must be positive"},
        {[](Camera& c) { c.view_size = 1e-16; }, "the size of the view is 1e-16"},
        {[](Camera& c) { c.view_size = 1e19; }, "the size of the view is 1e+19"},
    };
    for (const auto& [change, says] : cases) {
        Camera camera;
        change(camera);
        const std::string text = refusal(scene, camera);
        INFO(text);
        CHECK(text.find(says) != std::string::npos);
    }
    // The least and the largest that are allowed.
    for (const double size : {1e-15, 1e18}) {
        Camera camera{.view_size = size};
        CHECK(refusal(scene, camera).empty());
    }
}
