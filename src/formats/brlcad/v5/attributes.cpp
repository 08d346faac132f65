#include "formats/brlcad/v5/attributes.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/letters.hpp"
#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

constexpr int any_low = -2'147'483'647, any_high = 2'147'483'647;

/// Is the spelling of a key the one that BRL-CAD writes today?
bool is_standard(std::string_view key) {
    constexpr std::string_view keys[] = {"region", "region_id", "aircode", "material_id",
                                         "los",    "color",     "shader",  "inherit"};
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

bool read_flag(const TclWord& word) {
    const std::string text = lower(std::string(word.text));
    for (const char* yes : {"1", "yes", "y", "true", "on"}) {
        if (text == yes) return true;
    }
    for (const char* no : {"", "0", "no", "n", "false", "off"}) {
        if (text == no) return false;
    }
    throw Fault{word.offset, quoted(word.text) + " is neither yes nor no", {}};
}

/// Reads a region's flag. R is a region; P and V are regions of FASTGEN, a plate and a volume.
void read_region_flag(Combination& combination, const TclWord& word) {
    combination.fastgen = fastgen_of(word.text);
    combination.region = word.text == "R" || combination.fastgen != Fastgen::none || read_flag(word);
}

int read_any_integer(const TclWord& word) { return read_integer(word.text, word.offset, any_low, any_high); }

/// Reads "r/g/b" or "r g b".
Vec3 read_color(const TclWord& word) {
    constexpr std::string_view separators = "/ \t,";
    int components[3];
    std::size_t at = 0;
    for (int& component : components) {
        at = std::min(word.text.find_first_not_of(separators, at), word.text.size());
        const std::size_t end = std::min(word.text.find_first_of(separators, at), word.text.size());
        if (at == end) {
            throw Fault{word.offset, quoted(word.text) + " is no colour", "write red/green/blue, each 0 to 255"};
        }
        component = read_integer(word.text.substr(at, end - at), word.offset_at(at), 0, 255);
        at = end;
    }
    if (word.text.find_first_not_of(separators, at) != std::string_view::npos) {
        throw Fault{word.offset_at(at), "a colour has three components", {}};
    }
    return color_of_bytes(components[0], components[1], components[2]);
}

/// Reads the unit, which is written as a length in millimetres. The unit is only for display, so a wrong length is
/// tolerated, as in BRL-CAD.
void set_unit_length(Scene& scene, const TclWord& value, const Source& source) {
    double length = 0;
    try {
        length = read_number(value.text, value.offset);
    } catch (const Fault&) {
        // reported below
    }
    if (length > 0) {
        scene.units = unit_name(length);
        const double known = unit_in_millimetres(scene.units);  // exact, while the file's decimals are rounded
        scene.unit_length = known > 0 ? known : length;
    } else {
        scene.warnings.push_back({{},
                                  source.place(value.offset, "_GLOBAL"),
                                  quoted(value.text) + " is no length of a unit in millimetres; it is left out"});
    }
}

void read_color_table(Scene& scene, const TclWord& value) {
    TclStore store;
    TclList entries(value, store);
    for (TclWord entry; entries.next(entry);) {
        TclList elements(entry, store);
        std::vector<TclWord> numbers;
        for (TclWord number; elements.next(number);) numbers.push_back(number);
        if (numbers.size() != 5) throw Fault{entry.offset, "an entry is five numbers: low high red green blue", {}};
        scene.region_colors.push_back(read_region_color(std::span<const TclWord, 5>(numbers)));
    }
}

}  // namespace

bool set_attribute(Combination& combination, const Attribute& attribute) {
    const std::string key = lower(std::string(attribute.key));
    const TclWord& value = attribute.value;
    if (key == "region") {
        read_region_flag(combination, value);
    } else if (key == "region_id" || key == "id") {
        combination.region_id = read_any_integer(value);
    } else if (key == "air" || key == "aircode") {
        combination.air = read_any_integer(value);
    } else if (key == "material_id" || key == "giftmater" || key == "mat") {
        combination.material_id = read_any_integer(value);
    } else if (key == "los") {
        combination.los = read_any_integer(value);
    } else if (key == "rgb" || key == "color") {
        combination.color = read_color(value);
    } else if (key == "shader" || key == "oshader") {
        combination.finish.reset();
        if (Finish finish = read_finish(value.text); !finish.shader.empty()) combination.finish = std::move(finish);
    } else if (key == "inherit") {
        combination.color_inherits = combination.finish_inherits = read_flag(value);
    } else {
        return false;
    }
    return true;
}

void set_attributes(Combination& combination, std::span<const Attribute> attributes, Findings& findings) {
    for (const bool standard : {false, true}) {
        for (const Attribute& attribute : attributes) {
            if (is_standard(attribute.key) != standard) continue;
            try {
                set_attribute(combination, attribute);
            } catch (Fault& fault) {
                findings.tolerate(std::move(fault), combination.name, passed_over);
            }
        }
    }
}

void set_global_attribute(Scene& scene, const Attribute& attribute, const Source& source) {
    const auto& [key, value] = attribute;
    if (key == "title") {
        scene.title = tcl_name(value);
    } else if (key == "units") {
        set_unit_length(scene, value, source);
    } else if (key == "regionid_colortable") {
        read_color_table(scene, value);
    }
}

RegionColor read_region_color(std::span<const TclWord, 5> numbers) {
    int rgb[3];
    const int low = read_any_integer(numbers[0]), high = read_any_integer(numbers[1]);
    for (std::size_t i = 0; i < 3; ++i) rgb[i] = read_integer(numbers[i + 2].text, numbers[i + 2].offset, 0, 255);
    return {low, high, color_of_bytes(rgb[0], rgb[1], rgb[2])};
}

}  // namespace csgrt
