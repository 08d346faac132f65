// A compiled scene that several renderers share, that one renderer takes for another, and that threads shoot at.
#include <csgrt/model.hpp>

#include <atomic>
#include <thread>

#include "catch.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/every_solid.hpp"
#include "integration/lists.hpp"
#include "base/identical.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

View small_view() { return {.width = 64, .height = 48, .camera = {}}; }

std::vector<Scene> scenes() {
    std::vector<Scene> all;
    for (const std::string& file : test::scene_files()) all.push_back(load_scene(file));
    return all;
}

std::atomic<int> programs{0};

/// OpenCL's functions of the native device, which count the programs that are made.
OpenCl counting() {
    OpenCl functions = native::functions();
    functions.CreateProgramWithSource = [](cl_context context, cl_uint count, const char** texts,
                                           const std::size_t* sizes, cl_int* code) {
        ++programs;
        return native::functions().CreateProgramWithSource(context, count, texts, sizes, code);
    };
    return functions;
}

}  // namespace

TEST_CASE("a renderer that takes model after model answers as one that is made for each", "[promise:models]") {
    const bool by_functions = GENERATE(false, true);
    const OpenCl functions = counting();
    const NativeTable table(by_functions ? &functions : &native::functions());
    std::vector<Model> models;
    for (const Scene& scene : scenes()) models.emplace_back(scene);
    REQUIRE(models.size() > 10);
    std::optional<Renderer> one;
    for (int round = 0; round < 2; ++round)
        for (const Model& model : models) {
            if (!one) one.emplace(model, test::on_native_device());
            one->set_model(model);
            Renderer fresh(model, test::on_native_device());
            for (const bool every_partition : {true, false}) {
                View view = small_view();
                view.every_partition = every_partition;
                test::require_same(one->render(view), fresh.render(view));
            }
            const std::vector<Ray> rays = test::random_rays(model.bounds(), 100);
            test::require_same(one->shoot(rays), fresh.shoot(rays));
            CHECK(one->model().regions().size() == model.regions().size());
            CHECK(one->statistics().tolerance == fresh.statistics().tolerance);
            CHECK(one->device_warnings().empty());
        }
}

TEST_CASE("a renderer compiles no programs for a model that those at hand can draw", "[promise:models]") {
    const OpenCl functions = counting();
    const NativeTable table(&functions);
    Renderer renderer(Model(test::deep_parts(2, 40, 10)), test::on_native_device());
    View view = small_view();
    renderer.render(view);
    view.every_partition = false;
    renderer.render(view);
    const int before = programs;
    renderer.set_model(Model(test::nested_balls(3, {Operator::difference}, test::Form::left)));
    renderer.render(view);
    view.every_partition = true;
    renderer.render(view);
    CHECK(programs == before);
}

TEST_CASE("several renderers share one model, also on the reference", "[promise:models]") {
    const Model model(test::deep_parts(2, 40, 10));
    Renderer device(model, test::on_device()), reference(model, {.reference = true});
    test::require_same(device.render(small_view()), reference.render(small_view()));
    test::require_same_lists(reference, {&device}, test::random_rays(model.bounds(), 500));
    reference.set_model(Model(test::nested_balls(3, {Operator::difference}, test::Form::left)));
    device.set_model(reference.model());
    test::require_same(device.render(small_view()), reference.render(small_view()));
}

TEST_CASE("a model that does not fit leaves the renderer to the others", "[promise:models]") {
    const Model small(test::nested_balls(3, {Operator::difference}, test::Form::left)),
        large(test::deep_parts(2, 20'000, 5'000));
    Settings settings = test::on_native_device();
    settings.max_memory = 1'000'000;
    Renderer renderer(small, settings);
    const Image before = renderer.render(small_view());
    renderer.set_model(large);
    CHECK(test::thrown_by([&] { renderer.render(small_view()); }).status == Status::out_of_memory);
    renderer.set_model(small);
    test::require_same(renderer.render(small_view()), before);
}

TEST_CASE("a pick is what the picture shows at the pixel, and what its ray meets", "[promise:lists]") {
    const every_solid::EverySolid every(test::sanitized ? 1 : 2);
    std::vector<Scene> all = scenes();
    all.push_back(every.scene);
    for (const Scene& scene : all) {
        const Model model(scene);
        Renderer reference(model, {.reference = true});
        View view{.width = test::sanitized ? 6 : 24, .height = test::sanitized ? 4 : 16, .camera = scene.camera};
        view.camera.perspective = GENERATE(0.0, 40.0);
        const Image image = reference.render(view);
        const auto at = [&](const char* channel, std::size_t i) { return image.channel(channel)[i]; };
        const std::vector<RayPartitions> along = reference.shoot(reference.model().grid_of(view).rays());
        for (int row = 0; row < view.height; ++row)
            for (int column = 0; column < view.width; ++column) {
                INFO("column " << column << " of row " << row);
                const auto i = static_cast<std::size_t>(row * view.width + column);
                const Pick pick = model.pick(view, column, row);
                REQUIRE(identical(pick.along, along[i]));
                REQUIRE(static_cast<std::uint32_t>(pick.region + 1) == image.ids("region")[i]);
                REQUIRE(static_cast<std::uint32_t>(pick.solid + 1) == image.ids("solid")[i]);
                if (pick.region < 0) continue;
                REQUIRE(static_cast<float>(pick.t) == at("Z", i));
                REQUIRE(static_cast<float>(pick.normal.x) == at("N.X", i));
                REQUIRE(static_cast<float>(pick.normal.y) == at("N.Y", i));
                REQUIRE(static_cast<float>(pick.normal.z) == at("N.Z", i));
                REQUIRE(pick.point.x == pick.ray.origin.x + pick.t * pick.ray.direction.x);
            }
    }
    CHECK_THROWS_AS(Model(every.scene).pick(small_view(), 64, 0), Error);
}

TEST_CASE("a model answers rays on the threads that ask, with a renderer's bits", "[promise:models][promise:lists]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto check = [](const Model& model, const std::vector<Ray>& rays) {
        Renderer renderer(model, {.reference = true});
        Partitions expected;
        const std::vector<RayRange> ranges = test::random_ranges(rays.size());
        renderer.partitions(rays, expected, all_fields, {.each = ranges});
        std::atomic<int> wrong{0};
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 3; ++t)
            threads.emplace_back([&, t] {
                Partitions one, all;
                for (std::size_t i = t; i < rays.size(); i += 2) {  // two threads shoot each ray
                    model.partitions(rays[i], one, all_fields, {.all = ranges[i]});
                    if (!same_rows(one, 0, expected, i)) ++wrong;
                }
                model.partitions(rays, all, all_fields, {.each = ranges});
                for (std::size_t i = 0; i < rays.size(); ++i)
                    if (!same_rows(all, i, expected, i)) ++wrong;
            });
        for (std::thread& thread : threads) thread.join();
        CHECK(wrong == 0);
    };
    const every_solid::EverySolid every(test::sanitized ? 1 : 2);
    check(Model(every.scene), every.rays);
    check(Model(test::deep_parts(3, test::sanitized ? 200 : 400, 40)), test::rays_along_grid());
    Partitions answer;
    const Model model(test::nested_balls(3, {Operator::difference}, test::Form::left));
    const std::vector<Ray> bad = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
    CHECK_THROWS_WITH(model.partitions(bad, answer), Catch::Matchers::StartsWith("ray 1: needs a direction"));
    model.partitions(bad[0], answer, {}, {.all = {-infinity, infinity}});
    CHECK(answer.region_ids.size() == 2);
}
