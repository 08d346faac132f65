#include "formats/text_source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <tuple>
#include <utility>

#include "scene/excerpt.hpp"

namespace csgrt {

namespace {

[[noreturn]] void refuse(const std::string& path, std::string message, std::string suggestion = {}) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = std::move(message);
    diagnostic.suggestion = std::move(suggestion);
    throw Error(Status::file, std::vector{std::move(diagnostic)});
}

}  // namespace

TextSource TextSource::read(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path, "this is a folder, not a file");
    errno = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) refuse(path, std::string("cannot be opened: ") + std::strerror(errno));

    std::string text;
    const auto known_size = std::filesystem::file_size(path, ignored);
    if (!ignored && known_size <= max_bytes) text.reserve(static_cast<std::size_t>(known_size));
    char chunk[1 << 16];
    while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file.get())) {
        if (text.size() + count > max_bytes) {
            refuse(path, "the file is larger than " + std::to_string(max_bytes >> 20) + " MiB", "split the model");
        }
        text.append(chunk, count);
    }
    if (std::ferror(file.get())) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
    return TextSource(path, std::move(text));
}

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

void Findings::add(std::size_t offset, std::string object, std::string message, std::string suggestion) {
    if (full()) return;
    diagnostics_.push_back({source_.place(offset, std::move(object)), std::move(message), std::move(suggestion),
                            source_.excerpt(offset)});
}

void Findings::throw_if_any() {
    if (diagnostics_.empty()) return;
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    throw Error(Status::scene, std::exchange(diagnostics_, {}));
}

}  // namespace csgrt
