#include "formats/brlcad/asc.hpp"

#include <algorithm>
#include <new>

#include "formats/text_source.hpp"

namespace csgrt {

namespace {

/// Is the text in the v4 form? Every v4 record starts with a word of one letter, and no Tcl command does. Both forms
/// may begin with comments and empty lines.
bool is_v4(std::string_view text) {
    while (true) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return false;
        if (text[begin] != '#') return text.find_first_of(" \t\r\n", begin) == begin + 1;
        text.remove_prefix(std::min(text.find('\n', begin), text.size()));
    }
}

}  // namespace

Scene read_brlcad_asc(const std::string& path, bool lenient, const std::vector<std::string>& file_folders) {
    try {
        TextSource source = TextSource::read(path);
        source.file_folders = file_folders_of(path, file_folders);
        return parse_brlcad_asc(source, lenient);
    } catch (const std::bad_alloc&) {
        throw Error(Status::out_of_memory, path + ": the model does not fit the memory");
    }
}

Scene parse_brlcad_asc(const TextSource& source, bool lenient) {
    const std::string_view text = source.text().substr(source.begin());
    Findings findings(source);
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
        findings.add(source.begin() + zero, {}, "a zero byte: this is no text",
                     "a binary database is read if its name ends in .g");
    } else if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        findings.add(0, {}, "the file is empty");
    }
    findings.throw_if_any();
    return is_v4(text) ? parse_brlcad_asc_v4(source, lenient) : parse_brlcad_asc_v5(source, lenient);
}

}  // namespace csgrt
