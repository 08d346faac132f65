#include "values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/decimal.hpp"
#include "base/letters.hpp"
#include "scene/nearest.hpp"

namespace csgrt::cli {

namespace {

std::string_view without_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

constexpr std::pair<std::string_view, Axis> axis_names[] = {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};

/// The parts before and after the last colon.
std::optional<std::pair<std::string_view, std::string_view>> parts_of(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon == text.npos) return std::nullopt;
    return std::pair{text.substr(0, colon), text.substr(colon + 1)};
}

}  // namespace

std::optional<double> parse_number(std::string_view text) { return finite_decimal(text); }

std::optional<Vec3> parse_vector(std::string_view text) {
    double numbers[3];
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == text.npos) != (i == 2)) return std::nullopt;
        const auto number = parse_number(text.substr(0, comma));
        if (!number) return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(comma == text.npos ? text.size() : comma + 1);
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
}

std::optional<std::array<std::uint32_t, 3>> parse_cells(std::string_view text) {
    const auto given = parse_vector(text);
    if (!given) return std::nullopt;
    const double numbers[] = {given->x, given->y, given->z};
    std::array<std::uint32_t, 3> cells;
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(numbers[i] >= 1 && numbers[i] < 0x1p32 && numbers[i] == std::floor(numbers[i]))) return std::nullopt;
        cells[i] = static_cast<std::uint32_t>(numbers[i]);
    }
    return cells;
}

std::optional<double> parse_bound(std::string_view text) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (same_word(text, "inf") || same_word(text, "+inf")) return infinity;
    return same_word(text, "-inf") ? -infinity : parse_number(text);
}

std::optional<Plane> parse_plane(std::string_view text) {
    const auto parts = parts_of(text);
    if (!parts) return std::nullopt;
    const auto axis = find_name(axis_names, parts->first);
    const auto normal = axis ? Vec3{double(*axis == Axis::x), double(*axis == Axis::y), double(*axis == Axis::z)}
                             : parse_vector(parts->first);
    const auto offset = parse_number(parts->second);
    if (!normal || *normal == Vec3{} || !offset) return std::nullopt;
    return Plane{*normal, *offset};
}

std::optional<Look> parse_look_color(std::string_view text) {
    const std::size_t colon = text.rfind(':');  // a path may have colons
    if (colon == text.npos || !text.starts_with('/')) return std::nullopt;
    const auto color = parse_vector(text.substr(colon + 1));
    if (!color) return std::nullopt;
    for (const double part : {color->x, color->y, color->z})
        if (!(part >= 0 && part <= 1)) return std::nullopt;
    return Look{.path = std::string(text.substr(0, colon)), .color = color};
}

std::optional<std::pair<Axis, int>> parse_grid(std::string_view text) {
    const auto parts = parts_of(text);
    if (!parts) return std::nullopt;
    const auto axis = find_name(axis_names, parts->first);
    const auto count = parse_count(parts->second);
    if (!axis || !count || *count < 1 || *count > max_side) return std::nullopt;
    return std::pair{*axis, static_cast<int>(*count)};
}

std::string number_fault(std::string_view text) {
    double value = 0;
    return decimal_fault(read_decimal(text, value), std::string(text));
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
    std::uint64_t value = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::pair<int, int>> parse_size(std::string_view text) {
    constexpr std::string_view sign = "\xC3\x97";  // the sign of multiplication
    const std::size_t cross = std::min(text.find_first_of("xX*"), text.find(sign));
    const std::size_t length = text.substr(std::min(cross, text.size())).starts_with(sign) ? sign.size() : 1;
    auto width = parse_count(without_blanks(text.substr(0, cross)));
    auto height = cross == text.npos ? width : parse_count(without_blanks(text.substr(cross + length)));
    auto fits = [](const std::optional<std::uint64_t>& side) { return side && *side >= 1 && *side <= max_side; };
    if (!fits(width) || !fits(height)) return std::nullopt;
    return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
}

std::optional<std::uint64_t> parse_memory(std::string_view text) {
    constexpr std::string_view prefixes = "kmgt";
    int shift = 0;
    text = without_blanks(text);
    if (!text.empty() && lower(text.back()) == 'b') {
        text.remove_suffix(1);
        if (text.size() > 1 && text.back() == 'i' && prefixes.find(lower(text[text.size() - 2])) != prefixes.npos)
            text.remove_suffix(1);
    }
    if (!text.empty()) {
        auto prefix = prefixes.find(lower(text.back()));
        if (prefix != prefixes.npos) {
            shift = 10 * static_cast<int>(prefix + 1);
            text.remove_suffix(1);
        }
    }
    text = without_blanks(text);
    if (auto count = parse_count(text)) {
        if (*count == 0 || *count > std::numeric_limits<std::uint64_t>::max() >> shift) return std::nullopt;
        return *count << shift;
    }
    // A fraction of a unit is allowed, as in 1.5G.
    constexpr double most = 1e18;
    const auto fraction = text.find('.') != text.npos && shift > 0 ? parse_number(text) : std::nullopt;
    const double bytes = fraction ? std::ldexp(*fraction, shift) : 0;
    return bytes >= 1 && bytes <= most ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

bool same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& names) {
    auto begun =
        std::find_if(names.begin(), names.end(), [&](std::string_view name) { return name.starts_with(word); });
    if (word.size() > 2 && begun != names.end()) return "did you mean '" + std::string(*begun) + "'?";
    return did_you_mean(word, names);
}

}  // namespace csgrt::cli
