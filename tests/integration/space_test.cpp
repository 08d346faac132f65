// Points and slices: which region holds a place, against the oracle's membership.
#include <cmath>
#include <mutex>
#include <random>
#include <tuple>

#include "base/parallel.hpp"
#include "catch.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "oracle/scene_judge.hpp"
#include "scene/vector.hpp"
#include "thrown.hpp"
#include "stress/build.hpp"

using namespace csgrt;

namespace {

/// Two boxes that touch at x = 1, and a third that overlaps the second.
Scene boxes() {
    Scene scene;
    for (const auto& [name, low, high] : {std::tuple{"a", 0.0, 1.0}, {"b", 1.0, 3.0}, {"c", 2.0, 4.0}}) {
        scene.objects.push_back(Solid{name, stress::box({low, -1, -1}, {high, 1, 1}), {}});
        Tree tree;
        tree.nodes.push_back(test::leg(name));
        scene.objects.push_back(test::region_of(std::string(name) + ".r", std::move(tree)));
    }
    return scene;
}

std::vector<Vec3> random_points(const Box& box, std::size_t count) {
    std::mt19937_64 random(5);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    std::vector<Vec3> points(count);
    for (Vec3& p : points)
        p = {between(box.low.x, box.high.x), between(box.low.y, box.high.y), between(box.low.z, box.high.z)};
    return points;
}

}  // namespace

TEST_CASE("a point belongs to the region that begins or goes on there along x", "[promise:lists]") {
    Renderer renderer(boxes(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    const std::vector<Vec3> points = {{-1, 0, 0}, {0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {2.5, 0, 0}, {4, 0, 0}, {9, 9, 9}};
    Array<std::int32_t> found;
    renderer.region_at(points, found);
    CHECK(std::vector<std::int32_t>(found.begin(), found.end()) == std::vector<std::int32_t>{-1, 0, 0, 1, 1, -1, -1});
    const Vec3 wrong =
        GENERATE(Vec3{0, HUGE_VAL, 0}, Vec3{NAN, 0, 0}, Vec3{0, NAN, 0}, Vec3{0, 0, NAN}, Vec3{0, 0, 2e18});
    CHECK(test::thrown_by([&] {
              renderer.region_at(std::vector<Vec3>{{0, 0, 0}, wrong}, found);
          }).text.starts_with("point 1: needs three finite numbers"));
}

TEST_CASE("a slice shows regions, overlaps and what is empty, row 0 on top", "[promise:lists]") {
    Renderer renderer(boxes(), {}, GENERATE(test::on_device(), Settings{.reference = true}));
    const Slice slice = slice_of(renderer.model().bounds(), {0, 0, 2}, 0.25, 8, 6);
    CHECK((slice.center == Vec3{2, 0, 0.25} && slice.right == Vec3{0.5, 0, 0} && slice.up == Vec3{0, 0.5, 0}));
    Array<std::int32_t> found;
    renderer.slice(slice, found);
    REQUIRE(found.size() == 48);
    const std::vector<std::int32_t> inside = {0, 0, 1, 1, -2, -2, 2, 2}, outside(8, -1);
    for (std::size_t row = 0; row < 6; ++row)
        CHECK(std::vector<std::int32_t>(found.begin() + 8 * row, found.begin() + 8 * row + 8) ==
              (row == 0 || row == 5 ? outside : inside));
    CHECK(slice_of(renderer.model().bounds(), {1, 0, 0}, 0, 2, 2).right.y > 0);
    CHECK(slice_of(renderer.model().bounds(), {0, 1, 0}, 0, 2, 2).right.x < 0);
    CHECK(slice_of(renderer.model().bounds(), {0, -1, 0}, 0, 2, 2).up.z > 0);
    CHECK_THROWS_AS(slice_of(renderer.model().bounds(), {}, 0, 2, 2), Error);
    CHECK_THROWS_AS(slice_of(renderer.model().bounds(), {0, 0, 1}, HUGE_VAL, 2, 2), Error);
    CHECK_THROWS_AS(renderer.slice(Slice{}, found), Error);
}

/// Judges places by all threads, and returns what is wrong of the first wrong one.
class Judged {
public:
    Judged(const oracle::SceneJudge& judge, bool overlaps) : judge_(judge), overlaps_(overlaps) {}

    template <class PointOf>
    std::string operator()(std::size_t count, const Array<std::int32_t>& found, const PointOf& point_of) {
        std::mutex mutex;
        std::string wrong;
        for_chunks(count, 64, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            std::size_t own = 0;
            for (std::size_t i = first; i < last; ++i) {
                const std::string what = judge_.judge_point(point_of(i), found[i], overlaps_, own);
                const std::lock_guard lock(mutex);
                if (!what.empty()) wrong = "place " + std::to_string(i) + ": " + what;
            }
            const std::lock_guard lock(mutex);
            decided += own;
        });
        return wrong;
    }

    std::size_t decided = 0;

private:
    const oracle::SceneJudge& judge_;
    bool overlaps_;
};

// The hidden one has a million points.
static void judge_space(std::size_t points_a_scene, int pixels) {
    std::size_t decided = 0, all = 0;
    for (const std::string& file : test::scene_files()) {
        INFO(file);
        const Scene scene = load_scene(file);
        Renderer renderer(scene, {}, test::on_native_device()), reference(scene, {}, {.reference = true});
        const oracle::SceneOracle oracle(scene, {}, true, true);
        const oracle::SceneJudge judge(oracle, renderer.model().regions(), renderer.statistics().tolerance);
        const std::vector<Vec3> points = random_points(renderer.model().bounds(), points_a_scene);
        Array<std::int32_t> found, other;
        renderer.region_at(points, found);
        reference.region_at(points, other);
        REQUIRE(test::same(found, other));
        renderer.model().region_at(points, other);
        REQUIRE(test::same(found, other));
        Judged by_points(judge, false), by_pixels(judge, true);
        REQUIRE(by_points(points.size(), found, [&](std::size_t i) { return points[i]; }) == "");
        for (const Vec3& normal : {Vec3{0, 0, 1}, Vec3{0.3, -0.5, 0.8}}) {
            const Box& box = renderer.model().bounds();
            const Vec3 at = 0.53 * box.low + 0.47 * box.high;
            const Slice slice = slice_of(box, normal, dot(unit(normal), at), pixels, pixels);
            renderer.slice(slice, found);
            reference.slice(slice, other);
            REQUIRE(test::same(found, other));
            const auto middle_of = [&](std::size_t i) {
                const auto x = static_cast<double>(i % std::size_t(pixels)),
                           y = static_cast<double>(i / std::size_t(pixels));
                return slice.center + (x + 0.5 - 0.5 * pixels) * slice.right + (0.5 * pixels - y - 0.5) * slice.up;
            };
            REQUIRE(by_pixels(found.size(), found, middle_of) == "");
        }
        decided += by_points.decided + by_pixels.decided;
        all += points.size() + 2 * std::size_t(pixels * pixels);
    }
    CHECK(decided > all * 9 / 10);
    if (all > 100'000) WARN(decided << " of " << all << " places are decided, none is wrong");
}

TEST_CASE("points and slices are the oracle's, where rounding decides nothing", "[promise:lists]") {
    judge_space(100, 8);
}
TEST_CASE("a million points are the oracle's", "[.long]") { judge_space(40'000, 80); }
