#include "formats/source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <tuple>
#include <utility>

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

std::string read_file(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) refuse(path, "this is a folder, not a file");
    errno = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) refuse(path, std::string("cannot be opened: ") + std::strerror(errno));

    std::string bytes;
    const auto known_size = std::filesystem::file_size(path, ignored);
    if (!ignored && known_size <= max_file_bytes) bytes.reserve(static_cast<std::size_t>(known_size));
    char chunk[1 << 16];
    while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file.get())) {
        if (bytes.size() + count > max_file_bytes) {
            refuse(path, "the file is larger than " + std::to_string(max_file_bytes >> 20) + " MiB", "split the model");
        }
        bytes.append(chunk, count);
    }
    if (std::ferror(file.get())) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
    return bytes;
}

void Findings::add(std::size_t offset, std::string object, std::string message, std::string suggestion) {
    if (full()) return;
    diagnostics_.push_back({source_.place(offset, std::move(object)), std::move(message), std::move(suggestion),
                            source_.excerpt(offset)});
}

void Findings::bear(Fault fault, const std::string& object, const char* done) {
    if (borne_ == nullptr) return add(std::move(fault), object);
    borne_->push_back({object, source_.place(fault.offset, object), std::move(fault.message) + "; " + done, 1});
}

void Findings::throw_if_any() {
    if (diagnostics_.empty()) return;
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.place.line, a.place.column, a.place.offset) <
               std::tie(b.place.line, b.place.column, b.place.offset);
    });
    throw Error(Status::scene, std::exchange(diagnostics_, {}));
}

}  // namespace csgrt
