#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <csgrt/image.hpp>

#include "image/encode.hpp"

namespace csgrt {

namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
    const int code = errno;
    throw Error(Status::file, path + ": " + what + ": " + std::strerror(code));
}

void write_all(int file, const std::vector<unsigned char>& bytes, const std::string& path) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "cannot write");
        done += static_cast<std::size_t>(written);
    }
}

/// A file beside `path`, under a name of its own until it is whole; removed if it never is.
class NewFile {
public:
    explicit NewFile(const std::string& path) : path_(path) {
        for (int attempt = 0; file_ < 0; ++attempt) {
            temporary_ = path + ".part" + std::to_string(attempt);
            file_ = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
            if (file_ < 0 && errno != EEXIST) {
                temporary_.clear();
                fail(path_, "cannot create");
            }
        }
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile() {
        if (file_ >= 0) close(file_);
        if (!temporary_.empty()) unlink(temporary_.c_str());
    }
    void write(const std::vector<unsigned char>& bytes) { write_all(file_, bytes, path_); }
    void keep() {
        if (close(std::exchange(file_, -1)) != 0) fail(path_, "cannot write");
        if (rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot replace");
        temporary_.clear();
    }

private:
    std::string path_, temporary_;
    int file_ = -1;
};

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension.empty() ? extension : extension.substr(1);
}

}  // namespace

void write_image(const Image& image, const std::string& path, const std::string& format) {
    if (path == "-") {
        std::fflush(stdout);
        write_all(STDOUT_FILENO, encode(image, format, "standard output"), "standard output");
        return;
    }
    const std::vector<unsigned char> bytes = encode(image, extension_of(path), path);
    NewFile file(path);
    file.write(bytes);
    file.keep();
}

}  // namespace csgrt
