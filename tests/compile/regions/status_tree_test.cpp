// Status trees against plain evaluation of the trees that they are made of, as solids come and go.
#include <algorithm>
#include <bit>
#include <random>

#include "catch.hpp"
#include "compile/regions/flat_tree_value.hpp"
#include "compile/regions/linearize.hpp"
#include "compile/regions/status_tree.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace csgrt::kernel {
#include "../kernels/boolean/status_tree.h"
}  // namespace csgrt::kernel

namespace {

/// std::mt19937's numbers, of 32 bits as a type, too.
struct Random {
    explicit Random(std::uint32_t seed) : engine(seed) {}
    std::uint32_t operator()() { return static_cast<std::uint32_t>(engine()); }
    std::mt19937 engine;
};

CompiledScene scene_of(const std::vector<FlatTree>& trees, std::uint32_t solids) {
    CompiledScene scene;
    scene.solids.resize(solids);
    for (const FlatTree& tree : trees) {
        const LinearTree linear = linearize(tree, scene.trees);
        scene.regions.push_back({linear.first_word, linear.word_count});
        scene.flat_trees.push_back(tree);
    }
    return scene;
}

constexpr Operator operators[] = {Operator::union_, Operator::intersection, Operator::difference, Operator::xor_};

FlatTree random_tree(Random& random, std::uint32_t leaves, std::uint32_t solids) {
    FlatTree tree;
    std::uint32_t open = 0;  // operands that no operator has taken
    for (std::uint32_t placed = 0; placed < leaves || open > 1;) {
        if (open > 1 && (placed == leaves || random() % 2)) {
            tree.nodes.push_back({operators[random() % 4], 2, 0});
            --open;
        } else {
            tree.nodes.push_back({Operator::leaf, 0, random() % solids});
            ++open, ++placed;
        }
    }
    return tree;
}

/// s0 op (s1 op (s2 ...)), or ((s0 op s1) op s2) ...; the operators take turns.
FlatTree comb(const std::vector<Operator>& ops, std::uint32_t leaves, bool to_the_right) {
    FlatTree tree;
    for (std::uint32_t i = 0; i < leaves; ++i) {
        tree.nodes.push_back({Operator::leaf, 0, i});
        if (!to_the_right && i > 0) tree.nodes.push_back({ops[i % ops.size()], 2, 0});
    }
    for (std::uint32_t i = leaves - 1; to_the_right && i > 0; --i)
        tree.nodes.push_back({ops[(i - 1) % ops.size()], 2, 0});
    return tree;
}

/// Solids' status, kept as kernels/3_deep_rays.cl keeps it.
struct Kept {
    explicit Kept(const CompiledScene& of)
        : scene(of), tree(make_status_tree(of)), functions(tree.outside), covers(of.solids.size()) {
        claimed.resize(kernel::words_of_set(regions()));
    }
    std::uint32_t regions() const { return static_cast<std::uint32_t>(scene.regions.size()); }
    void change(std::uint32_t solid) {
        covers[solid] = !covers[solid];
        for (std::uint32_t leaf = tree.first_leaves[solid]; leaf < tree.first_leaves[solid + 1]; ++leaf) {
            const std::uint32_t region = kernel::change_leaf(functions.data(), tree.links.data(),
                                                             tree.leaves[leaf] >> 2, tree.leaves[leaf] & 3u);
            if (region != NONE) kernel::toggle(claimed.data(), regions(), region);
        }
    }
    void require_right() const {
        std::uint32_t from = 0;
        for (std::uint32_t region = 0; region < regions(); ++region) {
            if (!test::value_of(scene.flat_trees[region], covers)) continue;
            REQUIRE(kernel::member_from(claimed.data(), regions(), from) == region);
            from = region + 1;
        }
        REQUIRE(kernel::member_from(claimed.data(), regions(), from) == NONE);
    }
    std::size_t longest_way() const {
        std::size_t longest = 0;
        for (const std::uint32_t leaf : tree.leaves) {
            std::size_t links = 1;
            for (std::uint32_t link = tree.links[leaf >> 3]; link >> TREE_SHIFT != REGION_LINK; ++links)
                link = tree.links[(link & TREE_MASK) >> 1];
            longest = std::max(longest, links);
        }
        return longest;
    }

    const CompiledScene& scene;
    StatusTree tree;
    std::vector<std::uint32_t> functions, claimed;
    std::vector<bool> covers;
};

}  // namespace

TEST_CASE("a status tree has the values of the regions' trees") {
    Random random(44);
    for (int round = 0; round < test::tries(300); ++round) {
        INFO("round " << round);
        const std::uint32_t solids = random() % 30 + 1, regions = random() % (round % 10 == 0 ? 2000 : 5) + 1;
        std::vector<FlatTree> trees;
        for (std::uint32_t i = 0; i < regions; ++i) trees.push_back(random_tree(random, random() % 12 + 1, solids));
        const CompiledScene scene = scene_of(trees, solids);
        Kept status(scene);
        status.require_right();
        for (int k = 0; k < 40; ++k) {
            status.change(random() % solids);
            status.require_right();
        }
        for (std::uint32_t solid = 0; solid < solids; ++solid)
            if (status.covers[solid]) status.change(solid);
        CHECK(status.functions == status.tree.outside);
    }
}

TEST_CASE("in a status tree the way to the region is short, however deep the region's tree is") {
    Random random(45);
    constexpr std::uint32_t leaves = 3000;
    const std::vector<std::vector<Operator>> chains = {{Operator::union_},
                                                       {Operator::xor_},
                                                       {Operator::difference},
                                                       {Operator::intersection, Operator::union_},
                                                       {Operator::difference, Operator::union_},
                                                       {Operator::xor_, Operator::difference, Operator::union_}};
    for (const auto& chain : chains) {
        for (const bool to_the_right : {false, true}) {
            const CompiledScene scene = scene_of({comb(chain, leaves, to_the_right)}, leaves);
            Kept status(scene);
            CHECK(status.longest_way() <= 2 * std::bit_width(leaves) + 2);
            for (std::uint32_t i = 0; i < leaves; ++i) {  // as the balls of an onion are entered, from outside
                status.change(to_the_right ? i : leaves - 1 - i);
                if (i % 100 < 3) status.require_right();
            }
            for (int k = 0; k < test::tries(300); ++k) {
                status.change(random() % leaves);
                status.require_right();
            }
        }
    }
}

TEST_CASE("the set of regions gives its members in order") {
    Random random(46);
    for (const std::uint32_t regions : {1u, 2u, 31u, 32u, 33u, 1024u, 1025u, 40'000u}) {
        std::vector<std::uint32_t> set(kernel::words_of_set(regions));
        std::vector<bool> is_member(regions);
        for (int k = 0; k < test::tries(2000); ++k) {
            const std::uint32_t region = random() % (k % 2 ? regions : std::min(regions, 70u)),
                                from = random() % regions;
            kernel::toggle(set.data(), regions, region);
            is_member[region] = !is_member[region];
            const auto next = std::find(is_member.begin() + from, is_member.end(), true);
            REQUIRE(kernel::member_from(set.data(), regions, from) ==
                    (next == is_member.end() ? NONE : static_cast<std::uint32_t>(next - is_member.begin())));
        }
        for (std::uint32_t region = 0; region < regions; ++region)
            if (is_member[region]) kernel::toggle(set.data(), regions, region);
        CHECK(std::count(set.begin(), set.end(), 0u) == static_cast<std::ptrdiff_t>(set.size()));
        CHECK(kernel::member_from(set.data(), regions, 0) == NONE);
    }
}
