// The operators of a tree: their names, and how many operands they take.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>

#include <csgrt/scene.hpp>

namespace csgrt {

inline constexpr std::pair<Operator, std::string_view> operator_names[] = {
    {Operator::union_, "union"},
    {Operator::intersection, "intersection"},
    {Operator::difference, "difference"},
    {Operator::xor_, "xor"},
    {Operator::not_, "not"},
    {Operator::leaf, "leaf"},
};

/// Empty for a value that is no operator.
constexpr std::string_view operator_name(Operator op) {
    for (const auto& [value, name] : operator_names) {
        if (value == op) return name;
    }
    return {};
}

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
