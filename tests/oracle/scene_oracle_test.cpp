// The oracle of whole scenes against answers that can be read off the numbers.
#include <csgrt/scene_io.hpp>

#include "catch.hpp"

#include "oracle/scene_judge.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

using Intervals = std::vector<std::array<double, 2>>;

Solid ball(const std::string& name, double x, double radius) {
    return {name, Ell{{x, 0, 0}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {}};
}
TreeNode leaf(const std::string& object, const Matrix& matrix = identity) {
    return {Operator::leaf, 0, object, matrix, {}};
}
TreeNode node(Operator op, std::uint32_t arity) { return {op, arity, {}, identity, {}}; }
Combination combination(const std::string& name, bool region, std::vector<TreeNode> nodes) {
    Combination c{.name = name, .region = region};
    c.tree.nodes = std::move(nodes);
    return c;
}
Matrix moved(double x) { return {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }

const Ray along_x{{-10, 0, 0}, {2, 0, 0}};  // t = (x + 10) / 2

/// x where the region is inside along the x axis.
Intervals on_axis(const SceneOracle& oracle, std::size_t region) {
    const SceneAnswer answer = oracle.shoot(along_x, 0);
    CHECK_FALSE(answer.tie);
    Intervals found;
    for (const Span& s : answer.regions.at(region))
        found.push_back({2 * to_double(s.in.at) - 10, 2 * to_double(s.out.at) - 10});
    return found;
}

}  // namespace

TEST_CASE("scene oracle: operators", "[oracle][promise:booleans]") {
    // a: -2..2, b: 0..4, c: 1..3 on the axis
    const auto found = [](std::vector<TreeNode> nodes) {
        Scene scene;
        scene.objects = {ball("a", 0, 2), ball("b", 2, 2), ball("c", 2, 1), combination("r", true, std::move(nodes))};
        const SceneOracle oracle(scene, {"r"});
        REQUIRE(oracle.regions().size() == 1);
        CHECK(oracle.regions()[0].path == "/r");
        return on_axis(oracle, 0);
    };
    CHECK(found({leaf("a"), leaf("b"), node(Operator::union_, 2)}) == Intervals{{-2, 4}});
    CHECK(found({leaf("a"), leaf("b"), node(Operator::intersection, 2)}) == Intervals{{0, 2}});
    CHECK(found({leaf("a"), leaf("b"), node(Operator::difference, 2)}) == Intervals{{-2, 0}});
    CHECK(found({leaf("b"), leaf("c"), node(Operator::difference, 2)}) == Intervals{{0, 1}, {3, 4}});
    CHECK(found({leaf("a"), leaf("b"), node(Operator::xor_, 2)}) == Intervals{{-2, 0}, {2, 4}});
    CHECK(found({leaf("a"), leaf("b"), leaf("c"), node(Operator::xor_, 3)}) == Intervals{{-2, 0}, {1, 2}, {3, 4}});
    CHECK(found({leaf("b"), leaf("a"), leaf("c"), node(Operator::difference, 3)}) == Intervals{{3, 4}});
    CHECK(found({leaf("b"), leaf("c"), node(Operator::not_, 1), node(Operator::intersection, 2)}) ==
          Intervals{{0, 1}, {3, 4}});
    CHECK(found({leaf("a"), leaf("b", moved(1)), node(Operator::intersection, 2)}) == Intervals{{1, 2}});
    CHECK(found({}).empty());
}

TEST_CASE("scene oracle: matrices add up on the way down", "[oracle]") {
    Scene scene;
    scene.objects = {ball("a", 0, 1), combination("r", true, {leaf("a", moved(1))}),
                     combination("g", false,
                                 {leaf("r", moved(2)), leaf("r", {2, 0, 0, 5, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}),
                                  node(Operator::union_, 2)})};
    const SceneOracle oracle(scene);
    REQUIRE(oracle.regions().size() == 2);
    CHECK(oracle.regions()[1].path == "/g/r");
    CHECK(on_axis(oracle, 0) == Intervals{{2, 4}});
    CHECK(on_axis(oracle, 1) == Intervals{{5, 9}});
}

TEST_CASE("scene oracle: operators above regions apply to each region", "[oracle][promise:booleans]") {
    Scene scene;
    scene.objects = {ball("a", 0, 2),
                     ball("b", 5, 2),
                     ball("c", 2, 1.5),
                     ball("d", 2, 3),
                     combination("ra", true, {leaf("a")}),
                     combination("rb", true, {leaf("b")}),
                     combination("both", false, {leaf("ra"), leaf("rb"), node(Operator::union_, 2)}),
                     combination("less", false, {leaf("both"), leaf("c"), node(Operator::difference, 2)}),
                     combination("within", false, {leaf("d"), leaf("both"), node(Operator::intersection, 2)}),
                     combination("apart", false, {leaf("both"), leaf("d"), node(Operator::xor_, 2)})};
    const SceneOracle less(scene, {"less"});
    REQUIRE(less.regions().size() == 2);
    CHECK(less.regions()[0].path == "/less/both/ra");
    CHECK(less.regions()[1].path == "/less/both/rb");
    CHECK(on_axis(less, 0) == Intervals{{-2, 0.5}});
    CHECK(on_axis(less, 1) == Intervals{{3.5, 7}});
    const SceneOracle within(scene, {"within"});
    REQUIRE(within.regions().size() == 2);
    CHECK(within.regions()[0].path == "/within/d");
    CHECK(on_axis(within, 0) == Intervals{{-1, 2}});
    CHECK(on_axis(within, 1) == Intervals{{3, 5}});
    const SceneOracle apart(scene, {"apart"});
    REQUIRE(apart.regions().size() == 1);
    CHECK(apart.regions()[0].path == "/apart/both/ra");
    CHECK(on_axis(apart, 0) == Intervals{{-2, -1}, {2, 3}, {5, 7}});
    CHECK(SceneOracle(scene, {"a", "rb"}).regions().size() == 2);  // a solid in no region is one
    CHECK(SceneOracle(scene).regions().size() == 5);
}

TEST_CASE("scene oracle: a shared face and a sliver thinner than the slack are ties", "[oracle]") {
    const auto box = [](const std::string& name, double low, double high) {
        return Solid{name,
                     Arb{{{{low, -1, -1},
                           {high, -1, -1},
                           {high, 1, -1},
                           {low, 1, -1},
                           {low, -1, 1},
                           {high, -1, 1},
                           {high, 1, 1},
                           {low, 1, 1}}}},
                     {}};
    };
    Scene scene;
    scene.objects = {box("a", 0, 2),
                     box("b", 2 - 1e-6, 3),
                     box("c", 2, 3),
                     combination("overlap", true, {leaf("a"), leaf("b"), node(Operator::intersection, 2)}),
                     combination("touch", true, {leaf("a"), leaf("c"), node(Operator::union_, 2)}),
                     combination("ra", true, {leaf("a")}),
                     combination("rc", true, {leaf("c")})};
    CHECK_FALSE(SceneOracle(scene, {"overlap"}).shoot(along_x, 1e-7).tie);
    CHECK(SceneOracle(scene, {"overlap"}).shoot(along_x, 1e-5).tie);
    CHECK(SceneOracle(scene, {"touch"}).shoot(along_x, 0).tie);
    const SceneAnswer beside = SceneOracle(scene, {"ra", "rc"}).shoot(along_x, 0);
    CHECK_FALSE(beside.tie);  // each region by itself is clear
    bool seen = false;        // and where they meet, each may hold
    for (const Piece& piece : beside.pieces) seen = seen || piece.claims.size() == 2;
    CHECK(seen);
}

TEST_CASE("scene oracle: a ray along a face of cells, where another face may decide, is a tie", "[oracle]") {
    Vol vol;  // two layers, the upper one half as long
    vol.width = 2;
    vol.height = vol.depth = 2;
    vol.low = 1;
    vol.high = 255;
    vol.cells = {9, 9, 9, 9, 9, 0, 9, 0};
    Scene scene{.objects = {Solid{"v", vol, {}}, combination("r", true, {leaf("v")})}};
    const SceneOracle oracle(scene, {"r"});
    const SceneAnswer inside = oracle.shoot({{-5, 0.5, 0.5}, {1, 0, 0}}, 0);
    const SceneAnswer between = oracle.shoot({{-5, 0.5, 1}, {1, 0, 0}}, 0);
    CHECK_FALSE(inside.tie);
    REQUIRE(inside.regions[0].size() == 1);
    CHECK(between.tie);  // as far as one layer reaches, or as the other
}

TEST_CASE("scene oracle: what is said in double to pass a solid by does", "[oracle]") {
    Random random(17);
    std::size_t passed = 0, met = 0;
    for (const Kind kind : {Kind::ell, Kind::tgc, Kind::arb, Kind::tor, Kind::part, Kind::hyp, Kind::metaball})
        for (std::size_t index = 0; index < 60; ++index) {
            const Case one = make_case(kind, index, random);
            const SceneSolid solid = scene_solid(one.shape, to_affine(one.matrix), 0.001, false);
            const QVec center = solid.bounds.center;
            for (int i = 0; i < 12; ++i) {
                // Beside the ball by a little, or by its half; near, or far away.
                const QVec d = random.direction(), aside = unit(cross(d, random.direction()));
                const double off = i % 3 == 0 ? random.between(0, 1) : 1 + random.signed_power(-9, -1);
                const double back = random.power(0, 6);
                const QVec o = center + quad(solid.bounds.radius) * (quad(off) * aside - quad(back) * d);
                const Ray ray{to_vec3(o), to_vec3(quad(random.power(-3, 3)) * d)};
                const Answer answer = solid(ray);
                const bool meets = !answer.intervals.empty() || !answer.outer.empty();
                met += meets;
                if (!solid.bounds.is_missed_by(ray.origin, ray.direction)) continue;
                ++passed;
                INFO(one.name);
                REQUIRE_FALSE(meets);
            }
        }
    CHECK(passed > 1000);
    CHECK(met > 500);
}

TEST_CASE("scene judge: on an edge the normal of either face will do, and no other", "[oracle]") {
    Scene scene;  // a roof whose ridge is the y axis
    scene.objects = {
        Solid{"roof",
              Arb{{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {0, -1, 0}, {0, -1, 0}, {0, 1, 0}, {0, 1, 0}}}},
              {}},
        combination("r", true, {leaf("roof")})};
    const SceneOracle oracle(scene, {"r"});
    RegionInfo region{.path = "/r"};
    const SceneJudge judge(oracle, {region}, 0);
    const auto fault = [&](const Vec3& normal) {
        const RayPartitions found{{{5, 6, normal, {0, 0, -1}, 0, 0, 0}}, {}};
        std::size_t ties = 0;
        return judge.judge({{0, 0.25, 5}, {0, 0, -1}}, found, ties);
    };
    const double h = std::sqrt(0.5);
    CHECK(fault({h, 0, h}).empty());
    CHECK(fault({-h, 0, h}).empty());
    CHECK(fault({0.6, 0, 0.8}).find("not the surface's") != std::string::npos);
    CHECK(fault({0, -1, 0}).find("not the surface's") != std::string::npos);
}

TEST_CASE("scene judge: an overlap behind the start cuts what reaches across it, however short", "[oracle]") {
    Scene scene;  // a ball from -5 to -0.9994 and one from -1 to 3: the first keeps what both hold
    scene.objects = {ball("one", -2.9997, 2.0003), ball("two", 1, 2), combination("a", true, {leaf("one")}),
                     combination("b", true, {leaf("two")})};
    const SceneOracle oracle(scene, {"a", "b"});
    RegionInfo a, b;
    a.path = "/a";
    b.path = "/b";
    const SceneJudge judge(oracle, {a, b}, 0.0005);
    const auto fault = [&](double in) {
        const RayPartitions found{{{in, 3, {-1, 0, 0}, {1, 0, 0}, 1, 0, 1}}, {}};
        std::size_t ties = 0;
        const std::string wrong = judge.judge({{0, 0, 0}, {1, 0, 0}}, found, ties);
        CHECK(ties == 0);
        return wrong;
    };
    CHECK(fault(-0.9994).empty());
    CHECK(fault(-0.9).find("no solid has an end") != std::string::npos);
}

TEST_CASE("scene judge: of a ray in an end face, what lies across the axis is no tie", "[oracle][promise:contact]") {
    const Scene scene = parse_scene(R"({"csgrt": 1, "objects": ["r"],
        "solids": {"box": {"type": "box", "low": [-3, -3, -3], "high": [3, 3, 3]},
                   "ring": {"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0], "angle": 270,
                            "sketch": {"vertices": [[1, -1], [2, -1], [2, 1], [1, 1]],
                                       "curves": [{"line": [0, 1]}, {"line": [1, 2]}, {"line": [2, 3]},
                                                  {"line": [3, 0]}]}}},
        "combinations": {"r": {"region": true, "tree": {"difference": ["box", "ring"]}}}})",
                                    "ring.json");
    const SceneOracle oracle(scene, {"r"});
    RegionInfo region{.path = "/r"};
    const SceneJudge judge(oracle, {region}, 0);
    const auto fault = [&](std::vector<Partition> partitions) {
        std::size_t ties = 0;
        return judge.judge({{9, 0, 0}, {-1, 0, 0}}, {std::move(partitions), {}}, ties);
    };
    const Vec3 in{1, 0, 0}, out{-1, 0, 0};
    CHECK(fault({{6, 10, in, out, 0, 0, 1}, {11, 12, in, out, 0, 1, 0}}).empty());
    CHECK(fault({{6, 12, in, out, 0, 0, 0}}).find("is not at") != std::string::npos);
}
