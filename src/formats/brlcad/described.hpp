// Described solids: solids whose numbers BRL-CAD's databases hold in a row, in the order of the solid's description.
#pragma once

#include <functional>
#include <type_traits>

#include "formats/brlcad/values.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

/// Reads a solid. `vector` and `number` read the next value; their argument is BRL-CAD's name of the value.
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
