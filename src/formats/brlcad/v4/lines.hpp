// Lines and fields of BRL-CAD's older text form.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "formats/brlcad/values.hpp"
#include "formats/text_source.hpp"

namespace csgrt {

/// A line without its end, and its position in the file.
struct Line {
    std::string_view text;
    std::size_t offset = 0;
};

/// Reads a text line by line.
class LineReader {
public:
    /// Reads the lines from `begin` on.
    explicit LineReader(std::string_view text, std::size_t begin = 0) : text_(text), next_(begin) {}

    bool at_end() const { return next_ >= text_.size(); }
    /// The next line, without taking it. Empty at the end.
    Line peek() const {
        const std::string_view rest = text_.substr(std::min(next_, text_.size()));
        std::string_view line = rest.substr(0, rest.find('\n'));
        if (line.ends_with('\r')) line.remove_suffix(1);
        return {line, next_};
    }
    Line take() {
        const Line line = peek();
        const std::size_t end = text_.find('\n', next_);
        next_ = end == std::string_view::npos ? text_.size() : end + 1;
        return line;
    }

private:
    std::string_view text_;
    std::size_t next_;
};

/// A field of a line, and its position in the file.
struct Field {
    std::string_view text;
    std::size_t offset = 0;
};

/// Reads the fields of one line, separated by blanks. A missing or wrong field is a Fault at its position.
class Fields {
public:
    explicit Fields(const Line& line) : line_(line) { skip_blanks(); }

    bool more() const { return at_ < line_.text.size(); }
    std::size_t offset() const { return line_.offset + at_; }

    Field next(const char* what) {
        if (!more()) throw Fault{offset(), std::string("the record ends early: ") + what + " is missing", {}};
        const std::size_t end = std::min(line_.text.find_first_of(" \t", at_), line_.text.size());
        const Field field{line_.text.substr(at_, end - at_), offset()};
        at_ = end;
        skip_blanks();
        return field;
    }
    /// Takes the rest of the line.
    Field rest() {
        const Field field{line_.text.substr(at_), offset()};
        at_ = line_.text.size();
        return field;
    }
    int integer(const char* what, int low = -2'147'483'647, int high = 2'147'483'647) {
        const Field field = next(what);
        return read_integer(field.text, field.offset, low, high);
    }
    std::uint32_t count(const char* what) { return static_cast<std::uint32_t>(integer(what, 0)); }
    template <std::size_t count>
    std::array<double, count> numbers(const char* what) {
        std::array<double, count> values{};
        for (std::size_t i = 0; i < count; ++i) {
            if (!more()) {
                throw Fault{offset(),
                            "the record ends early: " + std::to_string(i) + " of " + std::to_string(count) + ' ' + what,
                            {}};
            }
            const Field field = next(what);
            values[i] = read_number(field.text, field.offset);
        }
        return values;
    }
    void end() {
        if (more()) throw Fault{offset(), "the record should end here, but goes on", {}};
    }

private:
    void skip_blanks() { at_ = std::min(line_.text.find_first_not_of(" \t", at_), line_.text.size()); }

    Line line_;
    std::size_t at_ = 0;
};

}  // namespace csgrt
