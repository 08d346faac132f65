// Depths as a buffer keeps them, and normal forms.
#include <numeric>
#include <set>

#include "bench/methods/depth_buffer.hpp"
#include "bench/methods/list.hpp"
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

TEST_CASE("exact depths are kept as they are, and in order") {
    const DepthScale scale(100, 300, DepthScale::exact);
    const std::vector<double> ascending = {-HUGE_VAL, -3, -1e-300, 0, 1e-300, 0.1, std::nextafter(0.1, 1), 5, HUGE_VAL};
    for (std::size_t i = 0; i < ascending.size(); ++i) {
        CHECK(scale.depth(scale.kept(ascending[i])) == ascending[i]);
        if (i > 0) CHECK(scale.kept(ascending[i - 1]) < scale.kept(ascending[i]));
    }
    CHECK(scale.kept(-0.0) == scale.kept(0.0));
    CHECK(scale.depth(scale.kept(5) + 1) == std::nextafter(5.0, 6.0));
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

TEST_CASE("Goldfeather's rules make a sum of products that is true where the tree is") {
    using test::both, test::either, test::leg, test::less, test::one_of;
    struct Case {
        std::vector<TreeNode> nodes;
        std::uint64_t rules, products;
    };
    const std::vector<Case> cases = {
        {{leg("a"), leg("b"), leg("c"), leg("d"), either, less, less}, 2, 3},    // 5, then 2
        {{leg("a"), leg("b"), either, leg("c"), leg("d"), either, both}, 3, 4},  // 2, then 9 twice
        {{leg("a"), leg("b"), leg("c"), both, leg("d"), less, less}, 2, 3},      // 5, then 3
        {{leg("a"), leg("b"), less, leg("c"), leg("d"), less, both}, 2, 1},      // 6, then 7
        {{leg("a"), leg("b"), either, leg("c"), less, leg("d"), less}, 2, 2},    // 8 twice
        {{leg("a"), leg("b"), either, leg("c"), leg("d"), one_of, both}, 7, 4},  // 2, then 6, 9 and 8 twice
    };
    for (const Case& one : cases) {
        const Four four(one.nodes);
        const GeneralTree tree = general_form(four.scene.flat_trees[0], false);
        REQUIRE_FALSE(tree.root.complement);
        std::vector<Product> sum;
        const std::optional<std::uint64_t> rules = rewrite(tree, [&](const Product& p) { sum.push_back(p); });
        REQUIRE(rules);
        CHECK(*rules == one.rules);
        CHECK(sum.size() == one.products);
        const RegionTrees regions(four.scene, false);
        LiveTrees live(regions);
        std::vector<std::uint32_t> solids(four.scene.solids.size());
        std::iota(solids.begin(), solids.end(), 0u);
        live.build(solids);
        std::set<bool> seen;
        for (unsigned bits = 0; bits < 1u << four.scene.solids.size(); ++bits) {
            const auto is_in = [&](std::uint32_t solid) { return (bits >> solid & 1) != 0; };
            const bool any = std::any_of(sum.begin(), sum.end(), [&](const Product& product) {
                return std::all_of(product.begin(), product.end(),
                                   [&](std::uint32_t literal) { return is_in(literal >> 1) != ((literal & 1) != 0); });
            });
            REQUIRE(any == value(live, live.roots()[0].operand, bits));
            seen.insert(any);
        }
        CHECK(seen.size() == 2);
    }
}

TEST_CASE("where regions touch, Blister takes the first surface that is drawn, on one of the two ways through") {
    const Scene scene = test::scene({test::block("a", {0, 0, 0}, {1, 1, 1}), test::block("b", {1, 0, 0}, {2, 1, 1}),
                                     test::region("r", {test::leg("a")}), test::region("s", {test::leg("b")})});
    const CompiledScene compiled = compile(scene);
    const std::vector<std::string> objects;
    std::set<double> shares;
    for (const double way : {1.0, -1.0}) {
        TraceOptions options;
        options.knob = DepthScale::exact;
        const auto tracer = depth_buffer().prepare({scene, objects, compiled}, options);
        CHECK(tracer->trace({{{1 - 9 * way, 0.5, 0.25}, {way, 0, 0}}})[0].stretches.size() == 2);
        CHECK(tracer->figures().at("bits a label") <= 1);
        shares.insert(tracer->figures().at("wrong owner, share of stretches"));
    }
    CHECK(shares == std::set<double>{0, 0.5});
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
