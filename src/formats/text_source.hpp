// A text file in memory, its places, and what a reader found wrong in it. Shared by every text format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

/// The text of a file. Offsets are bytes from its start; lines end in "\n" or "\r\n".
class TextSource {
public:
    /// Largest file that is read. Real scenes are a hundred times smaller; an endless device must not fill the memory.
    static constexpr std::size_t max_bytes = std::size_t{256} << 20;

    /// Reads a file whole. Throws Error (file) if it cannot be read or is larger than max_bytes.
    static TextSource read(const std::string& path);

    /// `name` is what diagnostics call the file.
    TextSource(std::string name, std::string text);

    const std::string& name() const noexcept { return name_; }
    std::string_view text() const noexcept { return text_; }

    /// Line and column (in bytes, from 1) of an offset; `object` becomes the pointer.
    Place place(std::size_t offset, std::string object = {}) const;

    /// The line around an offset, shortened to what a terminal shows, a newline, and a caret under the offset.
    std::string excerpt(std::size_t offset) const;

private:
    std::size_t line_index(std::size_t offset) const;
    std::string_view line(std::size_t index) const;

    std::string name_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
};

/// Thrown inside a reader to give up one record. The reader turns it into a finding and goes on with the next record;
/// it never leaves the reader.
struct Fault {
    std::size_t offset = 0;
    std::string message;
    std::string suggestion;
};

/// What is wrong in one file, reported all at once.
class Findings {
public:
    /// More than these help nobody; a reader stops when `full`.
    static constexpr std::size_t limit = 50;

    explicit Findings(const TextSource& source) : source_(source) {}

    void add(std::size_t offset, std::string object, std::string message, std::string suggestion = {});
    void add(Fault fault, std::string object) {
        add(fault.offset, std::move(object), std::move(fault.message), std::move(fault.suggestion));
    }
    bool empty() const noexcept { return diagnostics_.empty(); }
    bool full() const noexcept { return diagnostics_.size() >= limit; }

    /// Throws Error (scene) with every finding, in the order of the file; does nothing if there is none.
    void throw_if_any();

private:
    const TextSource& source_;
    std::vector<Diagnostic> diagnostics_;
};

}  // namespace csgrt
