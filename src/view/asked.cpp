#include "asked.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <csgrt/error.hpp>

#include "form/requests.hpp"

namespace csgrt {

namespace {

constexpr std::array<std::pair<std::string_view, Show>, 6> shows{{{"color", Show::color},
                                                                  {"depth", Show::depth},
                                                                  {"normal", Show::normal},
                                                                  {"region", Show::region},
                                                                  {"overlap", Show::overlap},
                                                                  {"segments", Show::segments}}};
constexpr std::array<std::pair<std::string_view, State>, 3> states{
    {{"shown", State::shown}, {"ghost", State::ghost}, {"hidden", State::hidden}}};
constexpr int most_samples = 256, most_nested = 16;

template <class Names>
auto named(const Names& names, const Request& request, const char* member) {
    const std::string name = request.text(member);
    for (const auto& [text, value] : names)
        if (text == name) return value;
    throw Error(Status::usage, std::string(member) + ": there is no '" + name + "'");
}

Camera read_camera(const Request& request) {
    Camera camera;
    camera.azimuth = request.number("azimuth");
    camera.elevation = request.number("elevation");
    camera.perspective = request.number("perspective");
    camera.center = request.vector("center");
    camera.view_size = request.number("view_size");
    return camera;
}

}  // namespace

// What is nested deeper than a thread's stack goes would end the program where it is copied.
Request::Request(const std::string& body)
    : value_(Json::parse(
          body,
          [](int depth, Json::parse_event_t, const Json&) {
              if (depth <= most_nested) return true;
              throw Error(Status::usage,
                          "the request: brackets are nested more than " + std::to_string(most_nested) + " deep");
          },
          false)) {
    expect_object();
}

void Request::expect_object() const {
    if (!value_.is_object())
        throw Error(Status::usage, (name_.empty() ? "the request" : name_) + ": expected an object of JSON");
}

const Json& Request::get(const char* member) const {
    const auto found = value_.find(member);
    if (found == value_.end()) refuse(member, "is missing");
    return *found;
}

void Request::refuse(const char* member, const std::string& expected) const {
    throw Error(Status::usage, path(member) + ": " + expected);
}

double Request::number(const char* member) const {
    const Json& value = get(member);
    if (!value.is_number()) refuse(member, "expected a number");
    return value.get<double>();
}

int Request::count(const char* member, int low, int high) const {
    const double value = number(member);
    if (!(value >= low && value <= high) || value != static_cast<int>(value))
        refuse(member, "expected a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return static_cast<int>(value);
}

bool Request::flag(const char* member) const {
    if (!has(member)) return false;
    const Json& value = get(member);
    if (!value.is_boolean()) refuse(member, "expected true or false");
    return value.get<bool>();
}

std::string Request::text(const char* member) const {
    const Json& value = get(member);
    if (!value.is_string()) refuse(member, "expected a text");
    return value.get<std::string>();
}

Vec3 Request::vector(const char* member) const {
    const Json& value = get(member);
    if (!value.is_array() || value.size() != 3 || !value[0].is_number() || !value[1].is_number() ||
        !value[2].is_number())
        refuse(member, "expected three numbers");
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

std::vector<Request> Request::objects(const char* member) const {
    std::vector<Request> all;
    if (!has(member)) return all;
    const Json& value = get(member);
    if (!value.is_array()) refuse(member, "expected a list");
    for (const Json& one : value) all.emplace_back(one, path(member) + "[" + std::to_string(all.size()) + "]");
    return all;
}

Asked read_asked(const Request& request) {
    Asked asked;
    const Request view = request.object("view");
    asked.view.camera = read_camera(view.object("camera"));
    for (const Request& plane : view.objects("clip"))
        asked.view.clip.push_back({plane.vector("normal"), plane.number("distance")});
    for (const Request& one : view.objects("looks")) {
        Look look{.path = one.text("path")};
        if (one.has("state")) look.state = named(states, one, "state");
        if (one.has("color")) look.color = one.vector("color");
        asked.looks.push_back(std::move(look));
    }
    form::for_members(form::of<View>, [&](const auto& member) {
        auto& value = asked.view.*member.at;
        const std::string name(member.key.member);
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, bool>) {
            if (view.has(name.c_str())) value = view.flag(name.c_str());
        } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member.kind)>, form::Whole>) {
            if (view.has(name.c_str())) value = view.count(name.c_str(), member.kind.low, member.kind.high);
        }
    });
    if (view.has("show")) asked.show = named(shows, view, "show");
    asked.view.width = asked.view.height = 1;
    if (request.has("width")) {
        asked.view.width = request.count("width", 1, most_pixels_of_side);
        asked.view.height = request.count("height", 1, most_pixels_of_side);
    }
    if (request.has("samples")) asked.view.samples = request.count("samples", 1, most_samples);
    asked.view.every_partition = asked.show == Show::overlap || asked.show == Show::segments;
    return asked;
}

Slice read_slice(const Request& request) {
    return {.center = request.vector("center"),
            .right = request.vector("right"),
            .up = request.vector("up"),
            .width = request.count("width", 1, most_pixels_of_side),
            .height = request.count("height", 1, most_pixels_of_side),
            .hidden = false};
}

std::string_view name_of(State state) {
    return std::ranges::find(states, state, &std::pair<std::string_view, State>::second)->first;
}

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace csgrt
