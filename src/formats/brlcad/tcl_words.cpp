#include "formats/brlcad/tcl_words.hpp"

#include <algorithm>
#include <utility>

namespace csgrt {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

int digit_of(char c, int base) {
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : base;
    return digit < base ? digit : -1;
}

void append_utf8(std::string& out, unsigned code) {
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xC0 | (code >> 6));
        out += static_cast<char>(0x80 | (code & 0x3F));
    } else {
        out += static_cast<char>(0xE0 | (code >> 12));
        out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
        out += static_cast<char>(0x80 | (code & 0x3F));
    }
}

/// Appends the character whose code, of up to `most` digits, is at `at`, and moves `at` past the digits. False if there
/// is no digit.
bool append_code(std::string& out, std::string_view text, std::size_t& at, int base, int most) {
    unsigned code = 0;
    int digits = 0;
    for (; digits < most && at < text.size() && digit_of(text[at], base) >= 0; ++digits, ++at) {
        code = code * static_cast<unsigned>(base) + static_cast<unsigned>(digit_of(text[at], base));
    }
    if (digits > 0) append_utf8(out, code);
    return digits > 0;
}

/// Replaces Tcl's backslash sequences.
std::string without_backslashes(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] != '\\' || at + 1 == text.size()) {
            out += text[at++];
            continue;
        }
        const char c = text[++at];
        constexpr std::string_view letters = "abfnrtv", characters = "\a\b\f\n\r\t\v";
        if (const std::size_t known = letters.find(c); known != std::string_view::npos) {
            out += characters[known];
            ++at;
        } else if (c == '\n') {
            // The end of a continued line, and the blanks after it, become one blank.
            at = std::min(text.find_first_not_of(" \t", at + 1), text.size());
            out += ' ';
        } else if (digit_of(c, 8) >= 0) {
            append_code(out, text, at, 8, 3);
        } else if (c == 'x' || c == 'u') {
            ++at;
            if (!append_code(out, text, at, 16, c == 'x' ? 2 : 4)) out += c;
        } else {
            out += c;
            ++at;
        }
    }
    return out;
}

}  // namespace

void TclReader::fail(std::size_t index, std::string message, std::string suggestion) const {
    throw Fault{source_.offset_at(index), std::move(message), std::move(suggestion)};
}

bool TclReader::ends_word(char c) const { return is_blank(c) || c == '\n' || (script_ && c == ';'); }

/// The length of a line's continuation at this position, which counts as a blank: a backslash and the end of a line.
std::size_t TclReader::continuation() const {
    const std::string_view rest = source_.text.substr(std::min(at_, source_.text.size()));
    return rest.starts_with("\\\n") ? 2 : rest.starts_with("\\\r\n") ? 3 : 0;
}

void TclReader::expect_word_end(const char* after) const {
    if (!at_end() && !ends_word(peek()) && continuation() == 0) {
        fail(at_, std::string("something follows ") + after + " without a blank",
             "a brace too many, or too few before it?");
    }
}

TclWord TclReader::value(std::size_t begin, std::size_t end, bool has_backslashes) {
    const std::string_view raw = source_.text.substr(begin, end - begin);
    if (!has_backslashes) return {raw, source_.offset_at(begin), source_.in_source, false};
    store_.push_back(without_backslashes(raw));
    return {store_.back(), source_.offset_at(begin), false, false};
}

TclWord TclReader::braced_word() {
    const std::size_t open = at_;
    std::size_t depth = 0;
    while (true) {
        at_ = source_.text.find_first_of("{}\\", at_);
        if (at_ == std::string_view::npos || (peek() == '\\' && at_ + 1 >= source_.text.size())) {
            at_ = source_.text.size();
            fail(open, "this brace is never closed");
        }
        const char c = peek();
        if (c == '\\') ++at_;  // an escaped brace does not count
        if (c == '{') ++depth;
        if (c == '}') --depth;
        ++at_;
        if (depth == 0) break;
    }
    expect_word_end("the closing brace");
    TclWord word = value(open + 1, at_ - 1, false);
    word.braced = true;
    return word;
}

TclWord TclReader::quoted_word() {
    const std::size_t open = at_++;
    bool has_backslashes = false;
    for (; !at_end() && peek() != '"'; ++at_) {
        if (script_ && (peek() == '$' || peek() == '[')) fail(at_, "Tcl would replace this; a database cannot");
        if (peek() != '\\') continue;
        has_backslashes = true;
        if (at_ + 1 < source_.text.size()) ++at_;
    }
    if (at_end()) fail(open, "this quote is never closed");
    ++at_;
    expect_word_end("the closing quote");
    return value(open + 1, at_ - 1, has_backslashes);
}

TclWord TclReader::bare_word() {
    const std::size_t begin = at_;
    bool has_backslashes = false;
    for (; !at_end() && !ends_word(peek()); ++at_) {
        if (script_ && (peek() == '$' || peek() == '[')) {
            fail(at_, "Tcl would replace this; a database cannot", "put the word in braces");
        }
        if (peek() != '\\') continue;
        if (continuation() > 0) break;
        has_backslashes = true;
        if (at_ + 1 < source_.text.size()) ++at_;
    }
    return value(begin, at_, has_backslashes);
}

TclWord TclReader::next_word() {
    if (peek() == '{') return braced_word();
    if (peek() == '"') return quoted_word();
    return bare_word();
}

bool TclReader::next_command(std::vector<TclWord>& words) {
    words.clear();
    while (!at_end()) {
        if (const std::size_t length = continuation()) {
            at_ += length;
        } else if (is_blank(peek())) {
            ++at_;
        } else if (peek() == '\n' || peek() == ';') {
            ++at_;
            if (!words.empty()) return true;
        } else if (peek() == '#' && words.empty()) {
            at_ = std::min(source_.text.find('\n', at_), source_.text.size());
        } else {
            if (words.empty()) command_ = at_;
            words.push_back(next_word());
        }
    }
    return !words.empty();
}

void TclReader::skip_to(const std::vector<std::string_view>& names) {
    at_ = command_;
    while (true) {
        const std::size_t end = source_.text.find('\n', at_);
        at_ = end == std::string_view::npos ? source_.text.size() : end + 1;
        if (at_end()) return;
        const std::string_view rest = source_.text.substr(at_);
        const bool found = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
            return rest.starts_with(name) && rest.size() > name.size() && is_blank(rest[name.size()]);
        });
        if (found) return;
    }
}

bool TclList::next(TclWord& element) {
    while (!reader_.at_end() && (reader_.ends_word(reader_.peek()) || reader_.continuation() > 0)) ++reader_.at_;
    if (reader_.at_end()) return false;
    element = reader_.next_word();
    return true;
}

std::string tcl_name(const TclWord& word) {
    std::string name(word.text);
    if (!word.braced) return name;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] == '\\' && i + 1 < name.size() && (name[i + 1] == '{' || name[i + 1] == '}')) ++i;
        name[kept++] = name[i];
    }
    name.resize(kept);
    return name;
}

}  // namespace csgrt
