// The screen of a picture: no ray outside of it meets anything, by the reference, which shoots them all; and it spares
// most of the rest.
#include "compile/screen_bounds.hpp"

#include <random>

#include "stress/parts.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "compile/regions/claimed_by.hpp"
#include "reference/reference.hpp"
#include "sanitized.hpp"
#include "stress/rewrite.hpp"

using namespace csgrt;

namespace {

/// Pixels outside of the screen that a segment is seen at, or of first hits a region, and how much of the picture the
/// screen is.
struct Outcome {
    std::size_t missed = 0;
    double part = 0;
};

Outcome look(const CompiledScene& compiled, const ReferenceKernels& kernels, const View& view) {
    const PreparedFrame prepared = prepare_frame(compiled, view);
    const kernel::ScreenBounds& w = prepared.frame.screen;
    CHECK(w.left % TILE == 0);
    CHECK(w.top % TILE == 0);
    CHECK(w.right <= prepared.frame.width);
    CHECK(w.bottom <= prepared.frame.height);
    ReferenceCounts counts;
    const std::vector<kernel::Pixel> pixels = Reference(compiled, kernels).render(prepared, nullptr, counts);
    Outcome outcome;
    for (std::uint32_t y = 0; y < prepared.frame.height; ++y)
        for (std::uint32_t x = 0; x < prepared.frame.width; ++x) {
            const bool is_within = x >= w.left && x < w.right && y >= w.top && y < w.bottom;
            const kernel::Pixel& pixel = pixels[std::size_t{y} * prepared.frame.width + x];
            outcome.missed += !is_within && (view.every_partition ? pixel.depth > 0 : pixel.region > 0);
        }
    outcome.part =
        double(w.right - w.left) * (w.bottom - w.top) / (double(prepared.frame.width) * prepared.frame.height);
    return outcome;
}

Scene moved_by(const Scene& scene, double away) {
    return stress::moved(scene, scene.top, test::moved(away, -away, away));
}

View random_view(std::mt19937& random, const Vec3& center, double size) {
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    View view{.width = 96, .height = 71};
    view.camera.azimuth = between(0, 360);
    view.camera.elevation = between(-90, 90);
    if (random() % 2) view.camera.perspective = random() % 4 ? between(5, 120) : 0.1;
    view.camera.view_size = size * std::exp(random() % 4 ? between(-2, 2) : between(-7, -2));
    const auto beside = [&](double at) { return at + between(-0.7, 0.7) * size; };
    view.camera.center = Vec3{beside(center.x), beside(center.y), beside(center.z)};
    return view;
}

}  // namespace

TEST_CASE("no ray outside of the screen meets anything") {
    const Settings settings =
        GENERATE(Settings{}, Settings{.precision = Precision::single}, with_methods({.single_world = true}));
    const double away = GENERATE(0.0, 3e6);  // millimetres
    const Scene scene = moved_by(stress::scene_of_parts(30), away);
    const CompiledScene compiled = compile(scene, {});
    const double size = 2 * compiled.radius;
    const auto kernels = make_kernels(compiled, settings);
    std::mt19937 random(7);
    std::size_t missed = 0, small = 0;
    constexpr int views = test::sanitized ? 2 : 24;
    for (int i = 0; i < views; ++i) {
        const Outcome outcome = look(compiled, *kernels, random_view(random, compiled.center, size));
        missed += outcome.missed;
        small += outcome.part < 0.5;
    }
    CHECK(missed == 0);
    if (away == 0 && !test::sanitized) CHECK(small > views / 8);
}

TEST_CASE("no ray outside of the screen of first hits meets a region that claims") {
    const Scene scene = stress::scene_of_parts(30);
    CompiledScene all = compile(scene);
    const auto kernels = make_kernels(all, {});
    std::mt19937 random(8);
    std::size_t missed = 0, small = 0;
    constexpr int views = test::sanitized ? 3 : 24;
    for (int i = 0; i < views; ++i) {
        for (std::size_t region = 0; region < all.region_info.size(); ++region)
            all.set_state(region, random() % 10 ? State::hidden : State::shown);
        View view = random_view(random, all.center, 2 * all.radius);
        view.every_partition = false;
        const Outcome outcome = look(claimed_by(all, State::shown), *kernels, view);
        missed += outcome.missed;
        small += outcome.part < look(all, *kernels, view).part;
    }
    CHECK(missed == 0);
    CHECK(small > views / 3);
}

TEST_CASE(
    "the screen is all of the picture if something is unbounded or around the eye, and none of it if there is "
    "nothing") {
    View view{.width = 50, .height = 30};
    const auto screen_bounds = [&](const Scene& scene) {
        const CompiledScene compiled = compile(scene, {});
        const PreparedFrame prepared = prepare_frame(compiled, view);
        const kernel::ScreenBounds w = prepared.frame.screen;
        CHECK(prepared.rays == (w.right - w.left + 7) / 8 * ((w.bottom - w.top + 7) / 8) * 64);
        return std::vector<std::uint32_t>{w.left, w.top, w.right, w.bottom};
    };
    const std::vector<std::uint32_t> all{0, 0, 50, 30}, none{0, 0, 0, 0};
    Scene scene;
    scene.objects.push_back(Solid{"ball", Ell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}});
    scene.objects.push_back(Solid{"ground", Half{{{0, 0, 1}, -3}}, {}});
    scene.top = {"ball"};
    view.camera.view_size = 30.0;
    CHECK(screen_bounds(scene) ==
          std::vector<std::uint32_t>{16, 8, 32, 24});  // 2 pixels across, in the middle, and a margin of 2
    view.camera.center = Vec3{100, 0, 0};
    view.camera.azimuth = view.camera.elevation = 0;
    CHECK(screen_bounds(scene) == std::vector<std::uint32_t>{16, 8, 32, 24});  // behind the eye
    view.camera.center = Vec3{0, 100, 0};
    CHECK(screen_bounds(scene) == none);
    view.camera.center.reset();
    view.camera.perspective = 60;
    CHECK(screen_bounds(scene) == std::vector<std::uint32_t>{16, 8, 32, 24});
    view.camera.view_size = 1.0;
    CHECK(screen_bounds(scene) == all);
    view.camera.view_size = 30.0;
    scene.top = {"ball", "ground"};
    CHECK(screen_bounds(scene) == all);
}
