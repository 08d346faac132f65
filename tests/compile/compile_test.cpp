// Whole compiled scenes: numbering, lists, materials, boxes, notes, errors, the hash.
#include <algorithm>
#include <set>

#include "base/srgb.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "scene/warning_texts.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

bool same(const Vec3& a, const Vec3& b) { return near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z); }

Scene plate_with_hole() {
    Scene s = scene({block("plate", {-5, -5, 0}, {5, 5, 1}),
                     solid("hole", Tgc{{0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 2, 0}}),
                     ball("knob", {0, 0, 3}, 1), solid("ground", Half{{{0, 0, 1}, 0}}),
                     region("plate.r", {leg("plate"), leg("hole"), less}, 1), region("knob.r", {leg("knob")}, 2),
                     region("ground.r", {leg("ground")}, 3),
                     group("all", {leg("plate.r"), leg("knob.r"), leg("ground.r"), op(Operator::union_, 3)})});
    std::get<Combination>(s.objects[5]).color = Vec3{1, 0, 0};
    return s;
}

}  // namespace

TEST_CASE("a compiled scene: everything is where the records say") {
    const CompiledScene c = compile(plate_with_hole());
    REQUIRE(c.solids.size() == 4);
    REQUIRE(c.regions.size() == 3);
    CHECK(c.unbounded_count == 1);
    CHECK(c.solid_info[0].name == "ground");
    CHECK(c.solid_info[0].type == "half");
    CHECK(c.solid_types == (1u << SOLID_ARB | 1u << SOLID_TGC | 1u << SOLID_ELL | 1u << SOLID_HALF));
    CHECK(!c.has_large_terms);
    // Ground, base of the plate and of the hole are one plane; so are the tops.
    CHECK(c.planes.size() == 6);

    CHECK(c.region_info[0].path == "/all/plate.r");
    CHECK(c.regions[0].word_count == 3);
    CHECK(c.regions[1].word_count == 1);
    REQUIRE(c.materials.size() == c.regions.size());
    CHECK(c.materials[0].r == c.materials[2].r);
    CHECK(c.materials[1].r == 1);
    CHECK(c.materials[1].g == 0);
    CHECK(c.materials[0].shine == 10);

    for (std::uint32_t i = 0; i < c.solids.size(); ++i) {
        const bool is_hole = c.solid_info[i].name == "hole";
        REQUIRE(c.solids[i].start_count == (is_hole ? 0 : 1));
        if (is_hole) continue;
        const kernel::StartRecord& start = c.starts[c.solids[i].first_start];
        CHECK(kernel::within(kernel::filter_of(i), start.needed));
        CHECK(std::count(c.trees.begin() + start.first_word, c.trees.begin() + start.end_word,
                         OP_LEAF << TREE_SHIFT | i) == 1);
        const auto& nodes = c.flat_trees[start.region].nodes;
        CHECK(std::any_of(nodes.begin(), nodes.end(),
                          [&](const auto& n) { return n.op == Operator::leaf && n.solid == i; }));
    }
    CHECK(same(c.bounds.low, {-5, -5, 0}));
    CHECK(same(c.bounds.high, {5, 5, 4}));
    CHECK(same(c.region_info[1].bounds.low, {-1, -1, 2}));
    CHECK(c.region_info[2].bounds.high.x == infinity);
    CHECK(near(c.center.z, 2, 1e-9));
    CHECK(near(c.radius, std::sqrt(25 + 25 + 4.0), 1e-9));
}

TEST_CASE("solids list the terms that they start") {
    Scene s = scene({ball("a"), ball("b", {0.5, 0, 0}), region("r1", {leg("a"), leg("b"), both}),
                     region("r2", {leg("b"), leg("b"), leg("a"), op(Operator::union_, 3)}), region("r3", {leg("b")}),
                     region("r4", {leg("a"), leg("b"), less})});
    const CompiledScene c = compile(s, {"r1", "r2", "r3", "r4"});
    REQUIRE(c.solids.size() == 2);
    for (std::uint32_t i = 0; i < 2; ++i) {
        const kernel::SolidRecord& record = c.solids[i];
        std::vector<std::uint32_t> starts;
        for (std::uint32_t k = 0; k < record.start_count; ++k)
            starts.push_back(c.starts[record.first_start + k].region);
        CHECK(record.leaf_count == 0);  // only in large terms
        // One of the two starts r1, a starts r4, both r2.
        starts.erase(std::remove(starts.begin(), starts.end(), 0u), starts.end());
        const bool is_b = c.solid_info[i].name == "b";
        CHECK(starts == (is_b ? std::vector<std::uint32_t>{1, 1, 2} : std::vector<std::uint32_t>{1, 3}));
    }
    CHECK(c.starts.size() == 6);
}

TEST_CASE("solids are numbered in the order of the hierarchy's leaves, behind the unbounded ones") {
    std::vector<TreeNode> nodes;
    Scene s;
    for (int i = 0; i < 300; ++i) {
        const std::string name = "s" + std::to_string(i);
        if (i % 100 == 50) {
            s.objects.emplace_back(solid(name, Half{{{0, 0, 1}, -1.0 * i}}));
        } else {
            s.objects.emplace_back(ball(name, {std::fmod(i * 37.0, 100.0), std::fmod(i * 61.0, 97.0), 0}));
        }
        nodes.push_back(leg(name));
    }
    nodes.push_back(op(Operator::union_, 300));
    s.objects.emplace_back(region("r", nodes));
    const CompiledScene c = compile(s, {"r"});
    REQUIRE(c.solids.size() == 300);
    CHECK(c.unbounded_count == 3);
    for (std::uint32_t i = 0; i < 300; ++i) CHECK((c.solids[i].type == SOLID_HALF) == (i < 3));
    std::uint32_t next = 3;
    for (const kernel::BvhNode& node : c.nodes) {
        if (node.leaf == 0) continue;
        CHECK(node.leaf >> BVH_LEAF_SHIFT == next);
        for (std::uint32_t k = 0; k < (node.leaf & BVH_LEAF_MASK); ++k, ++next) {
            CHECK(node.low[0] <= c.solid_boxes[next].low.x - c.center.x);
            CHECK(node.high[1] >= c.solid_boxes[next].high.y - c.center.y);
            // The ball's centre stands first in its parameters: names follow the numbering.
            const int i = std::stoi(c.solid_info[next].name.substr(1));
            CHECK(c.reals[c.solids[next].first_real] == std::fmod(i * 37.0, 100.0));
        }
    }
    CHECK(next == 300);
    std::set<std::uint32_t> leaves;
    for (const auto& node : c.flat_trees[0].nodes)
        if (node.op == Operator::leaf) leaves.insert(node.solid);
    CHECK(leaves.size() == 300);
}

TEST_CASE("scenes without anything bounded compile: half-spaces only") {
    const Scene s = scene({solid("up", Half{{{0, 0, 1}, 1}}), solid("down", Half{{{0, 0, -1}, 1}}),
                           region("slab", {leg("up"), leg("down"), both}), region("up.r", {leg("up")})});
    const CompiledScene c = compile(s, {"slab", "up.r"});
    CHECK(c.unbounded_count == 2);
    CHECK(c.nodes.empty());
    CHECK(c.radius == 0);
    CHECK(is_empty(c.bounds));
    CHECK(c.planes.size() == 2);
    // Two that face each other across one plane share it.
    const Scene t = scene({solid("up", Half{{{0, 0.6, 0.8}, 100}}), solid("down", Half{{{0, -0.6, -0.8}, -100}}),
                           region("r", {leg("up"), leg("down"), one_of})});
    CHECK(compile(t, {"r"}).planes.size() == 1);
}

TEST_CASE("an arb whose faces do not close is refused") {
    const Vec3 p{1, 0, 2}, q{3, 3, 1};
    const Scene s = scene({solid("odd", Arb{{{{2, 0, 2}, p, q, p, {1, 2, 0}, p, q, p}}}), region("r", {leg("odd")})});
    CHECK(says(error_of([&] { compile(s, {"r"}); }), "solid 'odd': its faces lie on one another: there is no volume"));
}

TEST_CASE("nothing to render is an error that says why") {
    Scene s = scene(
        {ball("a"), region("air", {leg("a")}), group("none", {}), region("hollow", {leg("a"), leg("none"), both})});
    std::get<Combination>(s.objects[1]).air = 1;
    const std::string error = error_of([&] { compile(s, {"air", "hollow"}); });
    CHECK(says(error, "nothing to render"));
    CHECK(says(error, "1 air region left out: /air"));
    CHECK(says(error, "1 region without solids left out: /hollow"));
    CompileOptions options;
    options.air = true;
    const CompiledScene c = compile(s, {"air", "hollow"}, options);
    CHECK(c.regions.size() == 1);
    CHECK(test::texts(c.warnings) == std::vector<std::string>{"1 region without solids left out: /hollow"});
}

TEST_CASE("what validation finds is thrown with every finding", "[promise:refusals]") {
    Scene s = plate_with_hole();
    std::get<Combination>(s.objects[4]).tree.nodes[0].object = "plat";
    std::get<Combination>(s.objects[5]).tree.nodes[0].object = "knop";
    const Thrown thrown = thrown_by([&] { compile(s); });
    CHECK(thrown.status == Status::scene);
    CHECK(thrown.findings.size() >= 2);
}

TEST_CASE("lights, background, ambient and tolerance come along") {
    Scene s = plate_with_hole();
    s.lights = {{{1, 2, 3}, {1, 0.5, 0.25}, 2}};
    s.background = {0.1, 0.2, 0.3};
    s.ambient = 0.25;
    s.tolerance = 1e-6;
    const CompiledScene c = compile(s);
    REQUIRE(c.lights.size() == 1);
    CHECK(c.lights[0].y == 2);
    CHECK(c.lights[0].r == 2);
    CHECK(c.lights[0].b == static_cast<float>(2 * linear_of_display(0.25)));
    CHECK(c.background == std::vector{linear_of_display(0.1), linear_of_display(0.2), linear_of_display(0.3)});
    CHECK(c.ambient == 0.25);
    CHECK(c.tolerance == 1e-6);
}

TEST_CASE("materials have linear light, or with display shading what the model says") {
    Scene s = plate_with_hole();
    s.lights = {{{1, 2, 3}, {1, 0.5, 0.25}, 2}};
    s.background = {0.1, 0.2, 0.3};
    std::get<Combination>(s.objects[5]).color = Vec3{0.5, 1, 0};
    const CompiledScene linear = compile(s), display = compile(s, {}, {.display_shading = true});
    CHECK(linear.materials[1].r == static_cast<float>(linear_of_display(0.5)));
    CHECK(linear.materials[1].g == 1);
    CHECK(linear.materials[1].b == 0);
    CHECK(linear.region_info[1].color == Vec3{0.5, 1, 0});
    CHECK(display.materials[1].r == 0.5f);
    CHECK(display.lights[0].b == 0.5f);
    CHECK(display.background == std::vector<double>{0.1, 0.2, 0.3});
    CHECK(display.hash != linear.hash);
}

TEST_CASE("regions that shine: the brightest and half of the ambient light make white") {
    Scene s = plate_with_hole();
    s.ambient = 0.4;
    const auto shine = [&](std::size_t region, const Emission& emission) {
        std::get<Combination>(s.objects[region]).finish = Finish{.light = emission};
    };
    shine(4, {.intensity = 1});
    shine(5, {.intensity = 2});
    shine(6, {.intensity = 9, .fraction = 0.3});  // the ground: no light comes from what has no end
    const CompiledScene c = compile(s);
    REQUIRE(c.lights.size() == 2);
    CHECK(c.lights[0].r == Approx(c.materials[0].r * 0.5 / 1.2));
    CHECK(c.lights[1].r == Approx(1 / 1.2));
    for (const auto& [region, brightness] : {std::pair(0, 0.5 / 1.2), std::pair(1, 1 / 1.2), std::pair(2, 0.3)}) {
        const kernel::MaterialRecord& m = c.materials[region];
        CHECK(m.diffuse == 0);
        CHECK(m.glow == Approx(0.5 * brightness));
        CHECK(m.ambient * s.ambient == Approx(0.5 * brightness));
    }
}

TEST_CASE("the hash is the scene's: the same for the same, another for any change") {
    const Scene original = plate_with_hole();
    const std::uint64_t hash = compile(original).hash;
    CHECK(compile(original).hash == hash);
    std::set<std::uint64_t> hashes{hash};
    const auto changed = [&](const auto& change) {
        Scene s = original;
        change(s);
        hashes.insert(compile(s).hash);
    };
    changed([](Scene& s) { std::get<Ell>(std::get<Solid>(s.objects[2]).shape).v.x = 1e-9; });
    changed([](Scene& s) { std::get<Combination>(s.objects[4]).tree.nodes[2].op = Operator::union_; });
    changed([](Scene& s) { std::get<Combination>(s.objects[5]).color = Vec3{1, 0, 0.01}; });
    changed([](Scene& s) { s.lights = {{}}; });
    changed([](Scene& s) { s.lights = {{{0, 0, 1}}}; });
    changed([](Scene& s) { s.tolerance = 0.001; });
    changed([](Scene& s) {
        std::swap(std::get<Combination>(s.objects[7]).tree.nodes[0], std::get<Combination>(s.objects[7]).tree.nodes[1]);
    });
    CHECK(hashes.size() == 8);
    Scene renamed = original;  // names do not cross the bus
    renamed.title = "another";
    CHECK(compile(renamed).hash == hash);
}
