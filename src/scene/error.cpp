#include <csgrt/error.hpp>

#include <utility>

namespace csgrt {

namespace {

/// Appends a line break, `indent` and the line, for every line of `text`.
void append_indented(std::string& out, const std::string& text, const char* indent) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = text.find('\n', begin);
        out += '\n';
        out += indent;
        out.append(text, begin, end == std::string::npos ? std::string::npos : end - begin);
        if (end == std::string::npos) break;
        begin = end + 1;
    }
}

/// The text "file:line:column" or "file: byte offset", without the parts that are not known.
std::string position(const Place& place) {
    std::string out = place.file;
    if (place.line > 0) {
        if (!out.empty()) out += ':';
        out += std::to_string(place.line);
        if (place.column > 0) out += ':' + std::to_string(place.column);
    } else if (place.offset >= 0) {
        if (!out.empty()) out += ": ";
        out += "byte " + std::to_string(place.offset);
    }
    return out;
}

std::string format_all(const std::vector<Diagnostic>& diagnostics) {
    std::string out;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (!out.empty()) out += '\n';
        out += format(diagnostic);
    }
    return out;
}

}  // namespace

std::string format(const Diagnostic& diagnostic) {
    const Place& place = diagnostic.place;
    std::string out = position(place);
    if (!out.empty()) out += ": ";
    if (!place.pointer.empty()) out += place.pointer + ": ";
    out += diagnostic.message;
    if (!diagnostic.excerpt.empty()) append_indented(out, diagnostic.excerpt, "    ");
    if (!diagnostic.suggestion.empty()) append_indented(out, diagnostic.suggestion, "  ");
    return out;
}

std::string format(const Warning& warning) {
    std::string out = position(warning.place);
    if (!out.empty()) out += ": ";
    if (!warning.object.empty()) out += warning.object + ": ";
    out += warning.reason;
    if (warning.count > 1) out += " (" + std::to_string(warning.count) + " times)";
    return out;
}

Error::Error(Status status, std::string message)
    : std::runtime_error(message), status_(status), diagnostics_{Diagnostic{{}, std::move(message), {}, {}}} {}

Error::Error(Status status, std::vector<Diagnostic> diagnostics)
    : std::runtime_error(format_all(diagnostics)), status_(status), diagnostics_(std::move(diagnostics)) {}

}  // namespace csgrt
