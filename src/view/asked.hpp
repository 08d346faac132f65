// What a page asks for: the texts of its requests. All throw Error (usage), which names the member.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <csgrt/rays.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/view.hpp>

namespace csgrt {

using Json = nlohmann::json;

/// What the pixels of a frame tell.
enum class Show { color, depth, normal, region, overlap, segments };

/// A view as the page has it, keeps it in its address and saves it.
struct Asked {
    View view = {};
    std::vector<Look> looks = {};
    Show show = Show::color;
};

constexpr int most_pixels_of_side = 8192;

/// An object. Members are taken by name and type.
class Request {
public:
    /// Of a body, or of a member's value called `name`.
    explicit Request(const std::string& body);
    Request(Json value, std::string name) : value_(std::move(value)), name_(std::move(name)) { expect_object(); }

    bool has(const char* member) const { return value_.contains(member); }
    double number(const char* member) const;
    int count(const char* member, int low, int high) const;
    bool flag(const char* member) const;  ///< false if it is not there
    std::string text(const char* member) const;
    Vec3 vector(const char* member) const;
    Request object(const char* member) const { return {get(member), path(member)}; }
    std::vector<Request> objects(const char* member) const;  ///< none if it is not there

private:
    void expect_object() const;
    std::string path(const char* member) const { return name_.empty() ? member : name_ + "." + member; }
    const Json& get(const char* member) const;
    [[noreturn]] void refuse(const char* member, const std::string& expected) const;

    Json value_;
    std::string name_;
};

/// The view of a request, with its size in pixels.
Asked read_asked(const Request& request);
/// Pixels in a plane; looks are read apart.
Slice read_slice(const Request& request);

Json to_json(const Vec3& v);
/// As requests have it.

}  // namespace csgrt
