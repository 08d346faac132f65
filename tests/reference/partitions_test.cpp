// Whole scenes through the reference, before the oracle of point membership.
#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "oracle/random.hpp"
#include "oracle/scene_judge.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;
using oracle::quad;
using oracle::QVec;
using oracle::Random;

namespace {

/// Rays through a box: from all sides, along the axes, from inside, with directions of other lengths, in turn.
std::vector<Ray> rays_through(const Box& box, std::size_t count, Random& random) {
    const QVec low = box.low, high = box.high, center = quad(0.5) * (low + high), half = quad(0.5) * (high - low);
    const quad size = oracle::length(half);
    const auto inside = [&] {
        const QVec p = random.in_cube();
        return center + QVec{half.x * p.x, half.y * p.y, half.z * p.z};
    };
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const QVec through = inside();
        const QVec d = i % 4 == 1 ? random.axis() : random.direction();
        const QVec o = i % 4 == 2 ? through : through - quad(3) * size * d;
        rays.push_back({oracle::to_vec3(o), oracle::to_vec3(quad(i % 4 == 3 ? random.power(-3, 1) : 1) * d)});
    }
    return rays;
}

Settings on_reference() { return {.reference = true, .threads = 1}; }

/// Shoots `count` rays at the objects and judges them.
void check_scene(const Scene& scene, const std::vector<std::string>& objects, std::size_t count, std::uint64_t seed) {
    const oracle::SceneOracle judge_of_geometry(scene, objects);
    Renderer renderer(scene, objects, on_reference());
    const oracle::SceneJudge judge(judge_of_geometry, renderer.model().regions(), renderer.statistics().tolerance);
    REQUIRE(judge.unknown_regions().empty());
    Random random(seed);
    const std::vector<Ray> rays = rays_through(renderer.model().bounds(), count, random);
    const std::vector<RayPartitions> found = renderer.shoot(rays);
    REQUIRE(found.size() == rays.size());
    std::size_t ties = 0, failures = 0;
    for (std::size_t i = 0; i < rays.size() && failures < 3; ++i) {
        const std::string wrong = judge.judge(rays[i], found[i], ties);
        if (wrong.empty()) continue;
        ++failures;
        FAIL_CHECK(wrong);
    }
    CHECK(failures == 0);
}

/// A scene of solids in random trees: regions, regions of regions, operators above regions, matrices on legs.
class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : random_(seed) {
        for (int i = 0; i < 5; ++i) add_solid();
        std::vector<std::string> regions;
        for (int i = 0; i < 4; ++i) regions.push_back(add_combination(solids_, true, 2 + random_.below(4)));
        regions.push_back(solids_.front());
        for (int i = 0; i < 2; ++i) tops_.push_back(add_combination(regions, false, 2 + random_.below(2)));
    }
    const Scene& scene() const { return scene_; }
    const std::vector<std::string>& tops() const { return tops_; }

private:
    static Vec3 scaled(double s, const QVec& v) { return oracle::to_vec3(quad(s) * v); }

    void add_solid() {
        const QVec z = random_.direction(), x = oracle::any_across(z), y = oracle::cross(z, x);
        const Vec3 at = scaled(8, random_.in_cube());
        const double r = random_.between(4, 10), q = random_.between(4, 10);
        Shape shape = Ell{at, scaled(r, x), scaled(q, y), scaled(7, z)};
        const std::size_t kind = scene_.objects.size();
        if (kind % 5 == 1)
            shape = Tgc{at, scaled(14, z), scaled(r, x), scaled(q, y), scaled(r / 2, x), scaled(q / 3, y)};
        if (kind % 5 == 2) shape = Tor{at, oracle::to_vec3(z), 8, 3};
        if (kind % 5 == 3) shape = Ehy{at, scaled(12, z), oracle::to_vec3(x), r, q, 3};
        if (kind % 5 == 4)
            shape = Arb{
                {{{-9, -4, -6}, {9, -4, -6}, {9, 4, -6}, {-9, 4, -6}, {-5, -3, 6}, {5, -3, 6}, {5, 3, 6}, {-5, 3, 6}}}};
        solids_.push_back("s" + std::to_string(kind));
        scene_.objects.push_back(Solid{solids_.back(), shape, {}});
    }
    Matrix matrix() {
        if (random_.coin()) return identity;
        const QVec z = random_.direction(), x = oracle::any_across(z), y = oracle::cross(z, x),
                   o = quad(6) * random_.in_cube();
        const double s = random_.between(0.5, 1.5);
        const Vec3 a = scaled(random_.sign(), x), b = scaled(s, y), c = oracle::to_vec3(z), t = oracle::to_vec3(o);
        return {a.x, b.x, c.x, t.x, a.y, b.y, c.y, t.y, a.z, b.z, c.z, t.z, 0, 0, 0, 1};
    }
    std::string add_combination(const std::vector<std::string>& from, bool region, std::size_t leaves) {
        Combination c{.name = (region ? "r" : "top") + std::to_string(scene_.objects.size()), .region = region};
        const auto leaf = [&] {
            c.tree.nodes.push_back({Operator::leaf, 0, from[random_.below(from.size())], matrix(), {}});
        };
        leaf();
        for (std::size_t i = 1; i < leaves; ++i) {
            leaf();
            static constexpr Operator operators[] = {Operator::union_, Operator::difference, Operator::intersection,
                                                     Operator::union_, Operator::xor_,       Operator::not_};
            const Operator op = operators[random_.below(region ? 6 : 4)];
            if (op == Operator::not_) {
                c.tree.nodes.push_back({Operator::not_, 1, {}, identity, {}});
                c.tree.nodes.push_back({Operator::intersection, 2, {}, identity, {}});
            } else {
                c.tree.nodes.push_back({op, 2, {}, identity, {}});
            }
        }
        scene_.objects.push_back(c);
        return c.name;
    }

    Random random_;
    Scene scene_;
    std::vector<std::string> solids_, tops_;
};

}  // namespace

TEST_CASE("scenes agree with the oracle along rays", "[pipeline][oracle][promise:booleans][promise:partitions]") {
    for (const std::string& file : test::scene_files()) {
        INFO(file);
        const Scene scene = load_scene(file);
        check_scene(scene, {}, scene.objects.size() > 300 ? 40 : 200, 21);
    }
}

TEST_CASE("the oracle notices that a scene stands elsewhere by a thousandth", "[pipeline][oracle]") {
    for (const std::string& file : test::scene_files()) {
        INFO(file);
        const Scene scene = load_scene(file);
        if (scene.objects.size() > 300) continue;
        const oracle::SceneOracle geometry(scene);
        Renderer renderer(scene, {}, on_reference());
        const oracle::SceneJudge judge(geometry, renderer.model().regions(), renderer.statistics().tolerance);
        Random random(23);
        const std::vector<Ray> rays = rays_through(renderer.model().bounds(), 60, random);
        const QVec diagonal = QVec(renderer.model().bounds().high) - QVec(renderer.model().bounds().low);
        std::vector<Ray> moved = rays;
        for (Ray& ray : moved) ray.origin = oracle::to_vec3(QVec(ray.origin) + quad(1e-3) * diagonal);
        const std::vector<RayPartitions> found = renderer.shoot(moved);
        std::size_t hits = 0, noticed = 0, ties = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (found[i].partitions.empty()) continue;
            ++hits;
            noticed += judge.judge(rays[i], found[i], ties).empty() ? 0 : 1;
        }
        CHECK(hits > 5);
        CHECK(noticed * 10 > hits * 8);  // axes along the move, and ties, may miss it
    }
}

TEST_CASE("random scenes agree with the oracle along rays",
          "[pipeline][oracle][promise:booleans][promise:partitions]") {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        INFO("seed " << seed);
        const RandomScene made(seed);
        check_scene(made.scene(), made.tops(), 50, seed);
    }
}

TEST_CASE("many random scenes agree with the oracle along rays", "[.long][promise:booleans][promise:partitions]") {
    for (std::uint64_t seed = 1001; seed <= 1500; ++seed) {
        INFO("seed " << seed);
        const RandomScene made(seed);
        check_scene(made.scene(), made.tops(), 200, seed);
    }
}

TEST_CASE("BRL-CAD's models agree with the oracle along rays", "[.long]") {
    for (const test::Model& model : test::models_there()) {
        INFO(model.file);
        check_scene(load_scene(model.file), model.objects, 300, 22);
    }
}

TEST_CASE("the tolerance is in millimetres, whatever the length of the direction",
          "[pipeline][oracle][promise:coincidence]") {
    Scene scene;
    scene.objects = {Solid{"plate",
                           Arb{{{{-1, -1, 0},
                                 {1, -1, 0},
                                 {1, 1, 0},
                                 {-1, 1, 0},
                                 {-1, -1, 0.01},
                                 {1, -1, 0.01},
                                 {1, 1, 0.01},
                                 {-1, 1, 0.01}}}},
                           {}}};
    Renderer renderer(scene, {}, on_reference());
    for (const double length : {1e-3, 1.0, 1e3}) {
        INFO(length);
        const std::vector<RayPartitions> found = renderer.shoot({{{0, 0, 5}, {0, 0, -length}}});
        REQUIRE(found[0].partitions.size() == 1);
        CHECK(std::abs(found[0].partitions[0].in * length - 4.99) < 1e-12);
        CHECK(std::abs(found[0].partitions[0].out * length - 5) < 1e-12);
    }
}
