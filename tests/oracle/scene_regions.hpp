// Boolean expressions over solids, in three values: inside, outside, or within the solids' doubt.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt::oracle {

enum class Membership : std::uint8_t { outside, unsure, inside };

inline Membership both(Membership a, Membership b) { return a < b ? a : b; }
inline Membership either(Membership a, Membership b) { return a < b ? b : a; }
inline Membership opposite(Membership a) { return static_cast<Membership>(2 - static_cast<int>(a)); }
inline Membership one_of(Membership a, Membership b) { return either(both(a, opposite(b)), both(opposite(a), b)); }

/// A Boolean expression over solids.
struct Expression {
    Operator op = Operator::union_;  ///< a union of nothing is the empty set
    std::vector<Expression> operands;
    std::size_t solid = 0;  ///< leaf: index into the oracle's solids

    /// In any of the solids?
    template <class Of>
    Membership any(const Of& of) const {
        if (op == Operator::leaf) return of(solid);
        Membership value = Membership::outside;
        for (const Expression& operand : operands) value = either(value, operand.any(of));
        return value;
    }
    template <class Call>
    void each(const Call& call) const {
        if (op == Operator::leaf) call(solid);
        for (const Expression& operand : operands) operand.each(call);
    }
    /// `of(solid)` is the membership of a solid.
    template <class Of>
    Membership evaluate(const Of& of) const {
        if (op == Operator::leaf) return of(solid);
        if (operands.empty()) return Membership::outside;
        Membership value = operands.front().evaluate(of);
        if (op == Operator::not_) return opposite(value);
        for (std::size_t i = 1; i < operands.size(); ++i) {
            const Membership next = operands[i].evaluate(of);
            switch (op) {
                case Operator::intersection:
                    value = both(value, next);
                    break;
                case Operator::difference:
                    value = both(value, opposite(next));
                    break;
                case Operator::xor_:
                    value = one_of(value, next);
                    break;
                default:
                    value = either(value, next);
            }
        }
        return value;
    }
};

struct OracleRegion {
    std::string path;
    Expression tree;
    int rank = 0;  ///< what is of a later rank yields: 0 a solid, 1 a plate of FASTGEN, 2 a volume of it, 3 air

    template <class Of>
    Membership evaluate(const Of& of) const {
        const Membership value = tree.evaluate(of);
        return value == Membership::outside ? value : both(value, tree.any(of));
    }
};

}  // namespace csgrt::oracle
