#include "formats/brlcad_v5_solids.hpp"

#include <array>
#include <unordered_map>
#include <utility>

#include "formats/brlcad_values.hpp"

namespace csgrt {

namespace {

/// The keys of one solid and their values. What is read is taken; `end` refuses what is left.
class Parameters {
public:
    Parameters(const TclWord& type, std::span<const TclWord> words, TclStore& store) : type_(type), store_(store) {
        for (std::size_t i = 0; i < words.size(); i += 2) {
            const TclWord& key = words[i];
            if (i + 1 == words.size()) throw Fault{key.offset, quoted(key.text) + " has no value", {}};
            if (!values_.try_emplace(key.text, Value{key.offset, &words[i + 1]}).second) {
                throw Fault{key.offset, quoted(key.text) + " is given twice", {}};
            }
        }
    }

    double number(std::string_view key) {
        const TclWord& word = take(key);
        return read_number(word.text, word.offset);
    }
    int integer(std::string_view key, int low, int high) {
        const TclWord& word = take(key);
        return read_integer(word.text, word.offset, low, high);
    }
    Vec3 vec3(std::string_view key) {
        const auto v = numbers<3>(key);
        return {v[0], v[1], v[2]};
    }
    template <std::size_t count>
    std::array<double, count> numbers(std::string_view key) {
        const TclWord& word = take(key);
        TclList elements(word, store_);
        TclWord element;
        std::array<double, count> values{};
        for (std::size_t i = 0; i < count; ++i) {
            if (!elements.next(element)) fail_count(elements.offset(), key, i, count);
            values[i] = read_number(element.text, element.offset);
        }
        if (elements.next(element)) fail_count(element.offset, key, count + 1, count);
        return values;
    }
    void end() const {
        if (values_.empty()) return;
        const auto* first = &*values_.begin();
        for (const auto& entry : values_) {
            if (entry.second.offset < first->second.offset) first = &entry;
        }
        const std::string type(type_.text);
        throw Fault{first->second.offset, quoted(first->first) + " is no parameter of a " + type, {}};
    }

private:
    struct Value {
        std::size_t offset;
        const TclWord* word;
    };

    const TclWord& take(std::string_view key) {
        const auto found = values_.find(key);
        if (found == values_.end()) {
            throw Fault{type_.offset, "the " + std::string(type_.text) + " has no " + std::string(key), {}};
        }
        const TclWord& word = *found->second.word;
        values_.erase(found);
        return word;
    }
    [[noreturn]] static void fail_count(std::size_t offset, std::string_view key, std::size_t found,
                                        std::size_t expected) {
        const std::string amount = found > expected ? "more than " : std::to_string(found) + " of ";
        throw Fault{offset, std::string(key) + " has " + amount + std::to_string(expected) + " numbers", {}};
    }

    const TclWord& type_;
    TclStore& store_;
    std::unordered_map<std::string_view, Value> values_;
};

Shape arb8(Parameters& p) {
    constexpr std::string_view keys[] = {"V1", "V2", "V3", "V4", "V5", "V6", "V7", "V8"};
    Arb arb;
    for (std::size_t i = 0; i < 8; ++i) arb.vertices[i] = p.vec3(keys[i]);
    return arb;
}

Shape arbn(Parameters& p) {
    Arbn solid;
    const int count = p.integer("N", 1, static_cast<int>(Limits::faces));
    for (int i = 0; i < count; ++i) {
        const auto plane = p.numbers<4>("P" + std::to_string(i));
        solid.planes.push_back(unit_plane({plane[0], plane[1], plane[2]}, plane[3]));
    }
    return solid;
}

Shape half(Parameters& p) {
    const Vec3 normal = p.vec3("N");
    return Half{unit_plane(normal, p.number("d"))};
}

Shape read_shape(std::string_view type, Parameters& p) {
    // Braces evaluate their parts from left to right, so the first missing key is the one that is named.
    if (type == "ell" || type == "sph") return Ell{p.vec3("V"), p.vec3("A"), p.vec3("B"), p.vec3("C")};
    if (type == "tgc" || type == "rec") {
        return Tgc{p.vec3("V"), p.vec3("H"), p.vec3("A"), p.vec3("B"), p.vec3("C"), p.vec3("D")};
    }
    if (type == "tor") return Tor{p.vec3("V"), p.vec3("H"), p.number("r_a"), p.number("r_h")};
    if (type == "ehy") {
        return Ehy{p.vec3("V"), p.vec3("H"), unit_vector(p.vec3("A")), p.number("r_1"), p.number("r_2"), p.number("c")};
    }
    if (type == "arb8") return arb8(p);
    if (type == "arbn") return arbn(p);
    return half(p);
}

bool is_known(std::string_view type) {
    constexpr std::string_view types[] = {"ell", "sph", "tgc", "rec", "tor", "ehy", "arb8", "arbn", "half"};
    for (const std::string_view known : types) {
        if (type == known) return true;
    }
    return false;
}

}  // namespace

Shape read_v5_solid(const TclWord& type, std::span<const TclWord> keys_and_values, TclStore& store) {
    if (!is_known(type.text)) return Unsupported{std::string(type.text)};
    Parameters parameters(type, keys_and_values, store);
    Shape shape = read_shape(type.text, parameters);
    parameters.end();
    return shape;
}

}  // namespace csgrt
