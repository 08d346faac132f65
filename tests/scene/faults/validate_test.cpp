// Scenes as a program may build them: what validate finds, where it looks, and what it costs.
#include "catch.hpp"

#include <limits>

#include "scene/make_scene.hpp"

using namespace csgrt;

namespace {

void check_one(const std::vector<Diagnostic>& found, const std::string& part_of_message) {
    REQUIRE(found.size() == 1);
    INFO(found[0].message);
    CHECK(found[0].message.find(part_of_message) != std::string::npos);
}

Tree tree(std::vector<TreeNode> nodes) { return {std::move(nodes)}; }

}  // namespace

TEST_CASE("validate: a sound scene") {
    CHECK(validate(make_scene({ball("a"), combination("b", union_of({"a", "a"}))})).empty());
    CHECK(validate(make_scene({ball("a")})).empty());
}

TEST_CASE("validate: looks at what is reached, and nothing else", "[promise:refusals]") {
    const Scene scene =
        make_scene({ball("good"), ball("bad", 0), combination("uses_bad", union_of({"bad"})),
                    combination("uses_good", union_of({"good"})), combination("lost", union_of({"gone"}))});
    CHECK(validate(scene, {"uses_good"}).empty());
    CHECK(validate(scene, {"uses_bad"}).size() == 3);
    check_one(validate(scene, {"lost"}), "'lost' uses 'gone', which does not exist");
    check_one(validate(scene, {"uses_god"}), "no object 'uses_god'");
    CHECK(validate(scene, {"uses_god"})[0].suggestion == "did you mean 'uses_good'?");
    CHECK(validate(scene).size() == 4);
}

TEST_CASE("validate: an object that many use is reported once") {
    const Scene scene =
        make_scene({solid("bad", Tor{{}, {0, 0, 1}, 1, 2}), combination("b", union_of({"bad", "bad", "bad"})),
                    combination("c", union_of({"b", "bad", "b"}))});
    check_one(validate(scene), "tube");
}

TEST_CASE("validate: empty scenes") {
    check_one(validate({}), "nothing to render");
    check_one(validate(make_scene({combination("a", {})})), "nothing to render");
}

TEST_CASE("validate: two objects of one name") {
    check_one(validate(make_scene({ball("a"), ball("a")})), "two objects named 'a'");
}

TEST_CASE("validate: cycles show their path, also when nothing is on top") {
    check_one(validate(make_scene({combination("a", union_of({"b"})), combination("b", union_of({"a"}))})),
              "'a' contains itself: a/b/a");
    const Scene below =
        make_scene({ball("s"), combination("top", union_of({"s", "a"})), combination("a", union_of({"b", "s"})),
                    combination("b", union_of({"c"})), combination("c", union_of({"b"}))});
    check_one(validate(below), "'b' contains itself: b/c/b");
    check_one(validate(make_scene({ball("s"), combination("x", union_of({"s", "x"}))}), {"x"}),
              "'x' contains itself: x/x");
}

TEST_CASE("validate: trees that are no trees", "[promise:refusals]") {
    const auto found = [](Tree t) { return validate(make_scene({ball("a"), combination("c", std::move(t))}), {"c"}); };
    CHECK(found(tree({leaf("a")})).empty());
    CHECK(found(tree({leaf("a"), node(Operator::not_, 1), leaf("a"), node(Operator::intersection, 2)})).empty());
    check_one(found(tree({leaf("a"), leaf("a")})), "operands that no operator combines");
    check_one(found(tree({leaf("a"), node(Operator::union_, 2)})), "lacks operands for 'union'");
    check_one(found(tree({leaf("a"), node(Operator::difference, 1)})), "'difference' cannot have 1");
    check_one(found(tree({leaf("a"), leaf("a"), node(Operator::not_, 2)})), "'not' cannot have 2");
    check_one(found(tree({leaf("a"), node(Operator::xor_, 0)})), "'xor' cannot have 0");
    check_one(found(tree({leaf("a"), node(static_cast<Operator>(17), 1)})), "no operator");
    TreeNode stray = leaf("a");
    stray.arity = 3;
    check_one(found(tree({stray})), "'leaf' cannot have 3");
}

TEST_CASE("validate: matrices") {
    const auto found = [](const Matrix& m) {
        return validate(make_scene({ball("a"), combination("c", tree({leaf("a", m)}))}), {"c"});
    };
    CHECK(found({2, 0, 0, 1e9, 0, -1e-6, 0, 0, 5, 0, 1e6, 0, 0, 0, 0, 1}).empty());
    check_one(found({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}), "singular");
    check_one(found({1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "singular");
    check_one(found({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}), "0 0 0 1");
    check_one(found({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1}), "0 0 0 1");
    check_one(found({1, 0, 0, std::numeric_limits<double>::infinity(), 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
              "not finite");
}

TEST_CASE("validate: settings, colours and finishes") {
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    Scene scene = make_scene({ball("a")});
    scene.tolerance = -1;
    scene.ambient = not_a_number;
    scene.background = {0, 2, 0};
    scene.camera.perspective = 180;
    scene.camera.view_size = 0.0;
    scene.lights.push_back({{not_a_number, 0, 0}, {1, 1, 1}, -1});
    CHECK(validate(scene).size() == 7);

    Combination painted = std::get<Combination>(combination("c", union_of({"a"})));
    painted.color = Vec3{0, 0, 1.5};
    painted.finish = Finish{"plastic", -1, 0, not_a_number, Limits::shine + 1, 0, 0};
    CHECK(validate(make_scene({ball("a"), painted})).size() == 4);
}

TEST_CASE("validate: a solid that is not supported names its users") {
    const Scene scene =
        make_scene({solid("hose", Unsupported{"pipe"}), ball("a"), combination("pump", union_of({"a", "hose"})),
                    combination("car", union_of({"pump", "hose"})), combination("bus", union_of({"a"}))});
    check_one(validate(scene, {"car"}),
              "'hose' is a solid of type 'pipe', which csgrt does not support; used by 'pump' and on 1 other leg");
    CHECK(validate(scene, {"bus"}).empty());
    check_one(validate(scene, {"hose"}), "does not support");
}

TEST_CASE("validate: copies of copies are counted without making them", "[promise:limits]") {
    std::vector<Object> objects = {ball("c0")};
    for (int i = 1; i <= 200; ++i) {
        const std::string below = "c" + std::to_string(i - 1);
        objects.push_back(combination("c" + std::to_string(i), union_of({below, below})));
    }
    const Scene scene = make_scene(std::move(objects));
    CHECK(validate(scene, {"c18"}).empty());  // 262,144
    check_one(validate(scene, {"c19"}), "'c19' expands to 524288 instances; at most 300000 are allowed");
    check_one(validate(scene), "'c19' expands to 524288 instances");  // not 2^200
    check_one(validate(scene, {"c18", "c18"}), "the scene expands to 524288 instances");
    CHECK(validate(scene, {"c19"})[0].suggestion.find("--max-instances") != std::string::npos);
    const auto most = [&](const char* object, std::uint64_t max_instances) {
        return validate(scene, {object}, false, nullptr, max_instances);
    };
    CHECK(most("c24", Limits::most_instances).empty());  // 16,777,216
    check_one(most("c25", UINT64_MAX), "at most 20000000 are allowed");
    CHECK(most("c25", UINT64_MAX)[0].suggestion.find("--max-instances") == std::string::npos);
    CHECK(most("c3", 8).empty());
    check_one(most("c3", 7), "'c3' expands to 8 instances; at most 7 are allowed");
}

TEST_CASE("validate: each object once is never too many, and a few copies of large solids may be", "[promise:limits]") {
    std::vector<Object> objects;
    std::vector<std::string> names;
    for (std::uint64_t i = 0; i < Limits::instances + 5; ++i) {
        names.push_back("b" + std::to_string(i));
        objects.push_back(ball(names.back()));
    }
    objects.push_back(combination("all", union_of(names)));
    CHECK(validate(make_scene(std::move(objects))).empty());

    // A pipe is made of pieces, and each place of an arbn or a metaball has planes or points of its own.
    Pipe pipe;
    for (int i = 0; i < 1'000; ++i) pipe.points.push_back({{10.0 * i, 10.0 * (i % 2), 0}, 1, 0, 1});
    Metaball metaball{Metaball::Method::blob, 1, {}};
    for (int i = 0; i < 1'000; ++i) metaball.points.push_back({{1.0 * i, 0, 0}, 1, 1});
    for (const Shape& shape : {Shape(pipe), Shape(metaball)}) {
        const auto copies = [&](std::size_t count) {
            return validate(
                make_scene({solid("s", shape), combination("c", union_of(std::vector<std::string>(count, "s")))}));
        };
        CHECK(copies(30).empty());
        check_one(copies(151), "instances; at most 300000 are allowed");
    }
    const std::string name(10 << 10, 'n');
    const auto named = [&](std::size_t count) {
        return validate(make_scene({ball(name), combination("c", union_of(std::vector<std::string>(200, name))),
                                    combination("d", union_of(std::vector<std::string>(count, "c")))}));
    };
    CHECK(named(100).empty());
    check_one(named(200), "instances; at most 300000 are allowed");
}

TEST_CASE("validate: of a long cycle the end is told") {
    std::vector<Object> objects = {ball("s")};
    for (int i = 0; i < 400; ++i)
        objects.push_back(combination("c" + std::to_string(i), union_of({"s", "c" + std::to_string((i + 1) % 400)})));
    check_one(validate(make_scene(std::move(objects)), {"c0"}), "'c0' contains itself: c0/.../c380/c381/");
}

TEST_CASE("validate: nesting is limited, and costs no stack up to there and beyond", "[promise:limits]") {
    const auto chain = [](int length) {
        std::vector<Object> objects = {ball("c0")};
        for (int i = 1; i <= length; ++i) {
            objects.push_back(combination("c" + std::to_string(i), union_of({"c" + std::to_string(i - 1)})));
        }
        return make_scene(std::move(objects));
    };
    CHECK(validate(chain(static_cast<int>(Limits::nesting))).empty());
    check_one(validate(chain(static_cast<int>(Limits::nesting) + 1)), "nested more than 1000 deep");
    check_one(validate(chain(200'000)), "nested more than 1000 deep");
}

TEST_CASE("validate: many findings are cut off, and their number is told", "[promise:refusals]") {
    std::vector<Object> objects;
    for (int i = 0; i < 70; ++i)
        objects.push_back(ball("b" + std::to_string(i), std::numeric_limits<double>::infinity()));
    const auto found = validate(make_scene(std::move(objects)));
    REQUIRE(found.size() == 51);
    CHECK(found.back().message == "and 20 more errors");
}
