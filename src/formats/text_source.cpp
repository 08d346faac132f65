#include "formats/text_source.hpp"

#include <algorithm>
#include <utility>

#include "scene/excerpt.hpp"

namespace csgrt {

TextSource TextSource::read(const std::string& path) { return TextSource(path, read_file(path)); }

TextSource::TextSource(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
    line_starts_.push_back(0);
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n', end + 1)) {
        line_starts_.push_back(end + 1);
    }
}

std::size_t TextSource::line_index(std::size_t offset) const {
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    return static_cast<std::size_t>(after - line_starts_.begin()) - 1;
}

std::string_view TextSource::line(std::size_t index) const {
    const std::size_t begin = line_starts_[index];
    std::size_t end = index + 1 < line_starts_.size() ? line_starts_[index + 1] - 1 : text_.size();
    if (end > begin && text_[end - 1] == '\r') --end;
    return std::string_view(text_).substr(begin, end - begin);
}

Place TextSource::place(std::size_t offset, std::string object) const {
    offset = std::min(offset, text_.size());
    const std::size_t index = line_index(offset);
    return {.file = name_,
            .line = static_cast<int>(index + 1),
            .column = static_cast<int>(offset - line_starts_[index] + 1),
            .offset = -1,
            .pointer = std::move(object)};
}

std::string TextSource::excerpt(std::size_t offset) const {
    offset = std::min(offset, text_.size());
    const std::size_t index = line_index(offset);
    return csgrt::excerpt(line(index), offset - line_starts_[index]);
}

}  // namespace csgrt
