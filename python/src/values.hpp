// Points, boxes and arrays between C++ and Python.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/csgrt.hpp>
#include <form/answers.hpp>
#include <form/check.hpp>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;

namespace nanobind::detail {

/// Any sequence of three numbers; a tuple in Python.
template <>
struct type_caster<csgrt::Vec3> {
    using Numbers = make_caster<std::array<double, 3>>;
    NB_TYPE_CASTER(csgrt::Vec3, io_name("csgrt._values.ThreeNumbers", "tuple[float, float, float]"))
    bool from_python(handle from, std::uint32_t flags, cleanup_list* cleanup) noexcept {
        Numbers numbers;
        if (!numbers.from_python(from, flags, cleanup)) return false;
        value = {numbers.value[0], numbers.value[1], numbers.value[2]};
        return true;
    }
    static handle from_cpp(const csgrt::Vec3& v, rv_policy, cleanup_list*) noexcept {
        return Py_BuildValue("(ddd)", v.x, v.y, v.z);
    }
};

/// Any pair of points: low, high.
template <>
struct type_caster<csgrt::Box> {
    using Points = make_caster<std::pair<csgrt::Vec3, csgrt::Vec3>>;
    NB_TYPE_CASTER(csgrt::Box, io_name("csgrt._values.TwoPoints", "csgrt._values.Bounds"))
    bool from_python(handle from, std::uint32_t flags, cleanup_list* cleanup) noexcept {
        Points points;
        if (!points.from_python(from, flags, cleanup)) return false;
        const auto [low, high] = static_cast<std::pair<csgrt::Vec3, csgrt::Vec3>>(points);
        value = {low, high};
        return true;
    }
    static handle from_cpp(const csgrt::Box& box, rv_policy policy, cleanup_list* cleanup) noexcept {
        return Points::from_cpp(std::pair(box.low, box.high), policy, cleanup);
    }
};

}  // namespace nanobind::detail

namespace csgrt::python {

/// Rays, ranges and points as Python gives them: read in place.
using Doubles = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using Matrices = nb::ndarray<const double, nb::shape<4, 4>, nb::c_contig, nb::device::cpu>;
using Shape = std::vector<std::size_t>;

/// Answers. The names are those of types in the stub.
template <class T>
using Numpy = nb::ndarray<nb::numpy, T>;
using Row = nb::typed<nb::tuple, nb::any, nb::ellipsis>;
using Rows = nb::typed<nb::list, Row>;

/// The elements of an array whose last axis is one element: rays, ranges, points.
template <class T>
std::span<const T> list_of(const Doubles& array) {
    static_assert(sizeof(T) % sizeof(double) == 0 && alignof(T) == alignof(double));
    return {reinterpret_cast<const T*>(array.data()), array.size() / (sizeof(T) / sizeof(double))};
}

/// The shape of such an array without its last axis.
inline Shape leading(const Doubles& array) {
    Shape shape;
    for (std::size_t i = 0; i + 1 < array.ndim(); ++i) shape.push_back(array.shape(i));
    return shape;
}

/// What keeps an answer as long as arrays show its memory.
template <class Answer>
nb::capsule keeper(std::unique_ptr<Answer>& answer) {
    nb::capsule kept(answer.get(), [](void* held) noexcept { delete static_cast<Answer*>(held); });
    static_cast<void>(answer.release());
    return kept;
}

/// A numpy array that shows `data`, which `kept` keeps. Points have an axis of their own.
template <class T>
auto array(T* data, Shape shape, nb::handle kept) {
    if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Ray>) {
        shape.push_back(sizeof(T) / sizeof(double));
        return array(reinterpret_cast<double*>(data), std::move(shape), kept);
    } else {
        return Numpy<T>(data, shape.size(), shape.data(), kept);
    }
}
template <class T>
auto array(Array<T>& values, nb::handle kept) {
    return array(values.data(), {values.size()}, kept);
}

/// The value of that name. Throws refusal(sentence) if there is none.
template <class Names, class Refusal>
auto value_of(const Names& names, const std::string& what, const std::string& given, const Refusal& refusal) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (given == name) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw refusal(what + " is one of " + known + ", not " + given);
}

/// The type of a string that is one of these names, in the stub.
template <class Names>
std::string literal(const Names& names) {
    std::string text;
    for (const auto& [name, value] : names) text += (text.empty() ? "'" : ", '") + std::string(name) + "'";
    return "typing.Literal[" + text + "]";
}

/// What Python's class of a described struct has: its members in their order, names in place of enumerations.
template <class S, class... First>
nb::object row_of(const S& s, const First&... first) {
    nb::list row;
    (row.append(first), ...);
    form::for_members(form::of<S>, [&](const auto& member) {
        const auto& value = s.*member.at;
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_enum_v<Value>)
            row.append(std::string(name_of(*member.kind.names, value)));
        else if constexpr (std::is_same_v<Value, Ray>)
            row.append(row_of(value));
        else if constexpr (std::is_same_v<Value, Estimate>)
            row.append(nb::make_tuple(value.value, value.half_width));
        else if constexpr (std::is_same_v<Value, std::array<std::uint32_t, 2>>)
            row.append(nb::make_tuple(value[0], value[1]));
        else if constexpr (!std::is_same_v<Value, Finish>)
            row.append(value);
    });
    return nb::tuple(row);
}

/// What the members of a described struct mean, by their names.
template <class S>
nb::dict sentences() {
    nb::dict all;
    form::for_members(form::of<S>, [&](const auto& member) {
        if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(member.kind)>, form::Special>)
            all[std::string(member.key.member).c_str()] = member.help;
    });
    return all;
}

nb::tuple place_row(const Place& place);  ///< the members of csgrt.Place
void bind_settings(nb::module_& module);  ///< Settings, Camera, View
void bind_errors(nb::module_& module);
void bind_scene(nb::module_& module);

}  // namespace csgrt::python
