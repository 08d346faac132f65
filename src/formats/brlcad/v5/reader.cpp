// Reader of BRL-CAD's newer text form, a script of Tcl commands:
//
//     title {text}    units mm
//     color low high r g b                    the colour of region ids low to high
//     put {name} type key value ...           a solid
//     put {name} comb region yes tree {...}   a combination
//     attr set {name} {key} {value} ...       attributes of an object, or of _GLOBAL, the database
//
// Lengths are in millimetres; the unit is for display.
#include <algorithm>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/v5/attributes.hpp"
#include "formats/brlcad/v5/solids.hpp"
#include "formats/brlcad/v5/tree.hpp"
#include "formats/brlcad/values.hpp"
#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

namespace {

/// The most bytes that are read again. A brace's end is searched up to the end of the file; if there is none, reading
/// goes on right after the command, so many unclosed braces would take quadratic time.
constexpr std::size_t most_read_again = std::size_t{1} << 28;

/// Reads a v5 text database command by command. A broken command becomes a finding, and reading goes on at the next.
class V5Reader {
public:
    V5Reader(const TextSource& source, bool lenient)
        : source_(source),
          scene_(brlcad_scene(lenient)),
          findings_(source, lenient ? &scene_.warnings : nullptr),
          commands_(source.text(), store_, source.begin()),
          objects_(findings_) {}

    Scene read() {
        while (read_again_ < most_read_again) {
            object_.clear();
            store_.clear();
            try {
                if (!commands_.next_command(words_)) break;
            } catch (Fault& fault) {
                // The command's words before the fault name its object.
                if (words_.size() > 1 && words_[0].text == "put") {
                    object_ = tcl_name(words_[1]);
                    broken_.insert(object_);
                }
                findings_.add(std::move(fault), object_);
                const std::size_t reached = commands_.offset();
                commands_.skip_to({"put", "attr", "color", "title", "units"});
                read_again_ += reached - std::min(reached, commands_.offset());
                continue;
            }
            try {
                read_command();
            } catch (Fault& fault) {
                tolerate(std::move(fault));
            }
        }
        if (read_again_ >= most_read_again) findings_.stop();
        findings_.throw_if_any();
        objects_.take(scene_, source_.name(), source_.file_folders);
        warn_of_shaders(scene_);
        return std::move(scene_);
    }

private:
    const TclWord& word(std::size_t index, const char* what) const {
        if (index < words_.size()) return words_[index];
        const TclWord& last = words_.back();
        const std::size_t end = last.offset_at(last.text.size());
        throw Fault{end, std::string("the command ends early: ") + what + " is missing", {}};
    }

    /// Tolerates a fault, unless the command is unknown: then the file is of another kind.
    void tolerate(Fault fault) {
        const std::string_view command = words_[0].text;
        if (command == "put") {
            broken_.insert(object_);
            objects_.add_broken(object_, words_.size() > 2 ? tcl_name(words_[2]) : "solid", std::move(fault));
        } else if (command == "attr" || command == "color" || command == "title" || command == "units") {
            findings_.tolerate(std::move(fault), object_, passed_over);
        } else {
            findings_.add(std::move(fault), object_);
        }
    }

    void read_command() {
        const std::string_view command = words_[0].text;
        if (command == "put") return read_put();
        if (command == "attr") return read_attributes();
        if (command == "color") return read_color_command();
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
        scene_.units = unit_name(length);
        scene_.unit_length = length;
    }

    void read_color_command() {
        word(5, "the colour's blue");
        if (words_.size() > 6) throw Fault{words_[6].offset, "the command should end here, but goes on", {}};
        scene_.region_colors.push_back(read_region_color(std::span<const TclWord, 5>(&words_[1], 5)));
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
            BrlcadItem item = read_v5_object(type, rest, store_);
            objects_.add(object_, std::move(item), source_.place(words_[0].offset, object_), name.offset);
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
                continue;
            }
            if (key.text == "material" || key.text == "temp") continue;  // they change no shape and no colour
            try {
                if (!set_attribute(combination, {key.text, value}))
                    throw Fault{key.offset, quoted(key.text) + " is no parameter of a comb", {}};
            } catch (Fault& fault) {
                if (!findings_.is_lenient()) throw;
                findings_.tolerate(std::move(fault), object_, passed_over);
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
        std::vector<Attribute> attributes;
        for (std::size_t i = 3; i < words_.size(); i += 2) attributes.push_back({words_[i].text, words_[i + 1]});
        if (object_ == "_GLOBAL") {
            for (const Attribute& attribute : attributes) {
                try {
                    set_global_attribute(scene_, attribute, source_);
                } catch (Fault& fault) {
                    findings_.tolerate(std::move(fault), object_, passed_over);
                }
            }
            return;
        }
        if (!objects_.contains(object_)) {
            if (broken_.count(object_) > 0) return;
            throw Fault{name.offset, "no object of that name stands before this line", {}};
        }
        Combination* combination = objects_.find_combination(object_);
        if (combination == nullptr) return;  // attributes of a solid do not change its shape
        set_attributes(*combination, attributes, findings_);
    }

    const TextSource& source_;
    Scene scene_;
    Findings findings_;
    std::size_t read_again_ = 0;
    TclStore store_;
    TclReader commands_;
    std::vector<TclWord> words_;
    BrlcadObjects objects_;
    std::unordered_set<std::string> broken_;  ///< objects whose `put` had a finding: their attributes add no second
                                              ///< finding
    std::string object_;                      ///< the name of the current object, once it is known
};

}  // namespace

Scene parse_brlcad_asc_v5(const TextSource& source, bool lenient) { return V5Reader(source, lenient).read(); }

}  // namespace csgrt
