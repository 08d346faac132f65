// Text source: a text file in memory, and places in it. All text formats share this.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/source.hpp"
#include "scene/byte_order_mark.hpp"

namespace csgrt {

/// The text of a file. Offsets are bytes from its start; lines end in "\n" or "\r\n".
class TextSource : public Source {
public:
    /// Reads a file whole. Throws Error (file) if it cannot be read or is larger than max_file_bytes.
    static TextSource read(const std::string& path);

    /// `name`: the file's name in diagnostics.
    TextSource(std::string name, std::string text);

    const std::string& name() const noexcept { return name_; }
    std::string_view text() const noexcept { return text_; }
    /// The beginning of the text, after a byte order mark.
    std::size_t begin() const noexcept { return text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; }

    /// Line and column (in bytes, from 1) of an offset; `object` becomes the pointer.
    Place place(std::size_t offset, std::string object = {}) const override;

    /// The line around an offset, shortened to the width of a terminal, a newline, and a caret under the offset.
    std::string excerpt(std::size_t offset) const override;

private:
    std::size_t line_index(std::size_t offset) const;
    std::string_view line(std::size_t index) const;

    std::string name_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
};

}  // namespace csgrt
