// BRL-CAD's newer text form, a script of Tcl commands:
//
//     title {text}    units mm
//     color low high r g b                    the colour of region ids low to high
//     put {name} type key value ...           a solid
//     put {name} comb region yes tree {...}   a combination
//     attr set {name} {key} {value} ...       what else belongs to an object, or to _GLOBAL, the database
//
// Lengths are millimetres; the unit is for display.
#include <algorithm>
#include <cctype>
#include <unordered_set>
#include <utility>
#include <vector>

#include "formats/brlcad_asc.hpp"
#include "formats/brlcad_objects.hpp"
#include "formats/brlcad_shader.hpp"
#include "formats/brlcad_v5_solids.hpp"
#include "formats/brlcad_v5_tree.hpp"
#include "formats/brlcad_values.hpp"
#include "formats/tcl_words.hpp"

namespace csgrt {

namespace {

constexpr int any_low = -2'147'483'647, any_high = 2'147'483'647;

std::string in_lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool read_flag(const TclWord& word) {
    const std::string text = in_lower_case(word.text);
    for (const char* yes : {"1", "yes", "y", "true", "on"}) {
        if (text == yes) return true;
    }
    for (const char* no : {"", "0", "no", "n", "false", "off"}) {
        if (text == no) return false;
    }
    throw Fault{word.offset, quoted(word.text) + " is neither yes nor no", {}};
}

/// R is a region; P and V are regions of FASTGEN, a plate and a volume.
bool read_region_flag(const TclWord& word) {
    return word.text == "R" || word.text == "P" || word.text == "V" || read_flag(word);
}

int read_any_integer(const TclWord& word) {
    return read_integer(word.text, word.offset, any_low, any_high);
}

/// "r/g/b" or "r g b".
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

/// Sets what the key stands for, in any of BRL-CAD's spellings; false if it is not one that csgrt knows.
bool set_attribute(Combination& combination, std::string_view name, const TclWord& value) {
    const std::string key = in_lower_case(name);
    if (key == "region") {
        combination.region = read_region_flag(value);
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

class V5Reader {
public:
    explicit V5Reader(const TextSource& source)
        : source_(source), findings_(source), commands_(source.text(), store_), objects_(findings_) {}

    Scene read() {
        while (!findings_.full()) {
            object_.clear();
            store_.clear();
            try {
                if (!commands_.next_command(words_)) break;
            } catch (Fault& fault) {
                // What was read of the command tells whose it is.
                if (words_.size() > 1 && words_[0].text == "put") {
                    object_ = tcl_name(words_[1]);
                    broken_.insert(object_);
                }
                findings_.add(std::move(fault), object_);
                commands_.skip_to({"put", "attr", "color", "title", "units"});
                continue;
            }
            try {
                read_command();
            } catch (Fault& fault) {
                if (words_[0].text == "put") broken_.insert(object_);
                findings_.add(std::move(fault), object_);
            }
        }
        findings_.throw_if_any();
        scene_.objects = objects_.take();
        return std::move(scene_);
    }

private:
    const TclWord& word(std::size_t index, const char* what) const {
        if (index < words_.size()) return words_[index];
        const TclWord& last = words_.back();
        const std::size_t end = last.offset_at(last.text.size());
        throw Fault{end, std::string("the command ends early: ") + what + " is missing", {}};
    }

    void read_command() {
        const std::string_view command = words_[0].text;
        if (command == "put") return read_put();
        if (command == "attr") return read_attributes();
        if (command == "color") return read_color_range();
        if (command == "title") return read_title();
        if (command == "units") return set_units(word(1, "the unit"));
        throw Fault{words_[0].offset, quoted(command) + " is no command of a database",
                    "commands are put, attr, color, title and units"};
    }

    void read_title() {
        scene_.title.clear();
        for (std::size_t i = 1; i < words_.size(); ++i) {
            if (i > 1) scene_.title += ' ';
            scene_.title += tcl_name(words_[i]);
        }
    }

    void set_units(const TclWord& name) {
        const double length = unit_in_millimetres(name.text);
        if (length == 0) {
            throw Fault{name.offset, quoted(name.text) + " is no unit", "units are mm, cm, m, in, ft, ..."};
        }
        scene_.units = name.text;
        scene_.unit_length = length;
    }

    void read_color_range() {
        word(5, "the colour's blue");
        if (words_.size() > 6) throw Fault{words_[6].offset, "the command should end here, but goes on", {}};
        add_color_range(words_, 1);
    }

    void add_color_range(const std::vector<TclWord>& values, std::size_t first) {
        int numbers[5];
        for (std::size_t i = 0; i < 5; ++i) {
            const TclWord& value = values[first + i];
            numbers[i] = i < 2 ? read_any_integer(value) : read_integer(value.text, value.offset, 0, 255);
        }
        scene_.region_colors.push_back({numbers[0], numbers[1], color_of_bytes(numbers[2], numbers[3], numbers[4])});
    }

    void read_put() {
        const TclWord& name = word(1, "the object's name");
        object_ = tcl_name(name);
        if (object_.empty()) throw Fault{name.offset, "the object's name is empty", {}};
        const TclWord& type = word(2, "the object's type");
        const auto rest = std::span<const TclWord>(words_).subspan(3);
        if (type.text == "comb") {
            objects_.add(read_combination(rest), name.offset);
        } else {
            Solid solid{object_, read_v5_solid(type, rest, store_), source_.place(words_[0].offset, object_)};
            objects_.add(std::move(solid), name.offset);
        }
    }

    Combination read_combination(std::span<const TclWord> rest) {
        Combination combination;
        combination.name = object_;
        combination.place = source_.place(words_[0].offset, object_);
        for (std::size_t i = 0; i < rest.size(); i += 2) {
            const TclWord& key = rest[i];
            if (i + 1 == rest.size()) throw Fault{key.offset, quoted(key.text) + " has no value", {}};
            const TclWord& value = rest[i + 1];
            if (key.text == "tree") {
                combination.tree = read_v5_tree(value, source_, object_, store_);
            } else if (!set_attribute(combination, key.text, value)) {
                throw Fault{key.offset, quoted(key.text) + " is no parameter of a comb", {}};
            }
        }
        return combination;
    }

    void read_attributes() {
        const TclWord& action = word(1, "set");
        if (action.text != "set") throw Fault{action.offset, quoted(action.text) + ": only attr set is known", {}};
        const TclWord& name = word(2, "the object's name");
        object_ = tcl_name(name);
        if (words_.size() % 2 == 0) {
            throw Fault{words_.back().offset, "attribute " + quoted(words_.back().text) + " has no value", {}};
        }
        if (object_ == "_GLOBAL") return read_global_attributes();
        Object* object = objects_.find(object_);
        if (object == nullptr) {
            if (broken_.count(object_) > 0) return;
            throw Fault{name.offset, "no object of that name stands before this line", {}};
        }
        auto* combination = std::get_if<Combination>(object);
        if (combination == nullptr) return;  // those of a solid do not matter to its shape
        for (std::size_t i = 3; i < words_.size(); i += 2) set_attribute(*combination, words_[i].text, words_[i + 1]);
    }

    void read_global_attributes() {
        for (std::size_t i = 3; i < words_.size(); i += 2) {
            const TclWord& value = words_[i + 1];
            if (words_[i].text == "title") {
                scene_.title = tcl_name(value);
            } else if (words_[i].text == "units") {
                set_unit_length(value);
            } else if (words_[i].text == "regionid_colortable") {
                read_color_table(value);
            }
        }
    }

    /// Here the unit is its length in millimetres.
    void set_unit_length(const TclWord& value) {
        const std::string name = unit_name(read_number(value.text, value.offset));
        if (name.empty()) throw Fault{value.offset, "no unit is " + quoted(value.text) + " mm long", {}};
        scene_.units = name;
        scene_.unit_length = unit_in_millimetres(name);
    }

    void read_color_table(const TclWord& value) {
        TclList entries(value, store_);
        for (TclWord entry; entries.next(entry);) {
            TclList elements(entry, store_);
            std::vector<TclWord> numbers;
            for (TclWord number; elements.next(number);) numbers.push_back(number);
            if (numbers.size() != 5) throw Fault{entry.offset, "an entry is five numbers: low high red green blue", {}};
            add_color_range(numbers, 0);
        }
    }

    const TextSource& source_;
    Findings findings_;
    TclStore store_;
    TclReader commands_;
    std::vector<TclWord> words_;
    BrlcadObjects objects_;
    std::unordered_set<std::string> broken_;  ///< objects whose put had a finding; their attributes are not another
    Scene scene_;
    std::string object_;  ///< the name of what is being read, as far as it is known
};

}  // namespace

Scene parse_brlcad_asc_v5(const TextSource& source) {
    return V5Reader(source).read();
}

}  // namespace csgrt
