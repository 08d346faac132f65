// Tables of densities, as BRL-CAD's gqa and rtweight read them: files, and the object _DENSITIES of databases.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <csgrt/measure.hpp>

#include "base/decimal.hpp"
#include "base/letters.hpp"
#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/g/object.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/tcl_words.hpp"
#include "formats/brlcad/values.hpp"
#include "formats/text_source.hpp"

namespace csgrt {

namespace {

constexpr std::string_view object_name = "_DENSITIES";
constexpr int numbers = 9;                            ///< of objects, the type of arrays of numbers
constexpr int signed_bytes = 12, unsigned_bytes = 4;  ///< types of their elements
constexpr std::string_view blanks = " \t\r";

/// Takes the first word of a text.
std::string_view take_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

/// A name without the blanks and the quotes around it.
std::string bare_name(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    return std::string(text);
}

/// Reads a line that is not empty. Throws Fault.
Density read_row(std::string_view key, std::string_view value, std::string_view name, std::size_t at) {
    Density row;
    if (key.front() == '/') {
        row.path = key;
    } else {
        const std::optional<double> id = finite_decimal(key);
        if (!id || *id != std::floor(*id) || std::abs(*id) > std::numeric_limits<int>::max())
            throw Fault{at, quoted(key) + " is neither the number of a material nor a path, which begins with '/'", {}};
        row.material_id = static_cast<int>(*id);
    }
    const std::optional<double> density = finite_decimal(value);
    if (!density || *density < 0) throw Fault{at, quoted(value) + " is no density in g/cm^3, 0 or more", {}};
    row.density = *density;
    row.name = bare_name(name);
    return row;
}

/// Reads the lines of a table. A wrong line is a finding.
std::vector<Density> read_table(std::string_view text, std::size_t begin, Findings& findings,
                                const std::string& object) {
    std::vector<Density> rows;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size()), at = begin;
        std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        line = line.substr(0, line.find_first_of(std::string_view("#\0", 2)));  // a database's text may end with a 0
        const std::string_view key = take_word(line), value = take_word(line);
        if (key.empty()) continue;
        try {
            rows.push_back(read_row(key, value, line, at));
        } catch (Fault& fault) {
            fault.suggestion = "a line is: number of a material or path, g/cm^3, name";
            findings.tolerate(std::move(fault), object, passed_over);
        }
    }
    return rows;
}

/// The text of the object _DENSITIES of a binary database. What is broken before it has no effect; load_scene() tells.
std::string text_in_g(const ByteSource& source) {
    for (std::size_t at = 0; at < source.bytes().size();) {
        GObject object;
        try {
            read_g_object(source, at, object);
            const bool is_bytes = object.minor == signed_bytes || object.minor == unsigned_bytes;
            if (object.major == numbers && is_bytes && object.name == object_name && !object.body.compressed)
                return std::string(object.body.bytes);
        } catch (const Fault&) {
        }
        if (object.end <= at) break;
        at = object.end;
    }
    return {};
}

/// The text of the object of a text database, which has: put _DENSITIES binunif T 12 D {hexadecimal digits}.
std::string text_in_asc(const TextSource& source) {
    std::size_t at = source.text().find(object_name);
    if (at == std::string_view::npos) return {};
    at = source.text().rfind('\n', at) + 1;  // 0 on the first line
    TclStore store;
    TclReader reader(source.text(), store, at);
    std::vector<TclWord> words;
    std::string text;
    try {
        if (!reader.next_command(words) || words.size() < 3 || words[2].text != "binunif") return {};
        for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
            if (words[i].text != "D") continue;
            TclList list(words[i + 1], store);
            for (TclWord digits; list.next(digits);) text += read_hexadecimal(digits.text, digits.offset);
        }
    } catch (const Fault&) {
        return {};
    }
    return text;
}

}  // namespace

std::vector<Density> load_densities(const std::string& path, std::vector<Warning>* warnings) {
    const std::string extension = lower(std::filesystem::path(path).extension().string());
    if (extension == ".json") return {};
    std::string bytes = read_file(path);
    std::string object;
    if (is_brlcad_g(bytes)) {
        object = object_name;
        bytes = text_in_g(ByteSource(path, std::move(bytes)));
    } else if (extension == ".asc") {
        object = object_name;
        bytes = text_in_asc(TextSource(path, std::move(bytes)));
    }
    const TextSource source(object.empty() ? path : path + ": " + object, std::move(bytes));
    Findings findings(source, warnings);
    std::vector<Density> rows = read_table(source.text(), source.begin(), findings, object);
    findings.throw_if_any();
    return rows;
}

}  // namespace csgrt
