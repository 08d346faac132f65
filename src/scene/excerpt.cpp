#include "scene/excerpt.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace csgrt {

namespace {

/// The number of a line's bytes that are shown. In a longer line, at most `shown_before` of them are before the column.
constexpr std::size_t shown = 110, shown_before = 70;

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::string excerpt(std::string_view line, std::size_t column) {
    column = std::min(column, line.size());
    std::size_t begin = line.size() <= shown || column <= shown_before ? 0 : column - shown_before;
    std::size_t end = std::min(line.size(), begin + shown);
    while (begin > 0 && continues_character(line[begin])) --begin;
    while (end < line.size() && continues_character(line[end])) ++end;

    std::string text = begin > 0 ? "..." : "";
    std::string caret(text.size(), ' ');
    for (std::size_t i = begin; i < end; ++i) {
        // A control character in the file must not act on the terminal that shows the message.
        const auto c = static_cast<unsigned char>(line[i]);
        text += c < 0x20 || c == 0x7F ? ' ' : line[i];
        if (i < column && !continues_character(line[i])) caret += ' ';
    }
    if (end < line.size()) text += "...";
    return text + '\n' + caret + '^';
}

std::string excerpt(const Place& place) {
    std::error_code ignored;
    // Only a plain file can be read a second time.
    if (place.line <= 0 || place.column <= 0 || !std::filesystem::is_regular_file(place.file, ignored)) return {};
    std::ifstream file(place.file, std::ios::binary);
    std::string line;
    for (int i = 0; i < place.line; ++i) {
        if (!std::getline(file, line)) return {};
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return excerpt(line, static_cast<std::size_t>(place.column) - 1);
}

}  // namespace csgrt
