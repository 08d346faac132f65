// The operators of trees: their names, and the numbers of their operands.
#pragma once

#include <cstdint>
#include <string_view>

#include "form/names.hpp"

namespace csgrt {

/// An operator's name. Empty if `op` is not a valid value.
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
