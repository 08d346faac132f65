// Decimal numbers: scenes of any format, files of rays and the command line all read them by these functions. The value
// is the nearest double. A number too small for a double becomes 0 with its sign. A number too large is refused.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace csgrt {

enum class Decimal { number, no_number, not_finite, too_large };

/// Whether a decimal out of the range of double is too small, rather than too large. The position of its first digit
/// other than 0 and its exponent decide.
inline bool is_below_doubles(std::string_view digits) {
    if (digits.starts_with('-')) digits.remove_prefix(1);
    const std::size_t letter = std::min(digits.find_first_of("eE"), digits.size());
    const std::string_view mantissa = digits.substr(0, letter),
                           power = digits.substr(std::min(letter + 1, digits.size()));
    constexpr std::int64_t far = std::int64_t{1} << 40;  // more digits than any file has
    std::int64_t exponent = 0;
    if (!power.empty()) {
        const char* begin = power.data() + power.starts_with('+');
        const auto [end, status] = std::from_chars(begin, power.data() + power.size(), exponent);
        const bool huge = status == std::errc::result_out_of_range || exponent > far || exponent < -far;
        if (huge) exponent = power.starts_with('-') ? -far : far;
    }
    const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
    const auto first = static_cast<std::int64_t>(std::min(mantissa.find_first_of("123456789"), mantissa.size()));
    return point - first + exponent < 0;
}

/// Reads the whole of `text`; a leading plus is allowed.
inline Decimal read_decimal(std::string_view text, double& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status == std::errc::invalid_argument || end != text.data() + text.size()) return Decimal::no_number;
    if (status == std::errc::result_out_of_range) {
        if (!is_below_doubles(text)) return Decimal::too_large;
        value = text[0] == '-' ? -0.0 : 0.0;
        return Decimal::number;
    }
    return std::isfinite(value) ? Decimal::number : Decimal::not_finite;
}

/// The whole of `text` as a number. Nothing if it is not a finite number.
inline std::optional<double> finite_decimal(std::string_view text) {
    double value = 0;
    return read_decimal(text, value) == Decimal::number ? std::optional(value) : std::nullopt;
}

/// The message about a faulty number: every reader uses the same words.
inline std::string decimal_fault(Decimal found, const std::string& text) {
    if (found == Decimal::too_large) return "the number " + text + " is too large for a double";
    return "'" + text + (found == Decimal::not_finite ? "' is not a finite number" : "' is not a number");
}

/// Appends the shortest text that is read as the same double.
inline void append_shortest(std::string& out, double value) {
    char text[32];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}
inline std::string shortest(double value) {
    std::string text;
    append_shortest(text, value);
    return text;
}

}  // namespace csgrt
