#include "formats/brlcad/struct_text.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr int largest = std::numeric_limits<int>::max();

}  // namespace

StructText::StructText(std::string_view text, std::size_t offset) : offset_(offset) {
    for (std::size_t at = text.find_first_not_of(blanks); at < text.size(); at = text.find_first_not_of(blanks, at)) {
        const std::size_t equals = text.find('=', at);
        const std::string_view key = text.substr(at, equals - at);
        if (equals == std::string_view::npos || key.find_first_of(blanks) != std::string_view::npos) {
            throw Fault{offset + at, "parameters are written key=value", {}};
        }
        Value value{{}, offset + equals + 1};
        const bool quotes = text.substr(equals + 1).starts_with('"');
        std::size_t end = equals + (quotes ? 2 : 1);
        for (; end < text.size() && (quotes ? text[end] != '"' : blanks.find(text[end]) == std::string_view::npos);
             ++end) {
            if (quotes && text[end] == '\\' && end + 1 < text.size()) ++end;
            value.text += text[end];
        }
        if (quotes && end >= text.size()) throw Fault{value.offset, "this quote is never closed", {}};
        at = end + (quotes ? 1 : 0);
        if (!values_.try_emplace(std::string(key), std::move(value)).second) {
            throw Fault{offset + equals - key.size(), quoted(key) + " is given twice", {}};
        }
    }
}

std::size_t StructText::place_of(std::string_view key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? offset_ : found->second.offset;
}

StructText::Value StructText::take(std::string_view key) {
    const auto found = values_.find(key);
    if (found == values_.end()) throw Fault{offset_, "the solid has no " + std::string(key), {}};
    Value value = std::move(found->second);
    values_.erase(found);
    return value;
}

std::string StructText::text(std::string_view key) {
    Value value = take(key);
    if (value.text.empty()) throw Fault{value.offset, std::string(key) + " is empty", {}};
    return std::move(value.text);
}

int StructText::integer(std::string_view key, int low, int high) {
    const Value value = take(key);
    return read_integer(value.text, value.offset, low, high);
}

std::uint32_t StructText::count(std::string_view key) { return static_cast<std::uint32_t>(integer(key, 1, largest)); }

double StructText::number(std::string_view key) {
    const Value value = take(key);
    return read_number(value.text, value.offset);
}

/// Reads numbers and returns their count. A Fault if there are more than `values` can hold.
std::size_t StructText::read_numbers(const Value& list, std::span<double> values) const {
    const std::string_view text = list.text;
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size(); ++count) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        if (count == values.size()) throw Fault{list.offset, "there are more than " + std::to_string(count), {}};
        values[count] = read_number(text.substr(at, end - at), list.offset + at);
        at = end + 1;
    }
    return count;
}

Vec3 StructText::vec3(std::string_view key) {
    const Value value = take(key);
    double v[3];
    if (const std::size_t count = read_numbers(value, v); count != 3) {
        throw Fault{value.offset, std::string(key) + " has " + std::to_string(count) + " of 3 numbers", {}};
    }
    return {v[0], v[1], v[2]};
}

Matrix StructText::matrix(std::string_view key) {
    const Value value = take(key);
    Matrix matrix = identity;
    if (const std::size_t count = read_numbers(value, matrix); count < 12) {
        throw Fault{value.offset, std::string(key) + " has " + std::to_string(count) + " of 16 numbers", {}};
    }
    return without_scale(matrix);
}

void StructText::end() const {
    if (values_.empty()) return;
    const auto first = std::min_element(values_.begin(), values_.end(),
                                        [](const auto& a, const auto& b) { return a.second.offset < b.second.offset; });
    throw Fault{
        first->second.offset - first->first.size() - 1, quoted(first->first) + " is no parameter of the solid", {}};
}

namespace {

/// Reads the source of the cells. True: an object, "o". False: a file, "f", or "4" in older databases.
bool read_source(StructText& p) {
    if (!p.has("src")) return false;
    const std::string source = p.text("src");
    return source == "o";
}

/// Reads the name of the cells' source from the keys file and name. If both are given, the last one counts, as in
/// BRL-CAD.
std::string read_name(StructText& p) {
    const bool by_name = p.has("name") && (!p.has("file") || p.place_of("name") > p.place_of("file"));
    std::string name = p.text(by_name ? "name" : "file");
    if (const std::string_view other = by_name ? "file" : "name"; p.has(other)) p.text(other);
    return name;
}

std::string_view one_of(const StructText& p, std::string_view key, std::string_view other) {
    return p.has(key) ? key : other;
}

}  // namespace

BrlcadItem read_struct_ebm(StructText& p) {
    Ebm ebm;
    ebm.file = read_name(p);
    ebm.width = p.count("w");
    ebm.depth = p.count("n");
    ebm.height = p.number("d");
    if (p.has("mat")) ebm.matrix = p.matrix("mat");
    const bool in_object = read_source(p);
    p.end();
    return {Shape(std::move(ebm)), in_object};
}

BrlcadItem read_struct_vol(StructText& p) {
    Vol vol;
    vol.file = read_name(p);
    vol.width = p.count("w");
    vol.depth = p.count("n");
    vol.height = p.count("d");
    if (p.has("lo")) vol.low = static_cast<std::uint8_t>(p.integer("lo", 0, 255));
    if (p.has("hi")) vol.high = static_cast<std::uint8_t>(p.integer("hi", 0, 255));
    const std::string_view size = one_of(p, "size", "cellsize");
    if (p.has(size)) vol.cell = p.vec3(size);
    if (p.has("mat")) vol.matrix = p.matrix("mat");
    const bool in_object = read_source(p);
    p.end();
    return {Shape(std::move(vol)), in_object};
}

BrlcadItem read_struct_dsp(StructText& p) {
    Dsp dsp;
    dsp.file = read_name(p);
    dsp.width = p.count("w");
    dsp.depth = p.count("n");
    dsp.smooth = !p.has("sm") || p.integer("sm", -largest, largest) != 0;
    const std::size_t cut_at = p.place_of("cut");
    if (p.has("cut")) dsp.cut = read_cut(p.text("cut"), cut_at);
    if (p.has("stom")) dsp.matrix = p.matrix("stom");
    const bool in_object = read_source(p);
    p.end();
    return {Shape(std::move(dsp)), in_object};
}

}  // namespace csgrt
