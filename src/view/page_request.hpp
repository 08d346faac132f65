// Requests of the page, which are JSON texts. All functions throw Error (usage) that names the faulty member.
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

/// The quantity that a frame's pixels show.
enum class Show { color, depth, normal, region, overlap, segments, marks };

/// A page's view, as the page's address and its saved files hold it.
struct PageView {
    View view = {};
    std::vector<Look> looks = {};
    Show show = Show::color;
};

constexpr int most_pixels_of_side = 8192;

/// A JSON object, whose members are read by name and type.
class Request {
public:
    /// Reads a request's body, or takes a member's value. `name`: the member's, for errors.
    explicit Request(const std::string& body);
    Request(Json value, std::string name) : value_(std::move(value)), name_(std::move(name)) { expect_object(); }

    bool has(const char* member) const { return value_.contains(member); }
    double number(const char* member) const;
    int count(const char* member, int low, int high) const;
    bool flag(const char* member) const;  ///< false if the member is missing
    std::string text(const char* member) const;
    Vec3 vector(const char* member) const;
    Request object(const char* member) const { return {get(member), path(member)}; }
    std::vector<Request> objects(const char* member) const;  ///< none if the member is missing
    /// Ranges [first, last) of whole numbers up to `most`, each behind the one before.
    std::vector<std::pair<std::size_t, std::size_t>> ranges(const char* member, std::size_t most) const;

private:
    void expect_object() const;
    std::string path(const char* member) const { return name_.empty() ? member : name_ + "." + member; }
    const Json& get(const char* member) const;
    [[noreturn]] void refuse(const char* member, const std::string& expected) const;

    Json value_;
    std::string name_;
};

/// Reads the member `view` of a request, and the size in pixels, which stands beside it.
PageView read_page_view(const Request& request);
/// Reads a slice's plane and pixels, not its looks.
Slice read_slice(const Request& request);

Json to_json(const Vec3& v);

}  // namespace csgrt
