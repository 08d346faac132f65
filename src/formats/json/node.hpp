// Nodes: read typed values from JSON. A wrong value becomes a finding with its position, and reading goes on with a
// neutral value, because a scene with findings is never returned.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/json/value.hpp"

namespace csgrt {

/// The data that all nodes of a file share.
struct JsonFile {
    const TextSource& source;
    Findings& findings;
    double unit = 1;  ///< millimetres in the file's unit of length
};

/// A value and its path in the file. For an absent value, every reading function returns its neutral value without a
/// finding.
class JsonNode {
public:
    JsonNode(JsonFile& file, const JsonValue* value, std::string pointer)
        : file_(&file), value_(value), pointer_(std::move(pointer)) {}

    bool present() const { return value_ != nullptr; }
    JsonFile& file() const { return *file_; }
    const JsonValue* value() const { return value_; }
    const std::string& pointer() const { return pointer_; }
    Place place() const { return file_->source.place(value_->offset, pointer_); }
    void fault(std::string message, std::string suggestion = {}) const;

    bool is_null() const { return holds<std::nullptr_t>(); }
    bool is_string() const { return holds<std::string>(); }
    bool is_array() const { return holds<JsonArray>(); }
    bool is_object() const { return holds<JsonMembers>(); }
    bool is_number() const { return holds<double>(); }
    bool is_vector() const;  ///< three numbers

    bool boolean(bool otherwise = false) const;
    double number(double otherwise = 0) const;
    int integer(int low, int high, int otherwise) const;
    std::uint32_t count(std::uint32_t otherwise = 0) const;  ///< a whole number from 0 to 2^32 - 1
    std::string string() const;
    std::string name() const;  ///< a string that is not empty
    /// The index of the string among `names`.
    std::size_t choice(std::span<const std::string_view> names, std::size_t otherwise) const;
    Vec3 vector() const;  ///< three numbers, unchanged
    Vec3 color() const;   ///< three numbers from 0 to 1
    /// The number in millimetres.
    double length() const { return file_->unit * number(); }
    Vec3 lengths() const;
    /// A vector of any length but 0, made a unit vector. A unit vector keeps its bits.
    Vec3 direction() const;
    /// `count` numbers.
    std::vector<double> numbers(std::size_t count) const;

    const JsonArray* array() const;  ///< null, with a finding, if the value is not an array
    JsonNode item(std::size_t i) const;
    /// The items of an array, or the members of an object, each name once. Empty, with a finding, for other values.
    std::vector<JsonNode> items() const;
    struct Member;
    std::vector<Member> members() const;

private:
    template <class T>
    bool holds() const {
        return value_ != nullptr && std::holds_alternative<T>(value_->data);
    }
    template <class T>
    const T* expect(const char* what) const;

    JsonFile* file_;
    const JsonValue* value_;
    std::string pointer_;
};

struct JsonNode::Member {
    std::string name;
    JsonNode value;
    Place place;  ///< the name's place

    void fault(std::string message, std::string suggestion = {}) const;
    std::size_t offset = 0;
};

/// A key that an object may have.
struct JsonKey {
    std::string_view name;
    bool required = false;
};

/// An object with given keys. The constructor reports unknown keys, and required keys that are missing.
class JsonObject {
public:
    JsonObject(const JsonNode& node, std::span<const JsonKey> keys);

    bool has(std::string_view key) const;
    JsonNode operator[](std::string_view key) const;
    const JsonNode& node() const { return node_; }

private:
    JsonNode node_;
};

/// The kind of a value, for messages: "a number", "an object", ...
const char* kind_of(const JsonValue& value);

}  // namespace csgrt
