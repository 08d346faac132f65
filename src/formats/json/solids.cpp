#include "formats/json/solids.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/json/forms.hpp"
#include "formats/json/read_form.hpp"
#include "scene/nearest.hpp"

namespace csgrt {

namespace {

/// Checks several members of a simple solid together.
template <class S>
void check_together(const JsonObject&, const S&) {}

void check_together(const JsonObject& o, const Cone& s) {
    if (o["radius"].present() && s.radius == 0 && s.top_radius == 0) {
        o["radius"].fault("'radius' and 'top_radius' must not both be 0");
    }
}

void check_together(const JsonObject& o, const UprightBox& s) {
    const auto& [low, high] = s;
    if (o["low"].is_vector() && o["high"].is_vector() && !(low.x < high.x && low.y < high.y && low.z < high.z)) {
        o["high"].fault("each number of 'high' must be greater than that of 'low'");
    }
}

template <class S>
Shape read_solid(const JsonNode& node) {
    const JsonObject o = json_object(node, form::of<S>);
    S s = form::usual<S>();
    read_members(o, form::of<S>, s);
    check_together(o, s);
    return model_of(std::move(s));
}

using Read = Shape (*)(const JsonNode&);
struct Reader {
    std::string_view type;
    Read read;
};
const std::vector<Reader>& readers() {
    static const auto& all = *new const std::vector<Reader>([] {  // never destroyed: threads may outlive exit()
        std::vector<Reader> made;
        for_json_solids([&]<class S>(const S*) { made.push_back({form::of<S>.head.name, read_solid<S>}); });
        return made;
    }());
    return all;
}

/// The suggestion for an object without a type: a list of all types.
std::string all_types() {
    std::string list;
    for (const Reader& reader : readers()) list += (list.empty() ? "one of " : ", ") + std::string(reader.type);
    return list;
}

}  // namespace

std::vector<std::string_view> json_solid_types() {
    std::vector<std::string_view> types;
    for (const Reader& reader : readers()) types.push_back(reader.type);
    return types;
}

Shape read_json_solid(const JsonNode& node) {
    const JsonMembers* members = node.is_object() ? std::get_if<JsonMembers>(&node.value()->data) : nullptr;
    if (members == nullptr) {
        node.fault(std::string("expected a solid, {\"type\": ...}, found ") + kind_of(*node.value()));
        return Unsupported{};
    }
    const JsonNode type(node.file(), find_member(*members, "type"), child_pointer(node.pointer(), "type"));
    if (!type.present()) {
        node.fault("the key 'type' is missing", all_types());
        return Unsupported{};
    }
    const std::string name = type.string();
    const auto& known = readers();
    const auto reader = std::find_if(known.begin(), known.end(), [&](const Reader& it) { return it.type == name; });
    if (reader != known.end()) return reader->read(node);
    if (type.is_string()) {
        const std::string nearest = did_you_mean(name, json_solid_types());
        type.fault("there is no solid of type '" + name + "'", nearest.empty() ? all_types() : nearest);
    }
    return Unsupported{};
}

}  // namespace csgrt
