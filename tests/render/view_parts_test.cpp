// Views beyond the whole picture: a part of it, coarse first, several rays a pixel, bytes for a display, cut by planes.
#include <csgrt/renderer.hpp>

#include <cmath>
#include <random>

#include "catch.hpp"
#include "integration/every_solid.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "scene/vector.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

std::vector<Scene> scenes() {
    std::vector<Scene> all{every_solid::EverySolid(1).scene};
    for (const std::string& file : test::scene_files())
        if (!test::sanitized || all.size() < 2) all.push_back(load_scene(file));
    return all;
}

View view_of(const Scene& scene, bool every_partition) {
    View view{.width = 45, .height = 35, .camera = scene.camera, .every_partition = every_partition};
    view.channels |= channel::display;
    return view;
}

/// Calls work(renderer, view) for both modes on the native device, on the test's device and on the reference.
template <class Work>
void on_all(const Scene& scene, const Work& work) {
    const Model model(scene);
    Renderer native(model, test::on_native_device()), device(model, test::on_device()),
        reference(model, {.reference = true});
    for (const bool every_partition : {true, false})
        for (Renderer* renderer : {&native, &device, &reference}) work(*renderer, view_of(scene, every_partition));
}

bool same_at(const Image& a, std::size_t channel, std::size_t i, const Image& b, std::size_t k) {
    return a.channels.ids(channel)[i] == b.channels.ids(channel)[k];
}

/// Up to six random planes through the model's box, so that some of it is left.
std::vector<Plane> random_planes(const Box& box, std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const Vec3 middle = 0.5 * (box.low + box.high);
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 normal = unit({any(random), any(random), any(random)});
        const double reach = std::abs(normal.x) * (box.high.x - box.low.x) +
                             std::abs(normal.y) * (box.high.y - box.low.y) +
                             std::abs(normal.z) * (box.high.z - box.low.z);
        planes.push_back({normal, dot(normal, middle) + (0.1 + 0.2 * std::abs(any(random))) * reach});
    }
    return planes;
}

}  // namespace

TEST_CASE("a part of a picture has the whole picture's pixels, to the last bit", "[promise:views]") {
    for (const Scene& scene : scenes())
        on_all(scene, [](Renderer& renderer, View view) {
            const Image whole = renderer.render(view);
            view.part = PixelRectangle{13, 6, 19, 27};
            const Image part = renderer.render(view);
            REQUIRE(part.width == 19);
            REQUIRE(part.height == 27);
            REQUIRE(part.names == whole.names);
            for (std::size_t c = 0; c < part.channels.size(); ++c)
                for (std::size_t y = 0; y < 27; ++y)
                    for (std::size_t x = 0; x < 19; ++x)
                        REQUIRE(same_at(part, c, y * 19 + x, whole, (y + 6) * 45 + x + 13));
            const Pick inside = renderer.model().pick(view, 3, 4);
            REQUIRE(static_cast<std::uint32_t>(inside.region + 1) == part.ids("region")[4 * 19 + 3]);
        });
    Renderer renderer(scenes().back());
    for (const PixelRectangle& wrong : {PixelRectangle{-1, 0, 2, 2}, {0, 0, 0, 1}, {40, 0, 6, 1}, {0, 1, 1, 35}})
        CHECK_THROWS_WITH(renderer.render({.width = 45, .height = 35, .part = wrong}),
                          "the part of a picture must lie in it");
}

TEST_CASE("a picture that is drawn coarsely first is the same in the end", "[promise:views]") {
    for (const Scene& scene : scenes())
        on_all(scene, [](Renderer& renderer, const View& view) {
            const Image whole = renderer.render(view);
            Framebuffer framebuffer;
            std::vector<int> sizes;
            const auto is_coarse = [&](int size) {
                sizes.push_back(size);
                const Image& coarse = framebuffer.image();
                const auto step = static_cast<std::size_t>(size);
                for (std::size_t c = 0; c < whole.channels.size(); ++c)
                    for (std::size_t y = 0; y < 35; ++y)
                        for (std::size_t x = 0; x < 45; ++x)
                            REQUIRE(same_at(coarse, c, y * 45 + x, whole, y / step * step * 45 + x / step * step));
                return true;
            };
            for (int time = 0; time < 2; ++time) {
                renderer.render(view, framebuffer, is_coarse);
                test::require_same(framebuffer.image(), whole);
            }
            CHECK(sizes == std::vector<int>{8, 4, 2, 8, 4, 2});
            renderer.render(view, framebuffer, [](int size) { return size > 4; });
            CHECK_FALSE(framebuffer.image().channels == whole.channels);
            renderer.render(view, framebuffer);
            test::require_same(framebuffer.image(), whole);
        });
}

TEST_CASE("bytes for a display are those that display_pixels makes", "[promise:pictures]") {
    for (const Scene& scene : scenes())
        for (const bool display_shading : {false, true}) {
            Settings settings = test::on_native_device();
            settings.display_shading = display_shading;
            Renderer native(scene, {}, settings);
            settings.reference = true;
            settings.device = "";
            Renderer reference(scene, {}, settings);
            for (Renderer* renderer : {&native, &reference})
                for (const bool every_partition : {true, false})
                    for (const int samples : {1, 3}) {
                        View view = view_of(scene, every_partition);
                        view.transparent = every_partition;
                        view.samples = samples;
                        const Image image = renderer->render(view);
                        const std::vector<unsigned char> expected = display_pixels(image);
                        const std::span<const std::uint32_t> words = image.ids("RGBA8");
                        for (std::size_t i = 0; i < words.size(); ++i)
                            for (std::size_t c = 0; c < 4; ++c)
                                REQUIRE((words[i] >> 8 * c & 255u) == expected[4 * i + c]);
                        view.channels = channel::display;
                        const Image alone = renderer->render(view);
                        REQUIRE(std::ranges::equal(alone.ids("RGBA8"), words));
                    }
        }
}

TEST_CASE("several rays a pixel: the mean of their colours, and all else of the middle") {
    // A box that covers the left 20.3 columns of 40: the alpha of the column in which it ends is what is covered.
    const Scene scene = parse_scene(R"({"csgrt": 1, "solids": {"a": {"type": "box", "low": [0, -20, -20],
        "high": [1, 0.3, 20]}}, "combinations": {"a.r": {"region": true, "tree": "a"}}})",
                                    "box.json");
    View view{.width = 40,
              .height = 40,
              .camera = {.azimuth = 0, .elevation = 0, .center = Vec3{0, 0, 0}, .view_size = 40.0}};
    view.transparent = true;
    const auto alpha_of = [&](Renderer& renderer, int samples) {
        view.samples = samples;
        const Image image = renderer.render(view);
        for (std::size_t x = 0; x < 40; ++x) {
            if (x < 20) CHECK(image.channel("A")[20 * 40 + x] == 1);
            if (x > 20) CHECK(image.channel("A")[20 * 40 + x] == 0);
        }
        return image.channel("A")[20 * 40 + 20];
    };
    Renderer native(scene, {}, test::on_native_device()), reference(scene, {}, {.reference = true});
    CHECK(alpha_of(native, 1) == 0);
    for (const int samples : {16, 64}) {
        CHECK(std::abs(alpha_of(native, samples) - 0.3f) < 1.0f / static_cast<float>(samples));
        CHECK(alpha_of(reference, samples) == alpha_of(native, samples));
    }
    view.samples = 1;
    const Image one = native.render(view);
    view.samples = 5;
    Image several = native.render(view);
    for (const char* name : {"region", "solid"}) CHECK(std::ranges::equal(one.ids(name), several.ids(name)));
    CHECK(std::ranges::equal(one.channel("Z"), several.channel("Z")));
    Framebuffer framebuffer;  // what samples show beside the middle's tiles is gone in the next frame
    native.render(view, framebuffer);
    view.samples = 1;
    native.render(view, framebuffer);
    test::require_same(framebuffer.image(), one);
    for (const int wrong : {0, 257})
        CHECK_THROWS_WITH(native.render({.samples = wrong}), "a pixel has 1 to 256 samples");
}

TEST_CASE("planes cut pictures open: a pixel shows the first partition of its ray that is before them all",
          "[promise:views]") {
    std::mt19937 random(6);
    std::size_t compared = 0, skipped = 0;
    for (const Scene& scene : scenes()) {
        const Model model(scene);
        for (std::size_t count = 1; count <= 6; count += test::sanitized ? 5 : 1) {
            const std::vector<Plane> planes = random_planes(model.bounds(), count, random);
            std::optional<Image> first[2];
            on_all(scene, [&](Renderer& renderer, View view) {
                view.clip = planes;
                view.camera.perspective = count % 2 == 0 ? 40 : 0;
                const Image image = renderer.render(view);
                std::optional<Image>& same = first[view.every_partition];
                if (same) return test::require_same(image, *same);
                same = image;
                const std::vector<Ray> rays = renderer.model().grid_of(view).rays();
                Partitions along;
                renderer.partitions(rays, along, {.solids = true, .normals = true});
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    double from = 0, to = INFINITY;
                    Vec3 normal{};
                    for (const Plane& plane : planes) {
                        const double speed = dot(plane.normal, rays[i].direction),
                                     left = plane.distance - dot(plane.normal, rays[i].origin);
                        if (speed > 0) to = std::min(to, left / speed);
                        if (speed < 0 && left / speed > from) {
                            from = left / speed;
                            normal = unit(plane.normal);
                        }
                    }
                    const double slack = 1e-9 * (1 + std::abs(from));
                    std::int32_t region = -1;
                    double t = INFINITY;
                    bool is_close = false, is_cut = false;
                    for (auto row = static_cast<std::size_t>(along.ray_splits[i]);
                         row < static_cast<std::size_t>(along.ray_splits[i + 1]) && region < 0; ++row) {
                        is_close = is_close || std::abs(along.t_out[row] - from) < slack ||
                                   std::abs(along.t_in[row] - to) < slack || std::abs(along.t_in[row] - from) < slack;
                        const std::optional<Emission>& light =
                            model.regions()[static_cast<std::size_t>(along.region_ids[row])].finish.light;
                        if (light && !light->visible) continue;
                        // A plate is there where its triangle is: other times the partition goes on before it.
                        const std::string& type = model.solids()[static_cast<std::size_t>(along.in_solids[row])].type;
                        is_close = is_close || (type == "bot" && along.t_in[row] < from);
                        if (!(along.t_out[row] > from) || !(along.t_in[row] < to) || !(from < to)) continue;
                        region = along.region_ids[row];
                        is_cut = along.t_in[row] < from;
                        t = std::max(along.t_in[row], from);
                    }
                    skipped += is_close || std::abs(from - to) < slack;
                    if (is_close || std::abs(from - to) < slack) continue;
                    ++compared;
                    INFO("pixel " << i << ", " << count << " planes, " << scene.title << ", every partition "
                                  << view.every_partition << ", from " << from << " to " << to << ", t " << t);
                    REQUIRE(image.ids("region")[i] == static_cast<std::uint32_t>(region + 1));
                    if (region < 0) continue;
                    REQUIRE(std::abs(image.channel("Z")[i] - t) <= 1e-6 * t);
                    REQUIRE((image.ids("solid")[i] == 0) == (is_cut && from > 0));
                    if (!is_cut || from == 0) continue;
                    REQUIRE(std::abs(image.channel("N.X")[i] - normal.x) < 1e-6);
                    REQUIRE(std::abs(image.channel("N.Y")[i] - normal.y) < 1e-6);
                    REQUIRE(std::abs(image.channel("N.Z")[i] - normal.z) < 1e-6);
                    const Pick pick = model.pick(view, static_cast<int>(i % 45), static_cast<int>(i / 45));
                    REQUIRE(pick.region == region);
                    REQUIRE(pick.solid == -1);
                    REQUIRE(static_cast<float>(pick.t) == image.channel("Z")[i]);
                    REQUIRE(static_cast<float>(pick.normal.x) == image.channel("N.X")[i]);
                }
            });
        }
    }
    CHECK(compared > 50 * skipped);
    Renderer renderer(scenes().back());
    const Plane plane = random_planes(renderer.model().bounds(), 1, random).front();
    const Image cut = renderer.render({.width = 45, .height = 45, .clip = {plane}});
    test::require_same(renderer.render({.width = 45, .height = 45, .clip = {{4.0 * plane.normal, plane.distance}}}),
                       cut);  // the distance is from the origin, whatever the normal's length
    CHECK_THROWS_WITH(renderer.render({.clip = std::vector<Plane>(7, Plane{{1, 0, 0}, 0})}),
                      "a view has at most 6 planes");
    CHECK_THROWS_WITH(renderer.render({.clip = {Plane{}}}), "the normal of a plane of the view has no length");
}
