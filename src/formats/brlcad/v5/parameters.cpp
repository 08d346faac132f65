#include "formats/brlcad/v5/parameters.hpp"

#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

[[noreturn]] void fail_count(std::size_t offset, std::string_view what, std::size_t found, std::size_t expected) {
    const std::string amount = found > expected ? "more than " : std::to_string(found) + " of ";
    throw Fault{offset, std::string(what) + " has " + amount + std::to_string(expected) + " numbers", {}};
}

}  // namespace

Parameters::Parameters(const TclWord& type, std::span<const TclWord> words, TclStore& store,
                       std::string_view repeatable)
    : type_(type), store_(store) {
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const TclWord& key = words[i];
        if (i + 1 == words.size()) throw Fault{key.offset, quoted(key.text) + " has no value", {}};
        if (!repeatable.empty() && key.text == repeatable) {
            repeated_.push_back(&words[i + 1]);
        } else if (!values_.try_emplace(key.text, Value{key.offset, &words[i + 1]}).second) {
            throw Fault{key.offset, quoted(key.text) + " is given twice", {}};
        }
    }
}

std::string_view Parameters::one_of(std::initializer_list<std::string_view> keys) const {
    for (const std::string_view key : keys) {
        if (has(key)) return key;
    }
    return *keys.begin();
}

std::size_t Parameters::place_of(std::string_view key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? type_.offset : found->second.word->offset;
}

const TclWord& Parameters::take(std::string_view key) {
    const auto found = values_.find(key);
    if (found == values_.end()) {
        throw Fault{type_.offset, "the " + std::string(type_.text) + " has no " + std::string(key), {}};
    }
    const TclWord& word = *found->second.word;
    values_.erase(found);
    return word;
}

double Parameters::number(std::string_view key) {
    const TclWord& word = take(key);
    return read_number(word.text, word.offset);
}

int Parameters::integer(std::string_view key, int low, int high) {
    const TclWord& word = take(key);
    return read_integer(word.text, word.offset, low, high);
}

std::uint32_t Parameters::count(std::string_view key) {
    return static_cast<std::uint32_t>(integer(key, 1, largest_integer));
}

Vec3 Parameters::vec3(std::string_view key) {
    const auto v = numbers<3>(key);
    return {v[0], v[1], v[2]};
}

Matrix Parameters::matrix(std::string_view key) {
    const TclWord& word = take(key);
    Matrix matrix{};
    read_numbers(word, key, matrix);
    return without_scale(matrix);
}

void Parameters::read_numbers(const TclWord& list, std::string_view what, std::span<double> values) const {
    TclList elements(list, store_);
    TclWord element;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!elements.next(element)) fail_count(elements.offset(), what, i, values.size());
        values[i] = read_number(element.text, element.offset);
    }
    if (elements.next(element)) fail_count(element.offset, what, values.size() + 1, values.size());
}

std::vector<double> Parameters::all_numbers(std::string_view key) {
    std::vector<double> out;
    TclList elements(take(key), store_);
    for (TclWord element; elements.next(element);) out.push_back(read_number(element.text, element.offset));
    return out;
}

std::vector<std::uint32_t> Parameters::indices(std::string_view key, std::size_t end) {
    return read_v5_indices(take(key), end, store_);
}

std::vector<Vec3> Parameters::points(std::string_view key) {
    std::vector<Vec3> out;
    for (const auto& p : rows<3>(key)) out.push_back({p[0], p[1], p[2]});
    return out;
}

std::vector<Triangle> Parameters::triangles(std::string_view key, std::size_t end) {
    std::vector<Triangle> out;
    TclList elements(take(key), store_);
    for (TclWord element; elements.next(element);) {
        const std::vector<std::uint32_t> corners = read_v5_indices(element, end, store_);
        if (corners.size() != 3) {
            throw Fault{element.offset, std::to_string(corners.size()) + " corners are no triangle", {}};
        }
        out.push_back({corners[0], corners[1], corners[2]});
    }
    return out;
}

void Parameters::end() const {
    if (values_.empty()) return;
    const auto* first = &*values_.begin();
    for (const auto& entry : values_) {
        if (entry.second.offset < first->second.offset) first = &entry;
    }
    const std::string type(type_.text);
    throw Fault{first->second.offset, quoted(first->first) + " is no parameter of a " + type, {}};
}

std::vector<std::uint32_t> read_v5_indices(const TclWord& list, std::size_t end, TclStore& store) {
    std::vector<std::uint32_t> out;
    TclList elements(list, store);
    for (TclWord element; elements.next(element);) {
        const int index = read_integer(element.text, element.offset, 0, largest_integer);
        if (static_cast<std::size_t>(index) >= end) {
            throw Fault{element.offset,
                        "there is no number " + std::to_string(index) + ": there are only " + std::to_string(end) +
                            ", counted from 0",
                        {}};
        }
        out.push_back(static_cast<std::uint32_t>(index));
    }
    return out;
}

}  // namespace csgrt
