// What a view is: where its rays begin and whither they go, and which channels its picture has.
#include <cmath>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "catch.hpp"
#include "thrown.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

Settings on_reference() { return {.reference = true, .threads = 1}; }

Scene scene_of(Shape shape) {
    Scene scene;
    scene.objects.push_back(Solid{"s", std::move(shape), {}});
    return scene;
}

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }
bool close(const Vec3& a, const Vec3& b) { return length(a - b) < 1e-12 * (1 + length(a)); }

View looking(double azimuth, double elevation, int width, int height) {
    View view{.width = width, .height = height};
    view.camera.azimuth = azimuth;
    view.camera.elevation = elevation;
    return view;
}

/// The height that a picture shows of what stands across the middle of the view.
double shown_height(const Renderer& renderer, View view) {
    const std::vector<Ray> rays = renderer.model().grid_of(view).rays();
    const auto width = static_cast<std::size_t>(view.width), height = static_cast<std::size_t>(view.height);
    return length(rays[0].origin - rays[width].origin) * static_cast<double>(height);
}

}  // namespace

TEST_CASE("rays of a view go through the centres of pixels, from the top left, seen as azimuth and elevation say",
          "[promise:views]") {
    const Vec3 middle{1, 2, 3};
    Renderer renderer(scene_of(box({-3, -2, -1}, {5, 6, 7})), {}, on_reference());
    struct {
        double azimuth, elevation;
        Vec3 back, right, up;
    } const cases[] = {
        {0, 0, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},     {90, 0, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
        {180, 0, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, {0, 90, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
        {0, -90, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
    };
    for (const auto& each : cases) {
        INFO(each.azimuth << ", " << each.elevation);
        View view = looking(each.azimuth, each.elevation, 4, 2);
        const double pixel = 8 * std::sqrt(3) / 2;  // the diagonal of the box is the height of the view
        const auto point = [&](std::size_t column, std::size_t row) {
            return middle + pixel * (static_cast<double>(column) - 1.5) * each.right +
                   pixel * (0.5 - static_cast<double>(row)) * each.up;
        };
        std::vector<Ray> rays = renderer.model().grid_of(view).rays();
        REQUIRE(rays.size() == 8);
        for (std::size_t i = 0; i < 8; ++i) {
            CHECK(close(rays[i].direction, -1.0 * each.back));
            const Vec3 before = rays[i].origin - point(i % 4, i / 4);
            CHECK(close(before, dot(before, each.back) * each.back));
            CHECK(dot(before, each.back) >= 4);  // in front of the box
        }
        // The angle of view is the vertical one, and the view is as high at the middle.
        view.camera.perspective = 60;
        rays = renderer.model().grid_of(view).rays();
        const Vec3 eye = middle + (pixel / std::tan(std::acos(-1.0) / 6)) * each.back;
        for (std::size_t i = 0; i < 8; ++i) {
            CHECK(close(rays[i].origin, eye));
            const Vec3 d = unit(point(i % 4, i / 4) - eye);
            CHECK(close(unit(rays[i].direction), d));
        }
    }
}

TEST_CASE("a view shows the model's box, its sides moved outward to whole millimetres, whatever tree it comes from",
          "[promise:views]") {
    const auto height = [](const Renderer& renderer) { return shown_height(renderer, looking(30, 20, 3, 2)); };
    const auto height_of = [&](Shape shape) {
        return height(Renderer(scene_of(std::move(shape)), {}, on_reference()));
    };
    CHECK(height_of(box({0, 0, 0}, {2, 3, 6})) == Approx(7));
    CHECK(height_of(box({0.25, 0.5, 0.75}, {1.5, 2.25, 5.125})) == Approx(7));
    CHECK(height_of(box({0, 0, 0}, {0.2, 0.3, 0.6})) == Approx(0.7));    // less than one: as it is
    CHECK(height_of(Half{{{0, 0, 1}, 5}}) == Approx(2 * std::sqrt(3)));  // nothing is bounded
    View wide = looking(0, 0, 640, 2);
    Renderer renderer(scene_of(box({0, 0, 0}, {2, 3, 6})), {}, on_reference());
    CHECK(shown_height(renderer, wide) == Approx(7));  // the height, however wide
    wide.camera.view_size = 5;
    CHECK(shown_height(renderer, wide) == Approx(5));

    Scene scene{.objects = {Solid{"a", box({0, 0, 0}, {8, 8, 8}), {}}, Solid{"b", box({-9, 1, 1}, {4, 20, 20}), {}}}};
    const auto add = [&](const char* name, Tree tree) {
        Combination region{.name = name, .region = true};
        region.tree = std::move(tree);
        scene.objects.push_back(region);
    };
    const Tree a = leaf("a"), b = leaf("b");
    const auto but = [](const Tree& tree) { return operate(Operator::not_, {tree}); };
    add("less", operate(Operator::difference, {a, b}));
    add("and not", operate(Operator::intersection, {a, but(b)}));
    add("not or", but(operate(Operator::union_, {but(a), b})));
    for (const char* name : {"less", "and not", "not or"})
        CHECK(height(Renderer(scene, {name}, on_reference())) == Approx(8 * std::sqrt(3)));
}

TEST_CASE("a picture has 1 to 32,768 pixels each way", "[promise:views]") {
    Renderer renderer(scene_of(ball({0, 0, 0}, 1)), {}, on_reference());
    CHECK(renderer.model().grid_of(looking(0, 0, 32'768, 1)).rays().size() == 32'768);
    const Image image = renderer.render(looking(0, 0, 1, 1));
    CHECK(image.ids("region")[0] == 1);
    for (const auto& [width, height] : {std::pair{0, 1}, {1, 0}, {-1, 1}, {32'769, 1}, {1, 32'769}}) {
        CAPTURE(width, height);
        CHECK(test::thrown_by([&] { renderer.render(looking(0, 0, width, height)); }).status == Status::usage);
    }
}

TEST_CASE("a picture has the groups of channels that are wanted, in their order", "[promise:pictures]") {
    Renderer renderer(scene_of(ball({0, 0, 0}, 1)), {}, on_reference());
    const std::pair<std::uint32_t, std::vector<std::string>> groups[] = {
        {channel::color, {"R", "G", "B", "A"}},
        {channel::distance, {"Z"}},
        {channel::normal, {"N.X", "N.Y", "N.Z"}},
        {channel::ids, {"region", "solid"}},
        {channel::counts, {"depth", "partitions", "overlap"}}};
    View view = looking(0, 0, 5, 5);
    const Image whole = renderer.render(view);
    for (std::uint32_t wanted = 1; wanted <= channel::all; ++wanted)
        for (const bool every : {false, true}) {
            INFO(wanted << ", every partition " << every);
            std::vector<std::string> names;
            for (const auto& [bit, its] : groups)
                if ((wanted & bit) && (every || bit != channel::counts))
                    names.insert(names.end(), its.begin(), its.end());
            view.channels = wanted;
            view.every_partition = every;
            if (names.empty()) continue;
            const Image image = renderer.render(view);
            REQUIRE(image.names == names);
            for (const std::string& name : names)
                CHECK((name == "region" || name == "solid"
                           ? std::ranges::equal(image.ids(name), whole.ids(name))
                           : std::ranges::equal(image.channel(name), whole.channel(name))));
        }
}
