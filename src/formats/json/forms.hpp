// Forms that a solid may have in a scene file: its own, and the simpler ones that become it.
#pragma once

#include <tuple>
#include <utility>
#include <variant>

#include "formats/json/simple_solids.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

/// The structs whose forms become a shape S, the most particular first: the writer uses the first that fits.
template <class S>
struct JsonFormsOf {
    using Types = std::tuple<S>;
};
template <>
struct JsonFormsOf<Ell> {
    using Types = std::tuple<Sphere, Ell>;
};
template <>
struct JsonFormsOf<Tgc> {
    using Types = std::tuple<Cylinder, Cone, Tgc>;
};
template <>
struct JsonFormsOf<Arb> {
    using Types = std::tuple<UprightBox, Arb4, Arb5, Arb6, Arb7, Arb>;
};

template <class Shape>
struct JsonFormsOfAll;
template <class... S>
struct JsonFormsOfAll<std::variant<S...>> {
    using Types = decltype(std::tuple_cat(std::declval<typename JsonFormsOf<S>::Types>()...));
};

/// Calls `each` with a pointer, which is null, to every struct that has a form of a solid.
template <class Each>
void for_json_solids(Each each) {
    const auto call = [&]<class... S>(const std::tuple<S...>*) { (each(static_cast<const S*>(nullptr)), ...); };
    call(static_cast<const JsonFormsOfAll<Shape::variant>::Types*>(nullptr));
}

}  // namespace csgrt
