#include "formats/brlcad/codes.hpp"

#include "formats/brlcad/values.hpp"
#include "formats/source.hpp"

namespace csgrt {

namespace {

unsigned value_of(std::string_view digits, std::size_t i, std::size_t offset) {
    const char digit = digits[i];
    if (digit >= '0' && digit <= '9') return static_cast<unsigned>(digit - '0');
    if (digit >= 'a' && digit <= 'f') return static_cast<unsigned>(digit - 'a' + 10);
    if (digit >= 'A' && digit <= 'F') return static_cast<unsigned>(digit - 'A' + 10);
    throw Fault{offset + i, quoted(digits.substr(i, 1)) + " is no hexadecimal digit", {}};
}

}  // namespace

std::vector<std::uint8_t> read_face_bits(std::string_view digits, std::size_t offset, std::size_t faces) {
    std::vector<std::uint8_t> bits(faces);
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const unsigned value = value_of(digits, i, offset);
        const std::size_t first = 4 * (digits.size() - 1 - i);
        for (std::size_t bit = 0; bit < 4 && first + bit < faces; ++bit) {
            bits[first + bit] = static_cast<std::uint8_t>(value >> bit & 1);
        }
    }
    return bits;
}

std::string read_hexadecimal(std::string_view digits, std::size_t offset) {
    if (digits.size() % 2 != 0) throw Fault{offset, "bytes have two hexadecimal digits each, here is an odd one", {}};
    std::string bytes;
    bytes.reserve(digits.size() / 2);
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        bytes += static_cast<char>(value_of(digits, i, offset) << 4 | value_of(digits, i + 1, offset));
    }
    return bytes;
}

Dsp::Cut read_cut(std::string_view text, std::size_t offset) {
    if (text == "a") return Dsp::Cut::adaptive;
    if (text == "l") return Dsp::Cut::lower_left;
    if (text == "L") return Dsp::Cut::upper_left;
    throw Fault{offset, quoted(text) + " is no cut of a dsp",
                "cuts are a (adaptive), l (lower left) and L (upper left)"};
}

}  // namespace csgrt
