#include "formats/json/node.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/nearest.hpp"
#include "scene/vector.hpp"

namespace csgrt {

const char* kind_of(const JsonValue& value) {
    static constexpr const char* kinds[] = {"null", "true or false", "a number", "a string", "an array", "an object"};
    return kinds[value.data.index()];
}

void JsonNode::fault(std::string message, std::string suggestion) const {
    file_->findings.add(value_->offset, pointer_, std::move(message), std::move(suggestion));
}

void JsonNode::Member::fault(std::string message, std::string suggestion) const {
    value.file().findings.add(offset, value.pointer(), std::move(message), std::move(suggestion));
}

template <class T>
const T* JsonNode::expect(const char* what) const {
    if (value_ == nullptr) return nullptr;
    const T* data = std::get_if<T>(&value_->data);
    if (data == nullptr) fault(std::string("expected ") + what + ", found " + kind_of(*value_));
    return data;
}

bool JsonNode::is_vector() const {
    if (!is_array()) return false;
    const JsonArray& array = std::get<JsonArray>(value_->data);
    return array.size() == 3 && std::all_of(array.begin(), array.end(), [](const JsonValue& item) {
               return std::holds_alternative<double>(item.data);
           });
}

bool JsonNode::boolean(bool otherwise) const {
    const bool* data = expect<bool>("true or false");
    return data == nullptr ? otherwise : *data;
}

double JsonNode::number(double otherwise) const {
    const double* data = expect<double>("a number");
    return data == nullptr ? otherwise : *data;
}

int JsonNode::integer(int low, int high, int otherwise) const {
    const double value = number(otherwise);
    if (!present()) return otherwise;
    if (!(value == std::trunc(value))) {
        fault("expected a whole number");
    } else if (!(value >= low && value <= high)) {
        fault("must be from " + std::to_string(low) + " to " + std::to_string(high));
    } else {
        return static_cast<int>(value);
    }
    return otherwise;
}

std::uint32_t JsonNode::count(std::uint32_t otherwise) const {
    constexpr std::uint32_t most = UINT32_MAX;
    const double value = number(otherwise);
    if (value >= 0 && value <= most && value == std::trunc(value)) return static_cast<std::uint32_t>(value);
    fault(value == std::trunc(value) ? "must be from 0 to " + std::to_string(most) : "expected a whole number");
    return otherwise;
}

std::string JsonNode::string() const {
    const std::string* data = expect<std::string>("a string");
    return data == nullptr ? std::string() : *data;
}

std::string JsonNode::name() const {
    std::string text = string();
    if (is_string() && text.empty()) fault("a name must not be empty");
    return text;
}

std::size_t JsonNode::choice(std::span<const std::string_view> names, std::size_t otherwise) const {
    const std::string name = string();
    if (!is_string()) return otherwise;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    std::string known;
    for (const std::string_view each : names) known += (known.empty() ? "one of " : ", ") + std::string(each);
    const std::string nearest = did_you_mean(name, {names.begin(), names.end()});
    fault("'" + name + "' is not known here", nearest.empty() ? known : nearest);
    return otherwise;
}

std::vector<double> JsonNode::numbers(std::size_t count) const {
    std::vector<double> values(count);
    const JsonArray* array = expect<JsonArray>(("an array of " + std::to_string(count) + " numbers").c_str());
    if (array == nullptr) return values;
    if (array->size() != count) {
        fault("expected " + std::to_string(count) + " numbers, found " + std::to_string(array->size()));
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (const double* value = std::get_if<double>(&(*array)[i].data)) {
            values[i] = *value;
        } else {
            file_->findings.add((*array)[i].offset, pointer_ + '/' + std::to_string(i),
                                std::string("expected a number, found ") + kind_of((*array)[i]));
        }
    }
    return values;
}

Vec3 JsonNode::vector() const {
    const std::vector<double> values = numbers(3);
    return {values[0], values[1], values[2]};
}

Vec3 JsonNode::color() const {
    const Vec3 color = vector();
    for (const double component : {color.x, color.y, color.z}) {
        if (component < 0 || component > 1) {
            fault("a colour is red, green and blue from 0 to 1", "divide components up to 255 by 255");
            break;
        }
    }
    return color;
}

Vec3 JsonNode::lengths() const { return file_->unit * vector(); }

Vec3 JsonNode::direction() const {
    const Vec3 v = vector();
    return is_unit(v) ? v : unit(v);
}

const JsonArray* JsonNode::array() const { return expect<JsonArray>("an array"); }

JsonNode JsonNode::item(std::size_t i) const {
    return {*file_, &std::get<JsonArray>(value_->data)[i], pointer_ + '/' + std::to_string(i)};
}

std::vector<JsonNode> JsonNode::items() const {
    std::vector<JsonNode> nodes;
    const JsonArray* items = array();
    for (std::size_t i = 0; items != nullptr && i < items->size(); ++i) nodes.push_back(item(i));
    return nodes;
}

std::vector<JsonNode::Member> JsonNode::members() const {
    std::vector<Member> nodes;
    const JsonMembers* members = expect<JsonMembers>("an object");
    if (members == nullptr) return nodes;
    nodes.reserve(members->size());
    for (const JsonMember& member : *members) {
        if (member.repeated) continue;
        const std::string pointer = child_pointer(pointer_, member.name);
        nodes.push_back({member.name, JsonNode(*file_, &member.value, pointer),
                         file_->source.place(member.offset, pointer), member.offset});
    }
    return nodes;
}

JsonObject::JsonObject(const JsonNode& node, std::span<const JsonKey> keys) : node_(node) {
    if (!node.present()) return;
    std::vector<std::string_view> known;
    for (const JsonKey& key : keys) known.push_back(key.name);
    std::string suggested;  // the keys that unknown keys probably mean: they are not reported as missing, too
    for (const JsonNode::Member& member : node.members()) {
        if (std::find(known.begin(), known.end(), member.name) != known.end()) continue;
        std::string suggestion = did_you_mean(member.name, known);
        suggested += suggestion;
        if (suggestion.empty()) {
            for (const std::string_view name : known)
                suggestion += (suggestion.empty() ? "known: " : ", ") + std::string(name);
        }
        member.fault("unknown key '" + member.name + "'", suggestion);
    }
    if (!node.is_object()) return;
    for (const JsonKey& key : keys) {
        const bool misspelt = suggested.find("'" + std::string(key.name) + "'") != std::string::npos;
        if (key.required && !has(key.name) && !misspelt)
            node.fault("the key '" + std::string(key.name) + "' is missing");
    }
}

bool JsonObject::has(std::string_view key) const { return (*this)[key].present(); }

JsonNode JsonObject::operator[](std::string_view key) const {
    const JsonMembers* members = node_.is_object() ? std::get_if<JsonMembers>(&node_.value()->data) : nullptr;
    const JsonValue* value = members == nullptr ? nullptr : find_member(*members, key);
    return JsonNode(node_.file(), value, child_pointer(node_.pointer(), key));
}

}  // namespace csgrt
