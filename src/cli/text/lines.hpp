// Lines: reads a text file line by line, with findings that name a place in it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt::cli {

struct Word {
    std::string_view text;
    int column = 1;  ///< in bytes, from 1
};

/// Reads a file of any size through a buffer. Throws Error (interrupted) after an interrupt.
class LineReader {
public:
    enum class Passes { one, several };

    /// "-" is standard input. With Passes::several, a file that cannot be rewound is first copied to a temporary file
    /// without a name. Throws Error (file).
    LineReader(const std::string& path, Passes passes);

    /// The next line without its line break; false at the end. The view is valid until the next call.
    bool next(std::string_view& line);
    /// Goes back to the first line. Only with Passes::several.
    void rewind();

    const std::string& name() const { return name_; }
    int line_number() const { return line_number_; }

    /// A finding at a column of the current line, in bytes from 1, with the line as its excerpt.
    Diagnostic finding(int column, std::string message, std::string suggestion = {}) const;

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    using File = std::unique_ptr<std::FILE, Close>;

    [[noreturn]] void fail(const std::string& what, int code) const;
    [[noreturn]] void refuse_endless(int line) const;
    void spool();
    std::size_t read(char* into, std::size_t size);

    std::string name_;
    File file_;
    std::string buffer_;
    std::size_t begin_ = 0, end_ = 0;  ///< the unread part of the buffer
    std::string_view line_;
    int line_number_ = 0;
};

/// Splits a line at blanks. Overwrites `words`, whose memory can be reused from line to line.
void split(std::string_view line, std::vector<Word>& words);

}  // namespace csgrt::cli
