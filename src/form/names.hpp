// The names of enumerations' values in JSON, in the command, in Python and, in capitals, in C. The names of Precision
// and Tolerance are in csgrt/method.hpp.
#pragma once

#include <csgrt/error.hpp>
#include <csgrt/method.hpp>
#include <csgrt/rays.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/view.hpp>

#include "form/form.hpp"

namespace csgrt {

template <class Value>
using NameOf = std::pair<std::string_view, Value>;

inline constexpr NameOf<State> state_names[] = {
    {"shown", State::shown}, {"ghost", State::ghost}, {"hidden", State::hidden}};
inline constexpr NameOf<Fastgen> fastgen_names[] = {
    {"none", Fastgen::none}, {"plate", Fastgen::plate}, {"volume", Fastgen::volume}};
inline constexpr NameOf<Operator> operator_names[] = {
    {"leaf", Operator::leaf},
    {"union", Operator::union_},
    {"intersection", Operator::intersection},
    {"difference", Operator::difference},
    {"xor", Operator::xor_},
    {"not", Operator::not_},
};
inline constexpr NameOf<Axis> axis_names[] = {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};
inline constexpr NameOf<std::uint32_t> channel_names[] = {
    {"color", channel::color},     {"distance", channel::distance}, {"normal", channel::normal},
    {"ids", channel::ids},         {"counts", channel::counts},     {"all", channel::all},
    {"display", channel::display}, {"ghosts", channel::ghosts},
};
inline constexpr NameOf<Lighting> lighting_names[] = {
    {"model", Lighting::model}, {"headlight", Lighting::headlight}, {"studio", Lighting::studio}};
inline constexpr NameOf<Status> status_names[] = {
    {"usage", Status::usage},         {"scene", Status::scene},
    {"no_device", Status::no_device}, {"out_of_memory", Status::out_of_memory},
    {"file", Status::file},           {"device_fault", Status::device_fault},
    {"differs", Status::differs},     {"interrupted", Status::interrupted},
};
/// All values, also those that no option of the command has.
inline constexpr NameOf<Precision> every_precision[] = {
    {"double", Precision::double_}, {"single", Precision::single}, {"quad", Precision::quad}};
inline constexpr NameOf<Tolerance> every_tolerance[] = {{"length", Tolerance::length},
                                                        {"surfaces", Tolerance::surfaces},
                                                        {"relative", Tolerance::relative},
                                                        {"none", Tolerance::none}};

namespace form {

/// The kind of a member whose values have these names. The names before `first` are left out.
template <std::size_t first = 0, class Value, std::size_t count>
constexpr Words<count - first> words_of(const NameOf<Value> (&names)[count]) {
    Words<count - first> words{{}, first};
    for (std::size_t i = first; i < count; ++i) words.words[i - first] = names[i].first;
    return words;
}

}  // namespace form

}  // namespace csgrt
