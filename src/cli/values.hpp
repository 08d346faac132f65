// Readers of values on the command line and in files of rays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/rays.hpp>
#include <csgrt/scene.hpp>

namespace csgrt::cli {

inline constexpr int max_side =
    32'768;  ///< pixels; a larger picture has more than a billion rays, which is surely a mistake

/// Reads a finite number, the whole of `text`; a leading plus is allowed. See decimal.hpp.
std::optional<double> parse_number(std::string_view text);

/// The reason why parse_number() refuses `text`.
std::string number_fault(std::string_view text);

/// Reads "X,Y,Z": three finite numbers.
std::optional<Vec3> parse_vector(std::string_view text);

/// Reads a finite number, "inf" or "-inf".
std::optional<double> parse_bound(std::string_view text);

/// Reads "z:2.5" or "1,0,1:2.5": a normal other than 0, and a distance.
std::optional<Plane> parse_plane(std::string_view text);

/// Reads "/all/x.r:1,0.5,0": a path and a colour.
std::optional<Look> parse_look_color(std::string_view text);

/// Reads "x:512": an axis, and a number from 1 to max_side.
std::optional<std::pair<Axis, int>> parse_grid(std::string_view text);

/// Reads "NX,NY,NZ": numbers of cells, each from 1 to 2^32 - 1.
std::optional<std::array<std::uint32_t, 3>> parse_cells(std::string_view text);

/// Reads a decimal whole number, the whole of `text`.
std::optional<std::uint64_t> parse_count(std::string_view text);

/// Reads "1024" or "1920x1080", each side from 1 to max_side. Between the sides may be x, X, * or the sign of
/// multiplication, and blanks.
std::optional<std::pair<int, int>> parse_size(std::string_view text);

/// Reads bytes: a number, with K, M, G or T for powers of 1024, as "512M", "512 MiB" or "1.5gb"; at least 1.
std::optional<std::uint64_t> parse_memory(std::string_view text);

/// Whether both words are the same except for upper and lower case.
bool same_word(std::string_view a, std::string_view b);

/// The value that `text` names in a table of pairs, in upper or lower case.
template <class Value, std::size_t count>
std::optional<Value> find_name(const std::pair<std::string_view, Value> (&names)[count], std::string_view text) {
    for (const auto& [name, value] : names)
        if (same_word(name, text)) return value;
    return std::nullopt;
}

/// "did you mean 'name'?" for the name that begins with `word` or is nearest to it; empty if none is.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& names);

}  // namespace csgrt::cli
