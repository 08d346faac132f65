// Valid scenes made at random: solids of every type, from a hundredth to 10^5 millimetres and some far larger or
// smaller, in trees of all operators, combinations in combinations, regions anywhere. The device gives the reference's
// bits, and the 113-bit answer judges a sample.
#include <cstdlib>
#include <optional>

#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "integration/same_answers.hpp"
#include "integration/samples.hpp"
#include "integration/scenes.hpp"
#include "oracle/shapes.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

class SceneMaker {
public:
    explicit SceneMaker(std::uint64_t seed) : random_(seed), cases_(seed) {}

    Scene make() {
        size_ = random_.power_of_ten(-2, 5);
        std::vector<std::string> names;
        for (std::uint32_t i = 0, count = 1 + random_.below(5); i < count; ++i) {
            const bool region = random_.below(4) == 0;  // first: compilers differ in which argument they take first
            names.push_back(add(leaf_of_solid(), region));
        }
        for (std::uint32_t i = 0, count = 1 + random_.below(4); i < count; ++i) {
            std::vector<std::string> legs;  // one may come twice, from other places
            for (std::uint32_t k = 0, legs_here = 1 + random_.below(4); k < legs_here; ++k)
                legs.push_back(names[random_.below(static_cast<std::uint32_t>(names.size()))]);
            Tree tree = some_tree(legs, random_);
            for (TreeNode& node : tree.nodes)
                if (node.op == Operator::leaf && random_.coin()) node.matrix = placed() * node.matrix;
            names.push_back(add(std::move(tree), random_.coin()));
        }
        return std::move(scene_);
    }

private:
    Matrix placed() {
        const Vec3 way = random_.in_cube();
        const Vec3 at = (random_.coin() ? 0.5 : 2) * size_ * way;
        Matrix stretch = identity;
        for (const int axis : {0, 5, 10}) {
            stretch[axis] = random_.sign();
            stretch[axis] *= random_.between(0.5, 2);
        }
        const Matrix turn = random_.coin() ? rotation(random_) : identity;
        return random_.below(4) == 0 ? translation(at) * turn * stretch : translation(at) * turn;
    }

    /// A solid of a size of about 1, scaled; or one of the forms of the oracle's tests, tiny and huge ones, too.
    Tree leaf_of_solid() {
        Tree tree = any_leaf();
        // Their boxes take twice as long as all else here.
        const bool takes_long =
            std::holds_alternative<Metaball>(std::get<Solid>(scene_.objects.back()).shape) && random_.below(20) > 0;
        if (!takes_long) return tree;
        scene_.objects.pop_back();
        return leaf_of_solid();
    }
    Tree any_leaf() {
        const std::string name = "s" + std::to_string(scene_.objects.size());
        if (random_.coin()) {
            static const Scene samples = test::scene_of_samples();
            Solid solid =
                std::get<Solid>(samples.objects[random_.below(static_cast<std::uint32_t>(samples.objects.size()))]);
            solid.name = name;
            scene_.objects.push_back(std::move(solid));
            return leaf(name, placed() * scaling(size_));
        }
        const auto kind = static_cast<oracle::Kind>(random_.below(oracle::kind_count));
        oracle::Case one = oracle::make_case(kind, random_.below(200), cases_);
        scene_.objects.push_back(Solid{name, std::move(one.shape), {}});
        return leaf(name, placed() * scaling(size_) * one.matrix);
    }

    std::string add(Tree tree, bool region) {
        Combination combination;
        combination.name = "c" + std::to_string(scene_.objects.size());
        combination.tree = std::move(tree);
        combination.region = region;
        if (region && random_.below(8) == 0) combination.fastgen = Fastgen::plate;
        scene_.objects.push_back(combination);
        return combination.name;
    }

    Random random_;
    oracle::Random cases_;
    double size_ = 1;
    Scene scene_;
};

struct Tally {
    std::size_t scenes = 0, refused = 0, hits = 0;
    std::uint64_t judged = 0, decided = 0;
};

/// The device gives the reference's bits; `judged`: and the oracle finds nothing wrong in them.
void require_scene(const Scene& scene, bool every_partition, bool judged, Tally& tally) {
    Settings settings = test::on_native_device(), by_reference = settings;
    by_reference.reference = true;
    by_reference.device.clear();
    std::optional<Renderer> reference;
    try {
        reference.emplace(scene, std::vector<std::string>(), by_reference);
    } catch (const Error& error) {  // coordinates that are too large, or a region without end
        INFO(error.what());
        REQUIRE(error.status() == Status::scene);
        REQUIRE_THROWS_AS(Renderer(scene, {}, settings), Error);
        ++tally.refused;
        return;
    }
    ++tally.scenes;
    Renderer device(scene, {}, settings);
    const Box& bounds = reference->model().bounds();
    const Box box = bounds.low.x > bounds.high.x ? Box{{-9, -9, -9}, {9, 9, 9}} : bounds;  // half-spaces alone
    const std::vector<Ray> rays = test::random_rays(box, 16);
    const std::vector<RayPartitions> answers = reference->shoot(rays);
    test::require_same(device.shoot(rays), answers);
    for (const RayPartitions& answer : answers) tally.hits += !answer.partitions.empty();
    View view{.width = 17, .height = 13, .camera = {}, .every_partition = every_partition};
    test::require_same(device.render(view), reference->render(view));
    if (!judged) return;
    Verifier verifier(scene, {}, settings);
    verifier.shoot(rays);
    const Verification& result = verifier.result();
    tally.judged += rays.size();
    tally.decided += result.decided;
    REQUIRE(result.wrong == 0);
    REQUIRE(result.bit_differences == 0);
}

/// `each`: so many scenes for one that is judged.
Tally require_scenes(std::uint64_t first, std::uint64_t count, std::uint64_t each) {
    Tally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        INFO("seed " << seed);
        require_scene(SceneMaker(seed).make(), seed % 2 == 0, seed % each == 0, tally);
    }
    return tally;
}

void require_tally(const Tally& tally) {
    WARN(tally.scenes << " scenes, " << tally.refused << " refused, " << tally.hits << " rays hit, " << tally.decided
                      << " of " << tally.judged << " rays judged were decided");
    CHECK(10 * tally.refused < tally.scenes);
    CHECK(tally.hits > 2 * tally.scenes);
    CHECK(2 * tally.decided > tally.judged);
}

}  // namespace

TEST_CASE("random scenes: device and reference agree, and a sample is right", "[agreement]") {
    require_tally(require_scenes(0, static_cast<std::uint64_t>(test::tries(60)), 20));
}
// A scene that this maker made once. First hits by the order of the boxes were wrong in it.
TEST_CASE("random scenes: a plate that a ray grazes begins far before its box", "[agreement][promise:rounding]") {
    const std::string scenes = test::folder("CSGRT_SCENES");
    if (scenes.empty()) return;
    const Scene scene = load_scene(scenes + "/../tests/integration/grazed_plate.json");
    Tally tally;
    require_scene(scene, false, true, tally);
    Renderer renderer(scene, {}, test::on_native_device());
    renderer.render({.width = 8, .height = 8, .camera = {}, .every_partition = false});
    CHECK(renderer.statistics().method == "every partition, five kernels");
}
TEST_CASE("random scenes: 100,000", "[.long][agreement]") {
    const char* const first = std::getenv("CSGRT_SEED");  // for several processes at once
    require_tally(require_scenes(first ? std::strtoull(first, nullptr, 10) : 1'000, 100'000, 100));
}
