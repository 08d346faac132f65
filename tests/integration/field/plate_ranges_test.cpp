// Plates reach before and behind the triangles that they are made of. A range that begins or ends there cuts a plate's
// interval as that of any solid: what is right is the whole line, cut by hand.
#include <string>

#include "catch.hpp"
#include "formats/json/parse_text.hpp"
#include "integration/same_answers.hpp"
#include "integration/stress/check.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Triangles as thick as they are wide, before, behind or around their planes, or along the ray; and a ball among them.
Scene thick_plates(Random& random) {
    Builder to("plates", random.next(), 1);
    for (int number = 0; number < 4; ++number) {
        Bot bot{.mode = number % 2 ? Bot::Mode::plate_nocos : Bot::Mode::plate};
        for (std::uint32_t i = 0; i < 6; ++i) bot.vertices.push_back(10.0 * random.in_cube());
        bot.faces = {{0, 1, 2}, {3, 4, 5}};
        bot.thickness = {random.between(0.1, 20), random.between(0.1, 20)};
        bot.append = {random.coin(), random.coin()};
        to.region(leaf(to.solid(bot), random.coin() ? identity : rotation(random)));
    }
    to.region(leaf(to.solid(ball({}, 4))));
    return to.take().scene;
}

void compare_ranges(int scenes, int rays) {
    Random random(2026);
    for (int i = 0; i < scenes; ++i) {
        INFO("scene " << i);
        const Scene scene = thick_plates(random);
        Renderer reference(scene, {}, test::on_reference()), device(scene, {}, test::on_native_device());
        test::require_same_lists(reference, {&device}, test::random_rays(reference.model().bounds(), rays));
    }
}

/// One plate, from its triangle in a plane of coordinates to 20 behind.
Scene one_plate(const char* corners) {
    return scene_of(R"({"csgrt": 1, "solids": {"p": {"type": "bot", "mode": "plate", "thickness": 20, "append": 1,
        "vertices": )" +
                    std::string(corners) + R"(, "faces": [[0, 1, 2]]}}})");
}

}  // namespace

TEST_CASE("ranges that begin or end in the thickness of plates are the whole line, cut") { compare_ranges(10, 250); }

TEST_CASE("100,000 ranges in the thickness of plates are the whole line, cut", "[.long]") { compare_ranges(200, 500); }

TEST_CASE("a plate whose triangle lies behind the ray's start is there") {
    const Settings settings = GENERATE(test::on_device(), Settings{.reference = true});
    Renderer flat(one_plate("[[0, 0, 0], [10, 0, 0], [0, 10, 0]]"), {}, settings);
    const std::vector<Ray> down = {{{2, 2, -5}, {0, 0, -1}}};
    Partitions rows;
    flat.partitions(down, rows, {}, {.all = {0, infinity}});
    REQUIRE(rows.region_ids.size() == 1);
    CHECK((rows.t_in[0] == 0 && rows.t_out[0] == 15));
    Hits hits;
    flat.cast_rays(down, hits, {}, {.all = {0, infinity}});
    CHECK((hits.region_ids[0] == 0 && hits.t_hit[0] == 0));
    View view{.width = 9, .height = 9, .camera = {}};
    view.camera.eye = {2, 2, -5};
    view.camera.center = {2, 2, -30};
    view.camera.perspective = 20;
    for (view.every_partition = false;; view.every_partition = true) {
        const Image image = flat.render(view);
        const std::span<const std::uint32_t> regions = image.ids("region");
        CHECK(std::count(regions.begin(), regions.end(), 1u) == 81);
        if (view.every_partition) break;
    }

    const Model upright(one_plate("[[0, 0, 0], [0, 10, 0], [0, 0, 10]]"), {}, settings);
    Array<std::int32_t> at;
    const std::vector<Vec3> points = {{5, 2, 2}, {-0.5, 2, 2}, {20.5, 2, 2}};
    upright.region_at(points, at);
    CHECK((at[0] == 0 && at[1] == -1 && at[2] == -1));
}
