// Described solids: their numbers stand one after another in BRL-CAD's databases, in the order of their descriptions.
#pragma once

#include <functional>
#include <type_traits>

#include "formats/brlcad/values.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

/// Reads a solid. `vector` and `number` read the next value; their argument is BRL-CAD's name of it.
template <class S, class Vector, class Number>
S read_described(Vector vector, Number number) {
    S s;
    form::for_members(form::of<S>, [&](const auto& member) {
        auto& value = std::invoke(member.at, s);
        if constexpr (std::is_same_v<decltype(member.kind), form::Direction>) {
            value = unit_vector(vector(member.key.brlcad));
        } else if constexpr (std::is_same_v<decltype(value), Vec3&>) {
            value = vector(member.key.brlcad);
        } else {
            value = number(member.key.brlcad);
        }
    });
    return s;
}

}  // namespace csgrt
