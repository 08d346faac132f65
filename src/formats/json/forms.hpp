// Forms of solids in a scene file: a solid's own form, and simple forms that the reader turns into the solid.
#pragma once

#include <tuple>
#include <utility>
#include <variant>

#include "formats/json/simple_solids.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

/// The structs whose forms the reader turns into a shape S. The most special one comes first: the writer uses the first
/// one that fits.
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

/// Calls `each` for every struct with a solid's form. The argument is a null pointer of the struct's type.
template <class Each>
void for_json_solids(Each each) {
    const auto call = [&]<class... S>(const std::tuple<S...>*) { (each(static_cast<const S*>(nullptr)), ...); };
    call(static_cast<const JsonFormsOfAll<Shape::variant>::Types*>(nullptr));
}

}  // namespace csgrt
