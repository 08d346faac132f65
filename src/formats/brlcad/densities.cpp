#include "formats/brlcad/densities.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <csgrt/measure.hpp>
#include <csgrt/scene_io.hpp>

#include "base/decimal.hpp"
#include "base/letters.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

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

}  // namespace

std::vector<Density> read_densities(const TextSource& source, const std::string& object,
                                    std::vector<Warning>* warnings) {
    Findings findings(source, warnings);
    std::vector<Density> rows;
    for (std::size_t begin = source.begin(); begin < source.text().size();) {
        const std::size_t end = std::min(source.text().find('\n', begin), source.text().size()), at = begin;
        std::string_view line = source.text().substr(begin, end - begin);
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
    findings.throw_if_any();
    return rows;
}

std::vector<Density> load_densities(const std::string& path, std::vector<Warning>* warnings) {
    std::string bytes = read_file(path);
    const std::string extension = lower(std::filesystem::path(path).extension().string());
    if (extension != ".json" && extension != ".asc" && !is_brlcad_g(bytes))
        return read_densities(TextSource(path, std::move(bytes)), {}, warnings);
    Scene scene = parse_scene(std::move(bytes), path);
    std::vector<Diagnostic> wrong;
    for (Warning& warning : scene.warnings) {
        if (warning.object != densities_name) continue;
        if (warnings)
            warnings->push_back(std::move(warning));
        else
            wrong.push_back({warning.place, warning.reason, {}, {}});
    }
    if (!wrong.empty()) throw Error(Status::scene, std::move(wrong));
    return std::move(scene.densities);
}

}  // namespace csgrt
