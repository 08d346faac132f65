// Depths as a buffer keeps them, and normal forms.
#include <set>

#include "bench/methods/depth_buffer.hpp"
#include "bench/methods/region_trees.hpp"
#include "catch.hpp"
#include "compile/model.hpp"

using namespace csgrt;
using namespace csgrt::bench;

TEST_CASE("a depth is kept to half a step of the buffer, and in order") {
    for (const unsigned bits : {16u, 24u, 32u}) {
        const DepthScale scale(100, 300, bits);
        const double step = 200 / (std::ldexp(1.0, static_cast<int>(bits)) - 1);
        CHECK(scale.kept(100) == 0);
        CHECK(scale.kept(-5) == 0);
        CHECK(scale.kept(300) == (std::uint64_t{1} << bits) - 1);
        for (double depth = 100; depth < 300; depth += 0.37) {
            REQUIRE(std::abs(scale.depth(scale.kept(depth)) - depth) <= 0.5 * step * 1.000001 + 1e-12);
            REQUIRE(scale.kept(depth + 1.01 * step) > scale.kept(depth));
            REQUIRE(scale.kept(scale.depth(scale.kept(depth)) + 0.4 * step) == scale.kept(depth));
        }
    }
}

namespace {

/// A region of four balls, all of which a ray may meet.
struct Four {
    CompiledScene scene;
    explicit Four(std::vector<TreeNode> nodes) {
        Scene model;
        for (const char* name : {"a", "b", "c", "d"}) model.objects.emplace_back(test::ball(name));
        model.objects.emplace_back(test::region("r", std::move(nodes)));
        scene = compile(model);
    }
};

bool value(const LiveTrees& live, Operand operand, unsigned bits) {
    if (operand >= EMPTY_SET) return operand == FULL_SET;
    const LiveTrees::Node& node = live.nodes()[operand >> 1];
    const bool complemented = operand & 1;
    if (node.gate == Gate::leaf) return ((bits >> node.solid & 1) != 0) != complemented;
    const bool a = value(live, node.left, bits), b = value(live, node.right, bits);
    return (node.gate == Gate::union_ ? a || b : node.gate == Gate::intersection ? a && b : a != b) != complemented;
}

}  // namespace

TEST_CASE("a tree's sum of products is true where the tree is") {
    using test::both, test::either, test::leg, test::less, test::one_of;
    const std::vector<std::vector<TreeNode>> trees = {
        {leg("a"), leg("b"), leg("c"), less, leg("d"), either, both},
        {leg("a"), leg("b"), either, leg("c"), leg("d"), less, less},
        {leg("a"), leg("b"), one_of, leg("c"), one_of, leg("d"), less},
        {leg("a"), leg("b"), leg("a"), one_of, leg("c"), both, leg("d"), either, less},
    };
    for (const auto& nodes : trees) {
        const Four four(nodes);
        const RegionTrees regions(four.scene, false);
        LiveTrees live(regions);
        std::vector<std::uint32_t> solids;
        for (std::uint32_t i = 0; i < four.scene.solids.size(); ++i) solids.push_back(i);
        live.build(solids);
        REQUIRE(live.roots().size() == 1);
        std::vector<Product> sum;
        REQUIRE(normalize(live.nodes(), live.roots()[0], 1000, sum));
        std::set<bool> seen;
        for (unsigned bits = 0; bits < 1u << solids.size(); ++bits) {
            bool any = false;
            for (const Product& product : sum) {
                bool all = true;
                for (const std::uint32_t literal : product)
                    all = all && ((bits >> (literal >> 1) & 1) != 0) != ((literal & 1) != 0);
                any = any || all;
            }
            REQUIRE(any == value(live, live.roots()[0].operand, bits));
            seen.insert(any);
        }
        CHECK(seen.size() == 2);
        CHECK_FALSE(normalize(live.nodes(), live.roots()[0], 3, sum));
    }
}

TEST_CASE("what is alive of a tree is true where the whole tree is, as long as the rest is empty") {
    using test::both, test::either, test::leg, test::less, test::one_of;
    const Four four({leg("a"), leg("b"), one_of, leg("c"), both, leg("d"), less});
    const RegionTrees regions(four.scene, false);
    LiveTrees whole(regions), live(regions);
    const auto count = static_cast<std::uint32_t>(four.scene.solids.size());
    std::vector<std::uint32_t> all, some;
    for (std::uint32_t i = 0; i < count; ++i) all.push_back(i);
    whole.build(all);
    for (unsigned mask = 0; mask < 1u << count; ++mask) {
        some.clear();
        for (std::uint32_t i = 0; i < count; ++i)
            if (mask >> i & 1) some.push_back(i);
        live.build(some);
        for (unsigned bits = 0; bits < 1u << some.size(); ++bits) {
            unsigned spread = 0;
            for (std::size_t i = 0; i < some.size(); ++i) spread |= (bits >> i & 1) << some[i];
            const bool is = !live.roots().empty() && value(live, live.roots()[0].operand, bits);
            REQUIRE(is == value(whole, whole.roots()[0].operand, spread));
        }
    }
}
