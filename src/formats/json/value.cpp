// Values with positions. nlohmann's parser reports values without positions, but two facts give the positions. The
// lexer reads character by character, so a counting iterator knows the end of the token that was just reported. Between
// two tokens are only blanks, commas and colons, so the next token starts at the first other character. (After a
// number, the iterator is one character further, because the lexer looks ahead.)
#include "formats/json/value.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include <csgrt/scene.hpp>

#include "base/decimal.hpp"

namespace csgrt {

namespace {

/// An iterator over a text. All its copies note the position in one variable.
class CountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, std::size_t& consumed) : at_(at), consumed_(&consumed) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        ++at_;
        ++*consumed_;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

private:
    const char* at_;
    std::size_t* consumed_;
};

/// nlohmann's message without the position and the words "syntax error while parsing ... - ".
std::string plain_message(std::string message) {
    if (const std::size_t dash = message.find(" - "); dash != std::string::npos) message.erase(0, dash + 3);
    if (const std::size_t tail = message.find("; last read:"); tail != std::string::npos) message.erase(tail);
    return message;
}

/// Receives the parser's events and builds the tree of values.
class Builder {
public:
    Builder(const TextSource& source, Findings& findings, const std::size_t& consumed)
        : source_(source), text_(source.text()), findings_(findings), consumed_(consumed) {}

    std::optional<JsonValue> take() { return std::move(root_); }

    // ---- The functions that nlohmann calls; false stops it ----
    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(std::int64_t value) {
        const bool minus_zero = value == 0 && text_[start()] == '-';
        return add(minus_zero ? -0.0 : static_cast<double>(value));
    }
    bool number_unsigned(std::uint64_t value) { return add(static_cast<double>(value)); }
    bool number_float(double value, const std::string& digits) {
        // nlohmann's own value depends on the locale's decimal point, so the digits are read again.
        if (read_decimal(std::string_view(text_).substr(start(), digits.size()), value) == Decimal::too_large)
            value = std::numeric_limits<double>::infinity();
        return add(value);
    }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(nlohmann::json::binary_t&) { return false; }  // no JSON text holds binary data
    bool start_object(std::size_t) { return open(JsonMembers{}); }
    bool start_array(std::size_t) { return open(JsonArray{}); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        Level& level = levels_.back();
        const std::size_t offset = start();
        const auto [earlier, is_new] = level.names.emplace(name, offset);
        if (!is_new) {
            findings_.add(offset, child_pointer(here(), name), "the key '" + name + "' stands twice in this object",
                          "the first one stands in line " + std::to_string(source_.place(earlier->second).line));
        }
        std::get<JsonMembers>(level.container->data).push_back({std::move(name), offset, {}, !is_new});
        token_end_ = consumed_;
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception& error) {
        std::string message = plain_message(error.what());
        std::size_t offset = start();
        if (message.starts_with("unexpected") && position > 0 && position <= text_.size() &&
            std::string_view(",:[]{}").find(text_[position - 1]) != std::string_view::npos) {
            offset = position - 1;
        }
        if (error.id == 406) message = "the number " + token + " is too large for a double";
        findings_.add(offset, here(), "this is not JSON: " + message, hint(offset));
        return false;
    }

private:
    struct Level {
        JsonValue* container;
        std::unordered_map<std::string, std::size_t> names;  // an object's names, with their positions
    };

    /// The position of the token that is being reported.
    std::size_t start() const {
        constexpr std::string_view between = " \t\r\n,:";
        std::size_t from = token_end_;
        if (from == 0 && text_.starts_with(byte_order_mark)) from = byte_order_mark.size();
        return std::min(text_.find_first_not_of(between, from), text_.size());
    }

    /// The JSON pointer of the innermost open container: the last child of each container around it.
    std::string here() const {
        std::string pointer;
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
            if (const auto* members = std::get_if<JsonMembers>(&levels_[i].container->data)) {
                pointer = child_pointer(pointer, members->back().name);
            } else {
                pointer += "/" + std::to_string(std::get<JsonArray>(levels_[i].container->data).size() - 1);
            }
        }
        return pointer;
    }

    std::string hint(std::size_t offset) const {
        if (text_.find_first_not_of(" \t\r\n") == std::string_view::npos) return "the file is empty";
        const std::string_view rest = text_.substr(std::min(offset, text_.size()));
        const std::size_t before = text_.substr(0, offset).find_last_not_of(" \t\r\n");
        const char previous = before == std::string_view::npos ? '\0' : text_[before];
        const std::string_view sign = rest.starts_with("-") ? rest.substr(1) : rest;
        if (sign.starts_with("NaN") || sign.starts_with("nan") || sign.starts_with("Inf") || sign.starts_with("inf")) {
            return "every number of a scene is finite; JSON has no NaN and no infinity";
        }
        if (rest.starts_with("//") || rest.starts_with("/*") || rest.starts_with("#")) return "JSON has no comments";
        if (rest.starts_with("'")) return "names and texts stand in double quotes";
        if (rest.starts_with("+") || rest.starts_with(".")) return "a number starts with a digit or '-'";
        if (previous == ',' && (rest.starts_with("}") || rest.starts_with("]"))) return "take out the comma before it";
        if (rest.starts_with("\"") && previous != ',' && previous != '{' && previous != '[' && previous != ':') {
            return "a comma may be missing before it";
        }
        return {};
    }

    JsonValue* place_value(JsonValue value) {
        if (levels_.empty()) return &root_.emplace(std::move(value));
        JsonValue& container = *levels_.back().container;
        if (auto* items = std::get_if<JsonArray>(&container.data)) return &items->emplace_back(std::move(value));
        JsonMember& member = std::get<JsonMembers>(container.data).back();
        member.value = std::move(value);
        return &member.value;
    }

    template <class T>
    bool add(T data) {
        place_value({std::move(data), start()});
        token_end_ = consumed_;
        return true;
    }

    template <class T>
    bool open(T container) {
        const std::size_t offset = start();
        if (levels_.size() >= Limits::file_nesting) {
            findings_.add(offset, {}, "brackets are nested more than " + std::to_string(Limits::file_nesting) + " deep",
                          "give a part of the tree a name of its own, or write the tree in postfix form");
            return false;
        }
        levels_.push_back({place_value({std::move(container), offset}), {}});
        token_end_ = consumed_;
        return true;
    }

    bool close() {
        levels_.pop_back();
        token_end_ = consumed_;
        return true;
    }

    const TextSource& source_;
    std::string_view text_;
    Findings& findings_;
    const std::size_t& consumed_;
    std::size_t token_end_ = 0;  // the end of the last reported token
    std::vector<Level> levels_;  // the levels' pointers stay valid, because only the innermost container grows
    std::optional<JsonValue> root_;
};

}  // namespace

const JsonValue* find_member(const JsonMembers& members, std::string_view name) {
    const auto found =
        std::find_if(members.begin(), members.end(), [&](const JsonMember& member) { return member.name == name; });
    return found == members.end() ? nullptr : &found->value;
}

std::optional<JsonValue> parse_json(const TextSource& source, Findings& findings) {
    const std::string_view text = source.text();
    std::size_t consumed = 0, unused = 0;
    Builder builder(source, findings, consumed);
    const bool whole = nlohmann::json::sax_parse(CountingIterator(text.data(), consumed),
                                                 CountingIterator(text.data() + text.size(), unused), &builder);
    return whole ? builder.take() : std::nullopt;
}

std::string child_pointer(const std::string& pointer, std::string_view name) {
    std::string child = pointer + '/';
    for (const char c : name) {
        if (c == '~') {
            child += "~0";
        } else if (c == '/') {
            child += "~1";
        } else {
            child += c;
        }
    }
    return child;
}

}  // namespace csgrt
