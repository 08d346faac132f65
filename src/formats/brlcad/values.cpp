#include "formats/brlcad/values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/decimal.hpp"
#include "base/letters.hpp"
#include "formats/text_source.hpp"

namespace csgrt {

namespace {

struct Unit {
    std::string_view name;
    double millimetres;
};
/// BRL-CAD's units and their lengths, with names in small letters and without blanks, because BRL-CAD ignores both. As
/// in BRL-CAD, the first unit of a length gives the name that is written, and the first unit of a name is meant (mm,
/// not Mm).
constexpr Unit units[] = {
    {"mm", 1},
    {"none", 1},
    {"millimeter", 1},
    {"ym", 1e-21},
    {"yoctometer", 1e-21},
    {"zm", 1e-18},
    {"zeptometer", 1e-18},
    {"am", 1e-15},
    {"attometer", 1e-15},
    {"fm", 1e-12},
    {"femtometer", 1e-12},
    {"pm", 1e-9},
    {"picometer", 1e-9},
    {"angstrom", 1e-7},
    {"decinanometer", 1e-7},
    {"nm", 1e-6},
    {"nanometer", 1e-6},
    {"um", 1e-3},
    {"micrometer", 1e-3},
    {"micron", 1e-3},
    {"cm", 10},
    {"centimeter", 10},
    {"dm", 100},
    {"decimeter", 100},
    {"m", 1000},
    {"meter", 1000},
    {"decameter", 1e4},
    {"hm", 1e5},
    {"hectometer", 1e5},
    {"km", 1e6},
    {"kilometer", 1e6},
    {"megameter", 1e9},
    {"gm", 1e12},
    {"gigameter", 1e12},
    {"tm", 1e15},
    {"terameter", 1e15},
    {"petameter", 1e18},
    {"em", 1e21},
    {"exameter", 1e21},
    {"zettameter", 1e24},
    {"yottameter", 1e27},
    {"in", 25.4},
    {"inch", 25.4},
    {"inches", 25.4},
    {"hand", 101.6},
    {"ft", 304.8},
    {"foot", 304.8},
    {"feet", 304.8},
    {"cubit", 456.2},
    {"yd", 914.4},
    {"yard", 914.4},
    {"rd", 5029.2},
    {"rod", 5029.2},
    {"chain", 20116.8},
    {"furlong", 201168},
    {"mi", 1609344},
    {"mile", 1609344},
    {"nmile", 1852000},
    {"nauticalmile", 1852000},
    {"league", 5556000},
    {"lightsecond", 2.99792458e11},
    {"lightminute", 1.79875475e13},
    {"au", 1.495979e14},
    {"astronomicalunit", 1.495979e14},
    {"lighthour", 1.07925285e15},
    {"lightday", 2.59020684e16},
    {"lightyear", 9.4605284e18},
    {"pc", 3.08568025e19},
    {"parsec", 3.08568025e19},
};

/// The name of a unit, as BRL-CAD compares names: without blanks, in small letters, without the s of a plural.
std::string plain_unit_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (std::string_view(" \t\n\v\f\r").find(c) == std::string_view::npos) plain += lower(c);
    if (plain.ends_with('s')) plain.pop_back();
    return plain;
}

/// The relative difference below which two units count as equal, because files hold rounded decimals.
constexpr double unit_gap = 1e-9;

/// Elements of a matrix's last row below this size count as rounding, not as perspective. In a model smaller than 1e6
/// metres such an element moves a point by less than a thousandth of its distance from the origin.
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
    const std::string plain = plain_unit_name(name);
    for (const Unit& unit : units) {
        if (plain_unit_name(unit.name) == plain) return unit.millimetres;
    }
    return 0;
}

std::string unit_name(double millimetres) {
    for (const Unit& unit : units) {
        if (std::abs(unit.millimetres - millimetres) <= unit_gap * unit.millimetres) return std::string(unit.name);
    }
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), millimetres).ptr;
    return std::string(digits.data(), end) + " mm";
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

Matrix without_scale(Matrix matrix) {
    const double w = matrix[15];
    for (std::size_t i = 12; i < 15; ++i) {
        if (std::abs(matrix[i]) <= perspective_noise * std::abs(w)) matrix[i] = 0;
    }
    if (w == 0 || w == 1) return matrix;
    for (std::size_t i = 0; i < 15; ++i) matrix[i] /= w;
    matrix[15] = 1;
    return matrix;
}

Fastgen fastgen_of(std::string_view flag) {
    return flag == "P" ? Fastgen::plate : flag == "V" ? Fastgen::volume : Fastgen::none;
}

Vec3 color_of_bytes(int r, int g, int b) { return {r / 255.0, g / 255.0, b / 255.0}; }

}  // namespace csgrt
