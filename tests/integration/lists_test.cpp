// Answers to lists as arrays: what is in them, their ranges, and the ways that they are computed.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/identical.hpp"
#include "catch.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/every_solid.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

/// Two balls in a row along x: from 0 to 2 and from 2 to 4, and a third that overlaps the second, from 3 to 5.
Scene balls() {
    Scene scene;
    for (const double x : {1, 3, 4}) {
        const std::string name = "ball" + std::to_string(int(x));
        scene.objects.push_back(test::ball(name, {x, 0, 0}, 1));
        Tree tree;
        tree.nodes.push_back(test::leg(name));
        scene.objects.push_back(test::region_of(name + ".r", std::move(tree)));
    }
    return scene;
}

std::vector<Ray> along_x() { return {{{0, 0, 0}, {1, 0, 0}}, {{0, 5, 0}, {1, 0, 0}}, {{3, 0, 0}, {2, 0, 0}}}; }

}  // namespace

TEST_CASE("the rows of a ray stand in order, and a cut end has the bound, no solid and no normal", "[promise:lists]") {
    Renderer renderer(balls(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    Partitions answer;
    renderer.partitions(along_x(), answer, all_fields, {.all = {0, 1.25}});
    REQUIRE(answer.ray_splits.size() == 4);
    CHECK((answer.ray_splits[1] == 1 && answer.ray_splits[2] == 1 && answer.ray_splits[3] == 3));
    CHECK((answer.region_ids[0] == 0 && answer.t_in[0] == 0 && answer.t_out[0] == 1.25));
    CHECK((answer.in_solids[0] == 0 && answer.out_solids[0] == -1));
    CHECK((answer.in_normals[0].x == -1 && answer.out_normals[0] == Vec3{}));
    CHECK((answer.region_ids[1] == 1 && answer.t_in[1] == 0 && answer.t_out[1] == 0.5));
    CHECK((answer.in_solids[1] == -1 && answer.out_normals[1].x == 1));
    CHECK((answer.region_ids[2] == 2 && answer.t_in[2] == 0.5 && answer.t_out[2] == 1));
    REQUIRE(answer.overlap_splits.size() == 4);
    CHECK((answer.overlap_splits[2] == 0 && answer.overlap_splits[3] == 1));
    CHECK((answer.overlap_t_in[0] == 0 && answer.overlap_t_out[0] == 0.5));
    CHECK(std::vector<std::int32_t>(answer.overlap_region_ids.begin(), answer.overlap_region_ids.end()) ==
          std::vector<std::int32_t>{1, 2});
}

TEST_CASE("a range of one point holds what begins or goes on there", "[promise:lists]") {
    Renderer renderer(balls(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    Partitions answer;
    const std::vector<std::pair<double, std::int32_t>> expected = {{-0.5, -1}, {0, 0}, {1, 0}, {2, 1},
                                                                   {3.5, 1},   {4, 2}, {5, -1}};
    const std::vector<Ray> ray = {along_x().front()};
    for (const auto& [t, region] : expected) {
        INFO("t " << t);
        renderer.partitions(ray, answer, {}, {.all = {t, t}});
        REQUIRE(answer.region_ids.size() == (region < 0 ? 0 : 1));
        if (region >= 0) CHECK((answer.region_ids[0] == region && answer.t_in[0] == t && answer.t_out[0] == t));
    }
}

TEST_CASE("only the arrays that are asked for are filled, and their memory is used again", "[promise:lists]") {
    Renderer renderer(balls(), {}, test::on_device());
    Partitions answer;
    renderer.partitions(along_x(), answer, all_fields);
    const double* const memory = answer.t_in.data();
    renderer.partitions(along_x(), answer);
    CHECK(answer.t_in.data() == memory);
    CHECK(answer.t_in.size() == answer.region_ids.size());
    CHECK((answer.in_solids.empty() && answer.out_normals.empty() && answer.overlap_splits.empty()));
    renderer.partitions({}, answer, all_fields);
    CHECK((answer.ray_splits.size() == 1 && answer.region_ids.empty() && answer.overlap_splits.size() == 1));
}

TEST_CASE("a list that cannot be answered is refused with the index of its first bad ray") {
    Renderer renderer(balls(), {}, test::on_device());
    Partitions answer;
    const auto refusal = [&](const std::vector<Ray>& rays, const RayRanges& ranges) {
        return test::failure(Status::usage, [&] { renderer.partitions(rays, answer, {}, ranges); });
    };
    std::vector<Ray> rays(100'000, along_x().front());
    rays[70'000].direction = rays[90'000].direction = {};
    CHECK(refusal(rays, {}).starts_with("ray 70000: needs a direction"));
    CHECK(refusal(along_x(), {.all = {2, 1}}).find("from 2 to 1") != std::string::npos);
    CHECK(refusal(along_x(), {.all = {std::nan(""), 1}}).find("t_near must not be above") != std::string::npos);
    const std::vector<RayRange> two = {{0, 1}, {0, 1}}, third_bad = {{0, 1}, {0, 1}, {1, 0}};
    CHECK(refusal(along_x(), {.each = two}).find("3 rays have 2 ranges") != std::string::npos);
    CHECK(refusal(along_x(), {.each = third_bad}).starts_with("ray 2: its range is from 1 to 0"));
}

TEST_CASE("ranges count lengths of any direction") {
    Renderer renderer(balls(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    Partitions answer;
    for (const double length : {1e-200, 1e-3, 1.0, 0x1p40, 1e200}) {
        INFO("length " << length);
        const std::vector<Ray> rays = {{{0, 0, 0}, {length, 0, 0}}};
        renderer.partitions(rays, answer, {}, {.all = {0.5 / length, 1 / length}});
        REQUIRE(answer.region_ids.size() == 1);
        CHECK((answer.t_in[0] == 0.5 / length && answer.t_out[0] == 1 / length));
    }
}

TEST_CASE("a first hit is the range's begin where that is inside, and infinity where there is none",
          "[promise:lists]") {
    Renderer renderer(balls(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    Hits hits;
    const RayRange ranges[] = {{0.5, 9}, {-9, 9}, {0, 0.25}};
    renderer.cast_rays(along_x(), hits, all_fields, {.each = ranges});
    CHECK((hits.t_hit[0] == 0.5 && hits.region_ids[0] == 0 && hits.solid_ids[0] == -1 && hits.normals[0] == Vec3{}));
    CHECK((hits.t_hit[1] == HUGE_VAL && hits.region_ids[1] == -1 && hits.solid_ids[1] == -1));
    CHECK((hits.t_hit[2] == 0 && hits.region_ids[2] == 1));
    renderer.cast_rays(along_x(), hits);
    CHECK((hits.t_hit[0] == 0 && hits.solid_ids.empty() && hits.normals.empty()));
    Array<std::uint8_t> occluded;
    renderer.occluded(along_x(), occluded, {.all = {1.75, 9}});
    CHECK((occluded.size() == 3 && occluded[0] == 1 && occluded[1] == 0 && occluded[2] == 0));
}

TEST_CASE("batches come in order, hold the list's rows, and end when the host has enough", "[promise:lists]") {
    Settings settings = GENERATE(test::on_device(), Settings{.reference = true});
    std::vector<double> told;
    const bool is_followed = GENERATE(false, true);
    if (is_followed)
        settings.progress = [&](double done) {
            told.push_back(done);
            return true;
        };
    Renderer renderer(balls(), {}, settings);
    const std::vector<Ray> rays = test::random_rays(renderer.model().bounds(), 1000);
    Partitions whole;
    renderer.partitions(rays, whole, all_fields);
    told.clear();
    std::uint64_t next = 0;
    const auto take = [&](const Partitions& batch, std::uint64_t first) {
        REQUIRE(first == next);
        REQUIRE(batch.ray_splits.size() == std::min<std::size_t>(rays.size() - first, 300) + 1);
        for (std::size_t i = 0; i + 1 < batch.ray_splits.size(); ++i) REQUIRE(same_rows(batch, i, whole, first + i));
        next += batch.ray_splits.size() - 1;
        return next < 600 || rays.size() == next;
    };
    renderer.partitions(rays, take, all_fields, {}, 300);
    CHECK(next == 600);
    CHECK(std::is_sorted(told.begin(), told.end()));
    CHECK_THROWS_AS(renderer.partitions(rays, take, {}, {}, 0), Error);
    const auto fails = [](const Partitions&, std::uint64_t) -> bool { throw std::runtime_error("no more room"); };
    CHECK_THROWS_AS(renderer.partitions(rays, fails), std::runtime_error);
}

TEST_CASE("a grid's rays are those of its list, whoever makes them", "[promise:lists]") {
    const every_solid::EverySolid model(test::sanitized ? 1 : 3);
    const Model compiled(model.scene);
    View view{.width = 37, .height = 21, .camera = {}};
    view.camera.perspective = GENERATE(0.0, 40.0);
    RayGrid slanted = compiled.grid_of(view);
    if (!slanted.is_pinhole)
        slanted.direction = {1e150 * slanted.direction.x, 1e150 * slanted.direction.y, 1e150 * slanted.direction.z};
    const RayGrid grids[] = {compiled.grid_of(view), slanted, rays_parallel(compiled.bounds(), Axis::y, 40, 9),
                             rays_pinhole(50, {0, 0, 0}, {30, 40, 50}, {0, 0, 1}, 24, 16)};
    for (const RayGrid& grid : grids) {
        const std::vector<Ray> list = grid.rays();
        REQUIRE(list.size() == grid.size());
        const Ray one = grid.ray(3, 2);
        const std::size_t number = 2 * static_cast<std::size_t>(grid.columns) + 3;
        CHECK((one.origin == list[number].origin && one.direction == list[number].direction));
        Renderer reference(compiled, {.reference = true}), direct(compiled, test::on_device());
        const test::ByOpenCl functions;
        Renderer by_functions(compiled, test::on_native_device());
        Partitions expected, found;
        reference.partitions(list, expected, all_fields);
        for (Renderer* const renderer : {&reference, &direct, &by_functions}) {
            renderer->partitions(grid, found, all_fields);
            test::require_same(found, expected);
            const std::vector<RayRange> ranges(list.size());
            renderer->partitions(grid, found, all_fields, {.each = ranges});
            test::require_same(found, expected);
        }
        compiled.partitions(grid, found, all_fields);
        test::require_same(found, expected);
        std::uint64_t rays = 0;
        direct.partitions(
            grid,
            [&](const Partitions& batch, std::uint64_t first) {
                for (std::size_t i = 0; i + 1 < batch.ray_splits.size(); ++i, ++rays)
                    REQUIRE(same_rows(batch, i, expected, first + i));
                return true;
            },
            all_fields, {}, 100);
        CHECK(rays == grid.size());
    }
    const std::vector<Ray> listed = compiled.grid_of(view).rays();
    const Ray ray = compiled.ray_of(view, 5, 20);
    CHECK((ray.origin == listed[20 * 37 + 5].origin && ray.direction == listed[20 * 37 + 5].direction));
    CHECK_THROWS_AS(compiled.ray_of(view, 37, 0), Error);
}

TEST_CASE("grids that have no rays, or rays that Limits excludes, are refused", "[promise:lists][promise:refusals]") {
    const Model model(balls());
    Partitions answer;
    const auto refuses = [&](RayGrid grid) { CHECK_THROWS_AS(model.partitions(grid, answer), Error); };
    const RayGrid good = rays_parallel(model.bounds(), Axis::x, 3, 2);
    model.partitions(good, answer);
    REQUIRE(answer.ray_splits.size() == 7);
    RayGrid grid = good;
    grid.columns = 0;
    refuses(grid);
    grid.columns = grid.rows = 40'000;
    refuses(grid);
    grid = good;
    grid.direction = {};
    refuses(grid);
    grid = good;
    grid.right.x = std::nan("");
    refuses(grid);
    grid = good;
    grid.is_pinhole = true;
    grid.direction = {0, 0, 1};
    grid.right = grid.up = {0, 0, 1};
    refuses(grid);
    CHECK_THROWS_AS(rays_parallel({{1, 0, 0}, {0, 1, 1}}, Axis::x, 3, 2), Error);
    CHECK_THROWS_AS(rays_pinhole(180, {}, {1, 0, 0}, {0, 0, 1}, 3, 2), Error);
    CHECK_THROWS_AS(rays_pinhole(50, {}, {}, {0, 0, 1}, 3, 2), Error);
    CHECK_THROWS_AS(rays_pinhole(50, {}, {0, 0, 1}, {0, 0, 1}, 3, 2), Error);
}

TEST_CASE("lists have the same bits through OpenCL's functions, of every solid and of deep rays", "[promise:lists]") {
    const auto compare = [](const Scene& scene, const std::vector<Ray>& list) {
        Renderer expected(scene, {}, {.reference = true});
        Renderer direct(scene, {}, test::on_native_device());
        const test::ByOpenCl functions;
        Renderer by_functions(scene, {}, test::on_native_device());
        test::require_same_lists(expected, {&direct, &by_functions}, list);
    };
    const every_solid::EverySolid model(test::sanitized ? 1 : 3);
    compare(model.scene, model.rays);
    compare(test::deep_parts(3, test::sanitized ? 200 : 400, 40), test::rays_along_grid());
}

TEST_CASE("the number of threads changes no bit of a list") {
    const Scene scene = test::deep_parts(5, 60, 20);
    Settings one = test::on_device(), three = one;
    one.threads = 1;
    three.threads = 3;
    Renderer expected(scene, {}, one), found(scene, {}, three);
    test::require_same_lists(expected, {&found},
                             test::random_rays(expected.model().bounds(), test::sanitized ? 2'000 : 20'000));
}
