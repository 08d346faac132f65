#include "formats/source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "scene/nearest.hpp"

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

namespace {

/// The file in the path's folder that was probably meant.
std::string nearest_file(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    constexpr std::size_t most = 10'000;
    std::vector<std::string> names;
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator() && names.size() < most; entry.increment(error))
        names.push_back(entry->path().filename().string());
    std::sort(names.begin(), names.end());
    return did_you_mean(path.filename().string(), {names.begin(), names.end()});
}

std::string read_all(std::FILE* file, const std::string& name, std::size_t expected) {
    std::string bytes;
    if (expected <= max_file_bytes) bytes.reserve(expected);
    char chunk[1 << 16];
    while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file)) {
        if (bytes.size() + count > max_file_bytes) {
            refuse(name, "the file is larger than " + std::to_string(max_file_bytes >> 20) + " MiB", "split the model");
        }
        bytes.append(chunk, count);
    }
    if (std::ferror(file)) {
        const int code = errno;
        refuse(name, std::string("cannot be read: ") + (code == EBADF ? "it is closed" : std::strerror(code)));
    }
    return bytes;
}

}  // namespace

std::string read_file(const std::string& path) {
    std::error_code ignored;
    if (path.find('\0') != path.npos) refuse(path.c_str(), "cannot be opened: the name of a file has no NUL");
    if (std::filesystem::is_directory(path, ignored)) refuse(path, "this is a folder, not a file");
    errno = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) {
        const int code = errno;
        refuse(path, std::string("cannot be opened: ") + std::strerror(code), code == ENOENT ? nearest_file(path) : "");
    }
    const auto known_size = std::filesystem::file_size(path, ignored);
    return read_all(file.get(), path, ignored ? 0 : static_cast<std::size_t>(known_size));
}

std::vector<std::string> file_folders_of(const std::string& model, const std::vector<std::string>& allowed) {
    std::vector<std::string> folders = allowed;
    const std::string own = std::filesystem::path(model).parent_path().string();
    folders.push_back(own.empty() ? "." : own);
    return folders;
}

std::string read_standard_input() { return read_all(stdin, standard_input, 0); }

void Findings::add(std::size_t offset, std::string object, std::string message, std::string suggestion) {
    if (list_.full()) return list_.leave_out();  // only counted: its place is not searched
    list_.add(
        {source_.place(offset, std::move(object)), std::move(message), std::move(suggestion), source_.excerpt(offset)});
}

void Findings::tolerate(Fault fault, const std::string& object, const char* done) {
    if (tolerated_ == nullptr) return add(std::move(fault), object);
    tolerated_->push_back({object, source_.place(fault.offset, object), std::move(fault.message) + "; " + done, 1});
}

void Findings::throw_if_any() {
    if (list_.empty()) return;
    list_.sort_by_place();
    throw Error(Status::scene, list_.take());
}

}  // namespace csgrt
