// Cells: solids of the newer text form whose cells are in another file or object.

#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/v5/solids.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

/// Reads the source of the cells. True: an object, "o". False: a file, "f", or "4" in older databases.
bool read_source(Parameters& p) {
    if (!p.has("src")) return false;
    const TclWord& word = p.take("src");
    if (word.text == "o") return true;
    if (word.text == "f" || word.text == "4") return false;
    throw Fault{word.offset, quoted(word.text) + " is no kind of source", "f is a file, o an object"};
}

/// Reads the name of the cells' source. BRL-CAD writes the key file, name or both, and older programs write F. If
/// several are given, the last one counts, as in BRL-CAD.
std::string read_name(Parameters& p) {
    std::string_view last = "file";
    for (const std::string_view key : {"file", "F", "name"}) {
        if (p.has(key) && (!p.has(last) || p.place_of(key) > p.place_of(last))) last = key;
    }
    const TclWord& word = p.take(last);
    if (word.text.empty()) throw Fault{word.offset, std::string(last) + " is empty", {}};
    for (const std::string_view key : {"file", "F", "name"}) {
        if (p.has(key)) p.take(key);
    }
    return std::string(word.text);
}

}  // namespace

BrlcadItem read_v5_ebm(Parameters& p) {
    Ebm ebm;
    ebm.file = read_name(p);
    ebm.width = p.count(p.one_of({"W", "w"}));
    ebm.depth = p.count(p.one_of({"N", "n"}));
    ebm.height = p.number(p.one_of({"H", "d"}));
    ebm.matrix = p.matrix(p.one_of({"M", "mat"}));
    const bool in_object = read_source(p);
    return {Shape(std::move(ebm)), in_object};
}

BrlcadItem read_v5_vol(Parameters& p) {
    Vol vol;
    vol.file = read_name(p);
    vol.width = p.count("w");
    vol.depth = p.count("n");
    vol.height = p.count("d");
    vol.low = static_cast<std::uint8_t>(p.integer("lo", 0, 255));
    vol.high = static_cast<std::uint8_t>(p.integer("hi", 0, 255));
    vol.cell = p.vec3(p.one_of({"size", "cellsize"}));
    vol.matrix = p.matrix(p.one_of({"mat", "M"}));
    const bool in_object = read_source(p);
    return {Shape(std::move(vol)), in_object};
}

BrlcadItem read_v5_dsp(Parameters& p) {
    Dsp dsp;
    dsp.file = read_name(p);
    dsp.width = p.count("w");
    dsp.depth = p.count("n");
    dsp.smooth = p.integer("sm", -largest_integer, largest_integer) != 0;
    if (p.has("cut")) {
        const TclWord& cut = p.take("cut");
        dsp.cut = read_cut(cut.text, cut.offset);
    }
    dsp.matrix = p.matrix("stom");
    const bool in_object = read_source(p);
    return {Shape(std::move(dsp)), in_object};
}

/// Reads numbers. T is their type; D has their bytes as hexadecimal digits, with blanks and newlines between them.
BrlcadNumbers read_v5_numbers(Parameters& p) {
    BrlcadNumbers numbers;
    numbers.type = p.integer("T", 0, 255);
    TclList words(p.take("D"), p.store());
    for (TclWord word; words.next(word);) numbers.data += read_hexadecimal(word.text, word.offset);
    return numbers;
}

}  // namespace csgrt
