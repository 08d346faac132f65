// What half-spaces leave of regions' trees and of solids, before solids are numbered; and which solids rays meet.

#include "catch.hpp"
#include "compile/bounds/instance_bounds.hpp"
#include "compile/bvh/space.hpp"
#include "compile/half_spaces.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "stress/random.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// A row of balls of radius 1 at x = 0, 10, 20, 30, and the half-space x <= 10, which cuts the second.
struct Row {
    Scene scene;
    FlatScene flat;
    Clipped clipped;

    explicit Row(std::vector<TreeNode> nodes, std::vector<Object> more = {}) {
        scene = test::scene({ball("a"), ball("b", {10, 0, 0}), ball("c", {20, 0, 0}), ball("d", {30, 0, 0}),
                             solid("h", Half{{{1, 0, 0}, 10}}), region("r", std::move(nodes))});
        scene.objects.insert(scene.objects.end(), more.begin(), more.end());
        std::vector<std::string> regions;
        for (const Object& object : scene.objects)
            if (std::holds_alternative<Combination>(object)) regions.push_back(name_of(object));
        flat = flatten(scene, regions, false);
        clipped = clip_by_half_spaces(scene, flat, InstanceBounds(scene, flat).boxes);
    }

    /// In postfix order: u, +, -, ^, !, with the arity if it is not 2.
    std::string tree(std::size_t number = 0) const {
        std::string text;
        for (const FlatTree::Node& node : clipped.trees.at(number).nodes) {
            text += node.op == Operator::leaf ? name_of(scene.objects[flat.instances[node.solid].object])
                                              : std::string(1, " u+-^!"[static_cast<int>(node.op)]);
            if (node.arity > 2) text += std::to_string(node.arity);
        }
        return text;
    }
    const Box& reach(const std::string& name) const {
        for (std::size_t i = 0; i < flat.instances.size(); ++i)
            if (name_of(scene.objects[flat.instances[i].object]) == name) return clipped.ray_boxes.at(i);
        FAIL(name);
        return clipped.bounded_box;
    }
    bool is_met(const std::string& name) const { return !is_empty(reach(name)); }
};

}  // namespace

TEST_CASE("half-spaces: they stand at what they cut, and what they take away is gone") {
    const auto all = op(Operator::union_, 4);
    const Row kept({leg("a"), leg("b"), leg("c"), leg("d"), all, leg("h"), both});
    CHECK(kept.tree() == "abh+u");
    CHECK(kept.is_met("b"));
    CHECK(!kept.is_met("c"));
    const Row removed({leg("a"), leg("b"), leg("c"), leg("d"), all, leg("h"), less});
    CHECK(removed.tree() == "bh-cdu3");
    CHECK(!removed.is_met("a"));
    CHECK(Row({leg("h"), leg("a"), both}).tree() == "a");
    CHECK(Row({leg("c"), leg("h"), both, leg("b"), either}).tree() == "b");
    CHECK(Row({leg("c"), leg("h"), both}).tree().empty());
}

TEST_CASE("half-spaces: of an intersection one operand is cut, of a difference the first") {
    CHECK(Row({leg("b"), leg("a"), leg("b"), either, both, leg("h"), both}).tree() == "bh+abu+");
    CHECK(Row({leg("b"), leg("c"), less, leg("h"), both}).tree() == "bh+c-");
    CHECK(Row({leg("b"), leg("c"), leg("h"), op(Operator::difference, 3)}).tree() == "bh-c-");
}

TEST_CASE("half-spaces: xor and complements are cut as they are") {
    CHECK(Row({leg("a"), leg("b"), one_of, leg("h"), both}).tree() == "ab^h+");
    CHECK(Row({leg("a"), leg("c"), one_of, leg("h"), less}).tree() == "ac^h-");
    CHECK(Row({leg("b"), leg("c"), leg("h"), both, not_, both}).tree() == "b");
    CHECK(Row({leg("a"), leg("h"), one_of, leg("a"), both}).tree() == "ah^a+");
}

TEST_CASE("half-spaces: one ends with the model if all regions that use it do") {
    const std::vector<TreeNode> cut{leg("a"), leg("b"), either, leg("h"), both};
    const Row ends(cut);
    CHECK(is_finite(ends.reach("h")));
    CHECK(ends.reach("h").high.x < 10.1);
    CHECK(ends.reach("h").low.x < -1);
    const Row alone(cut, {region("ground", {leg("h")})});
    CHECK(!is_finite(alone.reach("h")));
    CHECK(alone.tree(0) == "abh+u");
    const Row two(cut, {solid("g", Half{{{0, 0, 1}, 0}}), region("wedge", {leg("h"), leg("g"), both})});
    CHECK(!is_finite(two.reach("h")));
    CHECK(two.tree(1) == "hg+");
    CHECK(Row({leg("a")}).clipped.trees.empty());
    CHECK(clip_by_half_spaces({}, {}, {}).trees.empty());
}

TEST_CASE("half-spaces: what was removed from what is gone is met near what is left") {
    const Row row({leg("c"), leg("b"), less, leg("d"), less, leg("h"), both, leg("a"), either});
    CHECK(row.tree() == "a");
    CHECK(!row.is_met("c"));
    CHECK(!row.is_met("d"));
    CHECK(row.is_met("b"));
}

TEST_CASE("half-spaces: a plate, which rays may meet outside its box, is cut wherever it is") {
    Bot plate{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}};
    plate.mode = Bot::Mode::plate;
    plate.thickness = {0.1};
    const Row row({leg("a"), leg("plate"), either, leg("h"), both}, {solid("plate", plate)});
    CHECK(row.tree() == "aplateh+u");
    CHECK(!is_finite(row.reach("h")));
}

TEST_CASE("half-spaces: a tree that would grow too much stays") {
    std::vector<TreeNode> nodes;
    for (int i = 0; i < 300; ++i) nodes.push_back(leg("b"));
    nodes.push_back(op(Operator::union_, 300));
    std::vector<Object> more;
    for (int i = 0; i < 20; ++i) {
        const std::string name = "h" + std::to_string(i);
        more.push_back(solid(name, Half{{{0, 1, 0}, 0.01 * i}}));
        nodes.push_back(leg(name));
    }
    nodes.push_back(op(Operator::difference, 21));
    const Row row(nodes, more);
    CHECK(row.clipped.trees[0].nodes.size() == row.flat.regions[0].tree.nodes.size());
}

TEST_CASE("a hierarchy without what half-spaces take away: all else stands in it, under the same numbers") {
    stress::Random random(5);
    for (int round = 0; round < 100; ++round) {
        std::vector<Box> boxes{whole_space}, ray_boxes{round % 2 ? whole_space : Box{{-2, -2, -2}, {0, 2, 2}}};
        const std::uint32_t count = 1 + random.below(40), rate = 1 + random.below(4);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3 at = random.in_cube();
            boxes.push_back({at, {at.x + 0.1, at.y + 0.1, at.z + 0.1}});
            ray_boxes.push_back(random.below(rate) == 0 ? boxes.back() : empty_box);
        }
        const NumberedSpace all = space_of(boxes, boxes), some = space_of(boxes, ray_boxes);
        CHECK(some.order == all.order);
        CHECK(some.space.radius == all.space.radius);
        CHECK(some.space.unbounded_count == (round % 2 ? 1u : 0u));
        const std::vector<bool> met = met_solids(some.space, boxes.size());
        const auto& nodes = some.space.nodes;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Box& box = ray_boxes[some.order[i]];
            if (is_empty(box)) continue;
            CHECK(met[i]);
            if (i < some.space.unbounded_count) continue;
            // Down from the root, by boxes that hold it.
            const Vec3& c = some.space.center;
            bool found = false;
            for (std::size_t n = 0; n < nodes.size() && !found;) {
                const kernel::BvhNode& node = nodes[n];
                const bool holds = node.low[0] <= box.low.x - c.x && node.high[0] >= box.high.x - c.x &&
                                   node.low[1] <= box.low.y - c.y && node.high[1] >= box.high.y - c.y;
                const std::uint32_t first = node.leaf >> BVH_LEAF_SHIFT;
                found = holds && node.leaf && i >= first && i < first + (node.leaf & BVH_LEAF_MASK);
                n = holds && !node.leaf ? n + 1 : node.skip;
            }
            CHECK(found);
        }
    }
}
