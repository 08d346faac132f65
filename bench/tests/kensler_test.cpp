// Kensler's table against the truth: what the operands are on both sides of the surfaces says what the node is.
#include <cmath>

#include "bench/methods/kensler.hpp"
#include "catch.hpp"

using namespace csgrt::bench;
using namespace csgrt::bench::kensler_table;

namespace {

bool value(Gate gate, bool a, bool b) {
    return gate == Gate::union_ ? a || b : gate == Gate::intersection ? a && b : a != b;
}

}  // namespace

TEST_CASE("Kensler's table takes a surface where the node changes there, and passes one where it does not") {
    for (const Gate gate : {Gate::union_, Gate::intersection, Gate::xor_})
        for (const Next a : {Next::enter, Next::exit, Next::miss})
            for (const Next b : {Next::enter, Next::exit, Next::miss})
                for (const bool a_first : {true, false}) {
                    const double a_at = a == Next::miss ? HUGE_VAL : a_first ? 1 : 2;
                    const double b_at = b == Next::miss ? HUGE_VAL : a_first ? 2 : 1;
                    CAPTURE(static_cast<int>(gate), static_cast<int>(a), static_cast<int>(b), a_first);
                    const bool in_a = a == Next::exit, in_b = b == Next::exit, before = value(gate, in_a, in_b);
                    const Action does = action(gate, a, a_at, b, b_at);
                    if (a == Next::miss && b == Next::miss) {
                        CHECK(does == Action::miss);
                        continue;
                    }
                    const bool at_a = a_at < b_at;  // the nearer of the two
                    const bool behind = value(gate, in_a != at_a, in_b == at_a);
                    switch (does) {
                        case Action::miss:  // an intersection with what is not met any more
                            CHECK((gate == Gate::intersection && (a == Next::miss || b == Next::miss)));
                            break;
                        case Action::pass_a:
                        case Action::pass_b:
                            CHECK((does == Action::pass_a) == at_a);
                            CHECK(behind == before);
                            break;
                        default: {
                            const bool is_a = does == Action::take_a || does == Action::take_a_flipped;
                            const bool flipped = does == Action::take_a_flipped || does == Action::take_b_flipped;
                            CHECK(is_a == at_a);
                            CHECK(behind != before);
                            CHECK(((is_a ? a : b) == Next::enter) == (behind != flipped));
                        }
                    }
                }
}

TEST_CASE("where two operands touch, their union goes on and their intersection is empty") {
    CHECK(action(Gate::union_, Next::exit, 5, Next::enter, 5) == Action::pass_b);
    CHECK(action(Gate::union_, Next::enter, 5, Next::exit, 5) == Action::pass_a);
    CHECK(action(Gate::intersection, Next::exit, 5, Next::enter, 5) == Action::pass_a);
    CHECK(action(Gate::intersection, Next::enter, 5, Next::exit, 5) == Action::pass_b);
    // An operand that never ends: nothing of the other matters.
    CHECK(action(Gate::union_, Next::exit, HUGE_VAL, Next::exit, 5) == Action::take_a);
}
