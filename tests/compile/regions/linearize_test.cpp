// The words against the trees they stand for, and the stack that a walk really needs.
#include <algorithm>
#include <random>

#include "catch.hpp"
#include "compile/regions/flat_tree_value.hpp"
#include "compile/regions/linearize.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

using Values = std::vector<bool>;  // one a solid

/// The kernels' walk.
struct Walk {
    const std::vector<std::uint32_t>& trees;
    std::size_t deepest = 0;

    bool operator()(std::uint32_t first, const Values& values) {
        struct Entry {
            std::uint32_t node;
            bool negate;
        };
        std::vector<Entry> stack;
        std::uint32_t i = first;
        bool negate = false;
        for (;;) {
            const std::uint32_t word = trees[i], op = word >> TREE_SHIFT;
            if (op != OP_LEAF) {
                stack.push_back({i, negate});
                deepest = std::max(deepest, stack.size());
                negate = false;
                ++i;
                continue;
            }
            bool value = values[word & TREE_MASK] != negate;
            bool to_right = false;
            while (!stack.empty() && !to_right) {
                const Entry entry = stack.back();
                stack.pop_back();
                const std::uint32_t parent = trees[entry.node];
                to_right = true;
                bool right_negate = entry.negate;
                switch (parent >> TREE_SHIFT) {
                    case OP_UNION:
                        if (value) {
                            value = !entry.negate;
                            to_right = false;
                        }
                        break;
                    case OP_INTERSECTION:
                    case OP_DIFFERENCE:
                        if (!value) {
                            value = entry.negate;
                            to_right = false;
                        }
                        if (parent >> TREE_SHIFT == OP_DIFFERENCE) right_negate = !entry.negate;
                        break;
                    case OP_REVERSE_DIFFERENCE:
                        if (value) {
                            value = entry.negate;
                            to_right = false;
                        }
                        break;
                    default:
                        right_negate = entry.negate != value;
                        break;
                }
                if (to_right) {
                    i = parent & TREE_MASK;
                    negate = right_negate;
                }
            }
            if (!to_right) return value;
        }
    }
};

struct Random {
    std::mt19937 engine;
    explicit Random(unsigned seed) : engine(seed) {}
    std::uint32_t below(std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(engine); }
};

void add_leaf(FlatTree& tree, std::uint32_t solid) { tree.nodes.push_back({Operator::leaf, 0, solid}); }
void add_op(FlatTree& tree, Operator op, std::uint32_t arity) { tree.nodes.push_back({op, arity, 0}); }

/// `leaves` leaves over solids 0..solids-1, combined at random until one operand is left.
FlatTree random_tree(Random& random, std::uint32_t leaves, std::uint32_t solids) {
    FlatTree tree;
    std::uint32_t open = 0;
    while (leaves > 0 || open > 1) {
        if (leaves > 0 && (open == 0 || random.below(2) == 0)) {
            add_leaf(tree, random.below(solids));
            --leaves;
            ++open;
        } else if (open == 1) {
            if (random.below(4) == 0) add_op(tree, Operator::not_, 1);
            if (leaves == 0) break;
            add_leaf(tree, random.below(solids));
            --leaves;
            ++open;
        } else {
            const std::uint32_t arity = 2 + random.below(std::min(open - 1, 3u));
            const Operator ops[] = {Operator::union_, Operator::intersection, Operator::difference, Operator::xor_};
            add_op(tree, ops[random.below(4)], arity);
            open -= arity - 1;
            if (random.below(5) == 0) add_op(tree, Operator::not_, 1);
        }
    }
    return tree;
}

FlatTree complement(FlatTree tree) {
    add_op(tree, Operator::not_, 1);
    return tree;
}

std::size_t leaves_of(const FlatTree& tree) {
    return static_cast<std::size_t>(
        std::count_if(tree.nodes.begin(), tree.nodes.end(), [](const auto& n) { return n.op == Operator::leaf; }));
}

/// Every assignment, and a few rounds of words in one vector as in a scene.
void check_all_assignments(const FlatTree& tree, std::uint32_t solids) {
    std::vector<std::uint32_t> words(7, 0xffffffffu);  // positions are absolute
    const LinearTree linear = linearize(tree, words);
    CHECK(linear.first_word == 7);
    REQUIRE(linear.first_word + linear.word_count == words.size());
    REQUIRE(linear.word_count == 2 * leaves_of(tree) - 1);
    Walk walk{words};
    for (std::uint32_t bits = 0; bits < 1u << solids; ++bits) {
        Values values(solids);
        for (std::uint32_t i = 0; i < solids; ++i) values[i] = bits >> i & 1u;
        REQUIRE(walk(linear.first_word, values) == test::value_of(tree, values));
    }
    CHECK(walk.deepest <= linear.stack);
    CHECK(std::all_of(words.begin() + linear.first_word, words.end(),
                      [](std::uint32_t word) { return word >> TREE_SHIFT <= OP_REVERSE_DIFFERENCE; }));
}

/// A chain x0 op x1 op x2 ... of `count` operators; `right` nests it the other way.
FlatTree chain(std::uint32_t count, const std::vector<Operator>& ops, bool right) {
    FlatTree tree;
    if (right) {
        for (std::uint32_t i = 0; i <= count; ++i) add_leaf(tree, i);
        for (std::uint32_t i = 0; i < count; ++i) add_op(tree, ops[i % ops.size()], 2);
    } else {
        add_leaf(tree, 0);
        for (std::uint32_t i = 0; i < count; ++i) {
            add_leaf(tree, i + 1);
            add_op(tree, ops[i % ops.size()], 2);
        }
    }
    return tree;
}

}  // namespace

TEST_CASE("one leaf is one word") {
    FlatTree tree;
    add_leaf(tree, 5);
    std::vector<std::uint32_t> words;
    const LinearTree linear = linearize(tree, words);
    CHECK(words == std::vector<std::uint32_t>{5});
    CHECK(linear.stack == 0);
}

TEST_CASE("a - b - c is read from a on, whose absence says all") {
    FlatTree tree;
    for (std::uint32_t i = 0; i < 3; ++i) add_leaf(tree, i);
    add_op(tree, Operator::difference, 3);
    std::vector<std::uint32_t> words;
    const LinearTree linear = linearize(tree, words);
    const std::vector<std::uint32_t> expected{OP_DIFFERENCE << TREE_SHIFT | 2u, 0, OP_UNION << TREE_SHIFT | 4u, 1, 2};
    CHECK(words == expected);
    CHECK(linear.stack == 1);
}

TEST_CASE("unions of unions are unions of solids, and so are complements that cancel") {
    const auto is_union = [](std::uint32_t word) { return word >> TREE_SHIFT <= OP_UNION; };
    FlatTree tree;
    for (std::uint32_t i = 0; i < 3; ++i) add_leaf(tree, i);
    add_op(tree, Operator::union_, 2);
    add_op(tree, Operator::union_, 2);
    std::vector<std::uint32_t> words;
    linearize(tree, words);
    FlatTree cancelled;  // !(!a + !b) = a u b
    for (std::uint32_t i = 0; i < 2; ++i) {
        add_leaf(cancelled, i);
        add_op(cancelled, Operator::not_, 1);
    }
    add_op(cancelled, Operator::intersection, 2);
    linearize(complement(cancelled), words);
    CHECK(words.size() == 8);
    CHECK(std::all_of(words.begin(), words.end(), is_union));
}

TEST_CASE("random trees: the walk over the words gives what the tree gives, for every assignment",
          "[promise:booleans]") {
    Random random(1);
    int complements = 0;
    constexpr int rounds = test::tries(3000);
    for (int round = 0; round < rounds; ++round) {
        const std::uint32_t solids = 1 + random.below(round % 100 == 0 ? 12 : 6);
        FlatTree tree = random_tree(random, 1 + random.below(12), solids);
        const bool outside = test::value_of(tree, Values(solids, false));
        if (outside) {
            ++complements;
            tree = complement(std::move(tree));
        }
        check_all_assignments(tree, solids);
    }
    CHECK(complements > rounds / 10);
    CHECK(complements < rounds / 10 * 9);
}

TEST_CASE("chains of 100,000 need a stack of one or two, however they are nested") {
    constexpr std::uint32_t count = test::tries(100'000);
    using enum Operator;
    const std::vector<std::vector<Operator>> mixes = {{union_},
                                                      {intersection},
                                                      {difference},
                                                      {xor_},
                                                      {difference, union_},
                                                      {difference, intersection},
                                                      {union_, intersection, difference, xor_}};
    Random random(2);
    for (const auto& mix : mixes) {
        for (const bool right : {false, true}) {
            const FlatTree tree = chain(count, mix, right);
            std::vector<std::uint32_t> words;
            const LinearTree linear = linearize(tree, words);
            CHECK(words.size() == 2 * count + 1);
            CHECK(linear.stack <= 17);  // log2 of the leaves
            Walk walk{words};
            for (int round = 0; round < 8; ++round) {
                Values values(count + 1);
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = random.below(round < 4 ? 2 : 1000) == 0;
                if (round == 7) values.assign(count + 1, true);
                // Nested to the right, plain evaluation of the postfix order needs a deep operand stack, no recursion.
                REQUIRE(walk(0, values) == test::value_of(tree, values));
            }
            CHECK(walk.deepest == linear.stack);
        }
    }
}

TEST_CASE("the recorded stack is what some ray needs, and at most log2 of the leaves") {
    Random random(3);
    std::uint32_t deepest = 0;
    for (int round = 0; round < test::tries(300); ++round) {
        const std::uint32_t leaves = 1 + random.below(400);
        FlatTree tree = random_tree(random, leaves, leaves);
        if (test::value_of(tree, Values(leaves, false))) tree = complement(std::move(tree));
        std::vector<std::uint32_t> words;
        const LinearTree linear = linearize(tree, words);
        REQUIRE(1u << linear.stack <= leaves);
        deepest = std::max(deepest, linear.stack);
        // The way down to each leaf: a left child costs an entry until its right sibling is entered.
        std::vector<std::uint32_t> entries(words.size(), 0);
        std::uint32_t most = 0;
        for (std::uint32_t i = 0; i < words.size(); ++i) {
            most = std::max(most, entries[i]);
            if (words[i] >> TREE_SHIFT == OP_LEAF) continue;
            REQUIRE((words[i] & TREE_MASK) > i + 1);
            entries[i + 1] = entries[i] + 1;
            entries[words[i] & TREE_MASK] = entries[i];
        }
        CHECK(linear.stack == most);
    }
    CHECK(deepest >= 2);
}

TEST_CASE("perfectly balanced alternating trees are the worst: log2 of the leaves") {
    FlatTree tree;
    const std::uint32_t levels = 12;
    std::vector<std::uint32_t> pending;  // heights of finished subtrees
    for (std::uint32_t leaf = 0; leaf < 1u << levels; ++leaf) {
        add_leaf(tree, leaf);
        pending.push_back(0);
        while (pending.size() > 1 && pending[pending.size() - 1] == pending[pending.size() - 2]) {
            const std::uint32_t height = pending.back() + 1;
            pending.resize(pending.size() - 2);
            pending.push_back(height);
            add_op(tree, height % 2 == 0 ? Operator::union_ : Operator::intersection, 2);
        }
    }
    std::vector<std::uint32_t> words;
    CHECK(linearize(tree, words).stack == levels);
}
