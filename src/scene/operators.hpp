// The operators of a tree: how they are called, and how many operands they take.
#pragma once

#include <cstdint>
#include <string_view>

#include "form/names.hpp"

namespace csgrt {

/// Empty for a value that is no operator.
constexpr std::string_view operator_name(Operator op) { return name_of(operator_names, op); }

constexpr bool takes(Operator op, std::uint64_t arity) {
    switch (op) {
        case Operator::leaf:
            return arity == 0;
        case Operator::difference:
            return arity >= 2;
        case Operator::not_:
            return arity == 1;
        default:
            return arity >= 1;
    }
}

}  // namespace csgrt
