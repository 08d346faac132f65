// Parameters: keys and values of BRL-CAD's newer text form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <csgrt/solids.hpp>

#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

constexpr int largest_integer = std::numeric_limits<int>::max();

using Triangle = std::array<std::uint32_t, 3>;

/// The keys and values of one solid, or of a part of a solid. Each call takes a value; `end` refuses keys that were not
/// taken. A missing or wrong value is a Fault at its position.
class Parameters {
public:
    /// Only the key `repeatable` may be given more than once; its values are kept apart.
    Parameters(const TclWord& type, std::span<const TclWord> words, TclStore& store, std::string_view repeatable = {});

    bool has(std::string_view key) const { return values_.count(key) != 0; }
    /// Returns the key of `keys` that is given, or the first key if none is.
    std::string_view one_of(std::initializer_list<std::string_view> keys) const;

    /// The position of the key's value. If the key is missing, the position of the solid's type.
    std::size_t place_of(std::string_view key) const;
    const TclWord& take(std::string_view key);
    double number(std::string_view key);
    int integer(std::string_view key, int low, int high);
    std::uint32_t count(std::string_view key);  ///< 1 or more
    Vec3 vec3(std::string_view key);
    Matrix matrix(std::string_view key);
    template <std::size_t count>
    std::array<double, count> numbers(std::string_view key) {
        std::array<double, count> values{};
        read_numbers(take(key), key, values);
        return values;
    }
    /// Lists of any length: of numbers, of whole numbers below `end`, and of lists of numbers.
    std::vector<double> all_numbers(std::string_view key);
    std::vector<std::uint32_t> indices(std::string_view key, std::size_t end);
    std::vector<Vec3> points(std::string_view key);
    std::vector<Triangle> triangles(std::string_view key, std::size_t end);
    template <std::size_t count>
    std::vector<std::array<double, count>> rows(std::string_view key) {
        std::vector<std::array<double, count>> out;
        const TclWord& word = take(key);
        TclList elements(word, store_);
        for (TclWord element; elements.next(element);) read_numbers(element, key, out.emplace_back());
        return out;
    }
    const std::vector<const TclWord*>& repeated() const { return repeated_; }
    TclStore& store() const { return store_; }

    void end() const;

private:
    struct Value {
        std::size_t offset;
        const TclWord* word;
    };
    void read_numbers(const TclWord& list, std::string_view what, std::span<double> values) const;

    const TclWord& type_;
    TclStore& store_;
    std::unordered_map<std::string_view, Value> values_;
    std::vector<const TclWord*> repeated_;
};

/// The elements of a list, whole numbers below `end`.
std::vector<std::uint32_t> read_v5_indices(const TclWord& list, std::size_t end, TclStore& store);

}  // namespace csgrt
