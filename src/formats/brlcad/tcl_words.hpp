// Tcl words, as far as databases need them: commands and lists of words, with braces, quotes and backslashes. Nothing
// is executed: a $ or [ that Tcl would replace is a Fault.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text_source.hpp"

namespace csgrt {

/// A word: its value and its position. The value is a part of the source, except where backslashes were replaced.
struct TclWord {
    std::string_view text;
    std::size_t offset = 0;  ///< of the value's first character in the source
    bool in_source = true;   ///< `text` is a part of the source, so `offset` holds for each character of it
    bool braced = false;

    /// The position in the source of the value's character `index`, or of the word if the value is not a part of the
    /// source.
    std::size_t offset_at(std::size_t index) const { return in_source ? offset + index : offset; }
};

/// Memory for values that are not a part of the source. The elements of a deque never move.
using TclStore = std::deque<std::string>;

/// Reads one word after another. The time is linear in the text's length, however deep its braces are.
class TclReader {
public:
    /// Reads the commands from `begin` on.
    TclReader(std::string_view text, TclStore& store, std::size_t begin = 0) : TclReader(TclWord{text}, store, true) {
        at_ = begin;
    }

    /// Reads the next command of a script: words up to the end of a line or a ';'. Comments are skipped. False at the
    /// end. Throws Fault; then `skip_to` finds the next command.
    bool next_command(std::vector<TclWord>& words);

    /// Skips to the next line that starts with one of the names and a blank. The search begins after the last command's
    /// first line.
    void skip_to(const std::vector<std::string_view>& names);

    std::size_t offset() const { return source_.offset_at(at_); }

private:
    friend class TclList;
    TclReader(const TclWord& source, TclStore& store, bool script) : source_(source), store_(store), script_(script) {}

    TclWord next_word();
    TclWord braced_word();
    TclWord quoted_word();
    TclWord bare_word();
    TclWord value(std::size_t begin, std::size_t end, bool has_backslashes);
    void expect_word_end(const char* after) const;
    std::size_t continuation() const;
    bool ends_word(char c) const;
    bool at_end() const { return at_ >= source_.text.size(); }
    char peek() const { return source_.text[at_]; }
    [[noreturn]] void fail(std::size_t index, std::string message, std::string suggestion = {}) const;

    TclWord source_;
    TclStore& store_;
    bool script_;  ///< false: a list, where newlines separate words and $ [ ; have no meaning
    std::size_t at_ = 0;
    std::size_t command_ = 0;  ///< the position of the last command
};

/// Reads the elements of a word that is a list.
class TclList {
public:
    TclList(const TclWord& list, TclStore& store) : reader_(list, store, false) {}

    /// Reads the next element. False at the end. Throws Fault.
    bool next(TclWord& element);
    std::size_t offset() const { return reader_.offset(); }

private:
    TclReader reader_;
};

/// The name in a word. g2asc writes a name's braces as \{ and \} inside braces, where Tcl would keep the backslashes.
/// They are removed here, so that the combinations that use the object find it.
std::string tcl_name(const TclWord& word);

}  // namespace csgrt
