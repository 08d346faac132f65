#include "page_request.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <csgrt/error.hpp>

#include "form/names.hpp"
#include "form/requests.hpp"

namespace csgrt {

namespace {

constexpr std::array<std::pair<std::string_view, Show>, 7> shows{{{"color", Show::color},
                                                                  {"depth", Show::depth},
                                                                  {"normal", Show::normal},
                                                                  {"region", Show::region},
                                                                  {"overlap", Show::overlap},
                                                                  {"segments", Show::segments},
                                                                  {"marks", Show::marks}}};
constexpr int most_nested = 16;

template <class Names>
auto named(const Names& names, const Request& request, const char* member) {
    const std::string name = request.text(member);
    for (const auto& [text, value] : names)
        if (text == name) return value;
    throw Error(Status::usage, std::string(member) + ": there is no '" + name + "'");
}

/// Reads the numbers, flags, points and names of a camera or a view.
template <class S>
void read_members(const Request& request, S& s) {
    form::for_members(form::of<S>, [&](const auto& member) {
        auto& value = s.*member.at;
        using Value = std::remove_cvref_t<decltype(value)>;
        const std::string key(member.key.member);
        const char* const name = key.c_str();
        if (!request.has(name)) return;
        if constexpr (std::is_same_v<Value, bool>)
            value = request.flag(name);
        else if constexpr (std::is_same_v<Value, int>)
            value = request.count(name, member.kind.low, std::min(member.kind.high, most_pixels_of_side));
        else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
            value = request.number(name);
        else if constexpr (std::is_same_v<Value, std::optional<Vec3>>)
            value = request.vector(name);
        else if constexpr (std::is_enum_v<Value>)
            value = named(*member.kind.names, request, name);
    });
}

}  // namespace

// A limit of nesting: Json is copied by recursion, and brackets nested too deep would overflow a thread's stack.
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

std::vector<std::pair<std::size_t, std::size_t>> Request::ranges(const char* member, std::size_t most) const {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    const Json& value = get(member);
    if (!value.is_array()) refuse(member, "expected a list");
    const auto is_number = [](const Json& one) { return one.is_number_unsigned(); };
    std::size_t before = 0;
    for (const Json& one : value) {
        if (!one.is_array() || one.size() != 2 || !std::ranges::all_of(one, is_number)) break;
        const std::pair range(one[0].get<std::size_t>(), one[1].get<std::size_t>());
        if (range.first < before || range.first >= range.second || range.second > most) break;
        all.push_back(range);
        before = range.second;
    }
    if (all.size() != value.size())
        refuse(member, "expected ranges of numbers up to " + std::to_string(most) + ", in order");
    return all;
}

PageView read_page_view(const Request& request) {
    PageView page;
    const Request view = request.object("view");
    read_members(view.object("camera"), page.view.camera);
    for (const Request& plane : view.objects("clip"))
        page.view.clip.push_back({plane.vector("normal"), plane.number("distance")});
    for (const Request& one : view.objects("looks")) {
        Look look{.path = one.text("path")};
        if (one.has("state")) look.state = named(state_names, one, "state");
        if (one.has("color")) look.color = one.vector("color");
        page.looks.push_back(std::move(look));
    }
    if (view.has("show")) page.show = named(shows, view, "show");
    page.view.width = page.view.height = 1;
    page.view.transparent = true;  // the page has a ground of its own behind the picture
    read_members(view, page.view);
    read_members(request, page.view);
    page.view.every_partition = page.show == Show::overlap || page.show == Show::segments;
    return page;
}

Slice read_slice(const Request& request) {
    return {.center = request.vector("center"),
            .right = request.vector("right"),
            .up = request.vector("up"),
            .width = request.count("width", 1, most_pixels_of_side),
            .height = request.count("height", 1, most_pixels_of_side),
            .hidden = false};
}

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace csgrt
