#include "device/bytes_text.hpp"

#include <charconv>
#include <iterator>

namespace csgrt {

std::string bytes_text(std::uint64_t bytes) {
    static constexpr const char* units[] = {"KiB", "MiB", "GiB", "TiB"};
    if (bytes < 1024) return std::to_string(bytes) + " bytes";
    double value = static_cast<double>(bytes) / 1024;
    int unit = 0;
    for (; value >= 1024 && unit < 3; ++unit) value /= 1024;
    char text[32];  // to_chars, because printf would write the locale's comma
    const auto [end, status] = std::to_chars(std::begin(text), std::end(text), value, std::chars_format::fixed, 1);
    return std::string(text, end) + ' ' + units[unit];
}

}  // namespace csgrt
