#include "formats/brlcad_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "decimal.hpp"
#include "formats/text_source.hpp"

namespace csgrt {

namespace {

struct Unit {
    std::string_view name;
    double millimetres;
};
/// BRL-CAD's units and their other spellings; of units of one length the first is the name that is written.
constexpr Unit units[] = {
    {"mm", 1},      {"none", 1},     {"millimeter", 1}, {"um", 1e-3}, {"micrometer", 1e-3}, {"nm", 1e-6},
    {"cm", 10},     {"m", 1000},     {"meter", 1000},   {"km", 1e6},  {"in", 25.4},         {"inch", 25.4},
    {"ft", 304.8},  {"foot", 304.8}, {"feet", 304.8},   {"yd", 914.4}, {"yard", 914.4},     {"mi", 1609344},
    {"mile", 1609344},
};

/// Units that are equal but for the rounding of their decimals in a file.
constexpr double unit_gap = 1e-9;

/// Elements of a matrix's last row below this are rounding of the program that wrote it, not perspective: over any
/// model smaller than 1e6 metres they move a point by less than a part in a thousand.
constexpr double perspective_noise = 1e-12;

}  // namespace

std::string quoted(std::string_view text, std::size_t longest) {
    std::string out = "'";
    for (const char c : text.substr(0, longest)) out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return out + (text.size() > longest ? "...'" : "'");
}

double read_number(std::string_view text, std::size_t offset) {
    double value = 0;
    const Decimal found = read_decimal(text, value);
    if (found == Decimal::too_large) throw Fault{offset, decimal_fault(found, std::string(text.substr(0, 40))), {}};
    if (found == Decimal::no_number) throw Fault{offset, quoted(text) + " is not a number", {}};
    if (found == Decimal::not_finite) throw Fault{offset, quoted(text) + " is not a finite number", {}};
    return value;
}

int read_integer(std::string_view text, std::size_t offset, int low, int high) {
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const std::string_view digits = text.substr(plus ? 1 : 0);
    int value = 0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || status == std::errc::invalid_argument) {
        throw Fault{offset, quoted(text) + " is not a whole number", {}};
    }
    if (status == std::errc::result_out_of_range || value < low || value > high) {
        throw Fault{offset, quoted(text) + " is outside " + std::to_string(low) + " to " + std::to_string(high), {}};
    }
    return value;
}

double unit_in_millimetres(std::string_view name) {
    for (const Unit& unit : units) {
        if (unit.name == name) return unit.millimetres;
    }
    return 0;
}

std::string unit_name(double millimetres) {
    for (const Unit& unit : units) {
        if (std::abs(unit.millimetres - millimetres) <= unit_gap * unit.millimetres) return std::string(unit.name);
    }
    return {};
}

Vec3 unit_vector(const Vec3& v) {
    const double length = std::hypot(v.x, v.y, v.z);
    if (length == 0 || length == 1) return v;
    return {v.x / length, v.y / length, v.z / length};
}

Plane unit_plane(Vec3 normal, double distance) {
    const double length = std::hypot(normal.x, normal.y, normal.z);
    if (length == 0 || length == 1) return {normal, distance};
    return {{normal.x / length, normal.y / length, normal.z / length}, distance / length};
}

Matrix without_scale(Matrix matrix, std::size_t offset) {
    const double w = matrix[15];
    if (w == 0) throw Fault{offset, "the matrix's last element is 0, so its scale is infinite", {}};
    for (std::size_t i = 12; i < 15; ++i) {
        if (std::abs(matrix[i]) > perspective_noise * std::abs(w)) {
            throw Fault{offset, "the matrix is perspective: its last row is not 0 0 0 w",
                        "only rotation, scale, shear and translation can place a solid"};
        }
        matrix[i] = 0;
    }
    if (w == 1) return matrix;
    for (std::size_t i = 0; i < 12; ++i) {
        matrix[i] /= w;
        if (!std::isfinite(matrix[i])) throw Fault{offset, "the matrix's scale overflows", {}};
    }
    matrix[15] = 1;
    return matrix;
}

Fastgen fastgen_of(std::string_view flag) {
    return flag == "P" ? Fastgen::plate : flag == "V" ? Fastgen::volume : Fastgen::none;
}

Vec3 color_of_bytes(int r, int g, int b) {
    return {r / 255.0, g / 255.0, b / 255.0};
}

}  // namespace csgrt
