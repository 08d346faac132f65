// Terms, scanned, walked and by roles, against plain evaluation of the model's own tree, on random trees and covers.
#include <random>

#include "catch.hpp"
#include "compile/regions/flat_tree_value.hpp"
#include "compile/regions/linearize.hpp"
#include "compile/regions/terms.hpp"
#include "kernels/host_kernels.hpp"

using namespace csgrt;

namespace {

struct Random {
    std::mt19937 engine{11};
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine() % n); }
};

/// A random tree over solids 0 .. solids - 1, in postfix order, which holds no empty space.
void add_tree(FlatTree& tree, std::uint32_t leaves, std::uint32_t solids, Random& random) {
    if (leaves == 1) {
        tree.nodes.push_back({Operator::leaf, 0, random.below(solids)});
        return;
    }
    const std::uint32_t left = 1 + random.below(leaves - 1);
    add_tree(tree, left, solids, random);
    add_tree(tree, leaves - left, solids, random);
    constexpr Operator operators[] = {Operator::union_, Operator::intersection, Operator::difference,
                                      Operator::difference, Operator::xor_};
    tree.nodes.push_back({operators[random.below(5)], 2, 0});
}

}  // namespace

TEST_CASE("a term's value is its tree's, whether it is scanned, walked or told by roles", "[promise:booleans]") {
    Random random;
    std::size_t held = 0, not_held = 0, held_by_roles = 0, not_held_by_roles = 0;
    for (int round = 0; round < 400; ++round) {
        const std::uint32_t solids = 1 + random.below(60);
        FlatTree tree;
        add_tree(tree, 1 + random.below(round < 300 ? 30 : 900), solids, random);
        std::vector<std::uint32_t> words;
        linearize(tree, words);
        const auto end = static_cast<std::uint32_t>(words.size());
        const std::uint32_t roles = write_roles(words, 0, end);
        // Where each solid stands.
        std::vector<kernel::SolidRecord> records(solids);
        for (std::uint32_t s = 0; s < solids; ++s) {
            records[s].first_leaf = static_cast<std::uint32_t>(words.size());
            for (std::uint32_t i = 0; i < end; ++i)
                if (words[i] == (OP_LEAF << TREE_SHIFT | s)) words.push_back(i);
            records[s].leaf_count = static_cast<std::uint32_t>(words.size()) - records[s].first_leaf;
        }
        for (int shot = 0; shot < 20; ++shot) {
            // A segment of every solid; some cover the partition.
            std::vector<kernel::Boundary> boundaries(2 * solids);
            std::vector<std::uint32_t> bits(kernel::words_of(solids));
            std::vector<bool> covered(solids);
            for (std::uint32_t s = 0; s < solids; ++s) {
                boundaries[2 * s].solid = boundaries[2 * s + 1].solid = s;
                covered[s] = random.below(4) < static_cast<std::uint32_t>(shot) % 5;
                if (covered[s]) bits[s / 32] |= 1u << s % 32;
            }
            const kernel::cover cover{boundaries.data(), bits.data(), solids,      0, 0, 0,
                                      records.data(),    nullptr,     words.data()};
            kernel::covered_solids list;
            kernel::list_covered(cover, &list);
            const bool expected = test::value_of(tree, covered);
            REQUIRE(bool(kernel::scan_term(cover, &list, 0, end)) == expected);
            REQUIRE(bool(kernel::walk_term(cover, 0, end)) == expected);
            ++(expected ? held : not_held);
            if (list.count > FEW) continue;
            const std::uint32_t by_roles = kernel::ask_roles(words.data() + roles, &list);
            if (by_roles == ROLE_UNDECIDED) continue;
            REQUIRE(bool(by_roles) == expected);
            ++(expected ? held_by_roles : not_held_by_roles);
        }
    }
    CHECK(held > 500);
    CHECK(not_held > 500);
    CHECK(held_by_roles > 40);
    CHECK(not_held_by_roles > 500);
}

TEST_CASE("where a term begins to be true, its solids say that it may") {
    Random random;
    std::size_t began = 0, marked_once = 0;
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t solids = 1 + random.below(20);
        FlatTree tree;
        add_tree(tree, 1 + random.below(30), solids, random);
        std::vector<std::uint32_t> words;
        linearize(tree, words);
        std::vector<kernel::SolidRecord> records(solids);
        mark_begins(words, 0, static_cast<std::uint32_t>(words.size()), records);
        for (const kernel::SolidRecord& record : records)
            marked_once += record.begins == BEGINS_AT_ENTRY || record.begins == BEGINS_AT_EXIT;
        for (int shot = 0; shot < 40; ++shot) {
            std::vector<bool> covered(solids);
            for (std::uint32_t s = 0; s < solids; ++s) covered[s] = random.below(2);
            if (test::value_of(tree, covered)) continue;
            for (std::uint32_t s = 0; s < solids; ++s) {
                covered[s] = !covered[s];
                if (test::value_of(tree, covered)) {
                    REQUIRE(records[s].begins & (covered[s] ? BEGINS_AT_ENTRY : BEGINS_AT_EXIT));
                    ++began;
                }
                covered[s] = !covered[s];
            }
        }
    }
    CHECK(began > 1000);
    CHECK(marked_once > 300);
}

TEST_CASE("what claims where a solid alone covers is known, or said not to be") {
    Random random;
    std::size_t claimed = 0, unclaimed = 0, wanted_by_several = 0, unknown = 0;
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t solids = 1 + random.below(40);
        CompiledScene scene;
        std::vector<FlatTree> trees(1 + random.below(8));
        for (FlatTree& tree : trees) {
            add_tree(tree, 1 + random.below(20), solids, random);
            const LinearTree linear = linearize(tree, scene.trees);
            scene.regions.push_back({linear.first_word, linear.word_count});
        }
        const auto regions = static_cast<std::uint32_t>(trees.size());
        for (std::uint32_t& end : scene.rank_ends) end = regions;
        const std::uint32_t second = round % 2 == 1 ? random.below(regions + 1) : regions;
        const std::uint32_t third = second + random.below(regions - second + 1);
        scene.rank_ends[RANK_SOLID] = scene.rank_ends[RANK_PLATE] = second;
        scene.rank_ends[RANK_VOLUME] = third;
        const std::vector<kernel::SolidRecord> records = list_terms(scene, std::vector<bool>(solids));
        for (std::uint32_t s = 0; s < solids; ++s) {
            std::vector<bool> covered(solids);
            covered[s] = true;
            std::uint32_t expected = NONE;
            for (std::uint32_t region = 0; region < trees.size(); ++region) {
                if (!test::value_of(trees[region], covered)) continue;
                const auto rank = [&](std::uint32_t r) { return r < second ? 0 : r < third ? 1 : 2; };
                if (expected == NONE) {
                    expected = region;
                } else if (rank(expected & ~OVERLAP) == rank(region)) {
                    expected |= OVERLAP;
                }
            }
            const std::uint32_t alone = records[s].alone;
            if (alone == ALONE_UNKNOWN) {
                ++unknown;
                continue;
            }
            REQUIRE(alone == expected);
            ++(expected == NONE ? unclaimed : expected & OVERLAP ? wanted_by_several : claimed);
        }
    }
    CHECK(claimed > 300);
    CHECK(unclaimed > 300);
    CHECK(wanted_by_several > 100);
    CHECK(unknown < claimed + unclaimed);
}
