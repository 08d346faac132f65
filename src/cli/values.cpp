#include "values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "scene/nearest.hpp"

namespace csgrt::cli {

namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
    Number value{};
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    auto value = parse_whole<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

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

std::optional<std::uint64_t> parse_count(std::string_view text) { return parse_whole<std::uint64_t>(text); }

std::optional<std::pair<int, int>> parse_size(std::string_view text) {
    auto cross = text.find('x');
    auto width = parse_count(text.substr(0, cross));
    auto height = cross == text.npos ? width : parse_count(text.substr(cross + 1));
    auto fits = [](const std::optional<std::uint64_t>& side) { return side && *side >= 1 && *side <= max_side; };
    if (!fits(width) || !fits(height)) return std::nullopt;
    return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
}

std::optional<std::uint64_t> parse_memory(std::string_view text) {
    constexpr std::string_view suffixes = "KMGT";
    int shift = 0;
    if (!text.empty()) {
        auto suffix = suffixes.find(text.back());
        if (suffix != suffixes.npos) {
            shift = 10 * static_cast<int>(suffix + 1);
            text.remove_suffix(1);
        }
    }
    auto count = parse_count(text);
    if (!count || *count == 0 || *count > std::numeric_limits<std::uint64_t>::max() >> shift) return std::nullopt;
    return *count << shift;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& names) {
    auto begun =
        std::find_if(names.begin(), names.end(), [&](std::string_view name) { return name.starts_with(word); });
    if (word.size() > 2 && begun != names.end()) return "did you mean '" + std::string(*begun) + "'?";
    return did_you_mean(word, names);
}

}  // namespace csgrt::cli
