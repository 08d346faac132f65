#include "output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <unistd.h>

#include <csgrt/error.hpp>

#include "interrupt.hpp"

namespace csgrt::cli {

namespace fs = std::filesystem;

namespace {

bool special(const fs::path& path) {
    std::error_code ignored;
    auto type = fs::status(path, ignored).type();
    return type != fs::file_type::not_found && type != fs::file_type::regular && type != fs::file_type::directory &&
           type != fs::file_type::none;
}

/// The file itself where `path` leads over links, so that a link stays a link.
fs::path behind_links(const fs::path& path) {
    std::error_code error;
    fs::path real = fs::weakly_canonical(path, error);
    return error ? path : real;
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return !special(a);
    return behind_links(fs::absolute(a, error)) == behind_links(fs::absolute(b, error));
}

/// Why nothing can be written at `path`, or "".
std::string obstacle(const NamedFile& output) {
    std::error_code error;
    fs::path path = behind_links(output.path);
    if (fs::is_directory(path, error)) return "is a folder";
    if (special(path)) return output.replaced ? "is no regular file" : "";
    fs::path folder = fs::absolute(path, error).parent_path();
    if (!fs::exists(folder, error))
        return "the folder " + fs::path(output.path).parent_path().string() + " does not exist";
    if (!fs::is_directory(folder, error)) return fs::path(output.path).parent_path().string() + " is no folder";
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        return std::string("cannot write in its folder: ") + std::strerror(errno);
    if (fs::exists(path, error) && access(path.c_str(), W_OK) != 0)
        return std::string("cannot replace it: ") + std::strerror(errno);
    return "";
}

Diagnostic finding(const NamedFile& output, std::string message) {
    Diagnostic result;
    result.place.pointer = output.option;
    result.message = output.path + ": " + std::move(message);
    return result;
}

}  // namespace

void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    std::vector<Diagnostic> findings;
    Status status = Status::file;
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        auto clash = [&](const NamedFile& other) {
            return output->path == "-" || other.path == "-" ? output->path == other.path
                                                            : same_file(output->path, other.path);
        };
        auto earlier = std::find_if(outputs.begin(), output, clash);
        auto input = std::find_if(inputs.begin(), inputs.end(), [&](const NamedFile& other) {
            return other.path != "-" && clash(other);  // standard input is no output
        });
        std::string message;
        if (input != inputs.end())
            message = "would overwrite " + input->option;
        else if (earlier != output)
            message = output->path == "-" ? "standard output is taken by " + earlier->option
                                          : "is written by " + earlier->option + " already";
        if (!message.empty()) {
            status = Status::usage;
            findings.push_back(finding(*output, message));
        } else if (std::string why = output->path == "-" ? "" : obstacle(*output); !why.empty()) {
            findings.push_back(finding(*output, why));
        }
    }
    if (!findings.empty()) throw Error(status, std::move(findings));
}

OutputFile::OutputFile(const std::string& path) : name_(path == "-" ? "standard output" : path) {
    if (path == "-") {
        file_ = stdout;
        return;
    }
    target_ = behind_links(path).string();
    if (special(target_)) {
        file_ = std::fopen(target_.c_str(), "wb");
    } else {
        // Another name where a process that ended badly, and had our number, left its own.
        for (int attempt = 0; attempt < 100 && !file_; ++attempt) {
            temporary_ = target_ + "." + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".part";
            file_ = std::fopen(temporary_.c_str(), "wbx");
            if (!file_ && errno != EEXIST) break;
        }
    }
    if (!file_) {
        temporary_.clear();
        fail("cannot create");
    }
}

OutputFile::~OutputFile() {
    if (file_ && file_ != stdout) std::fclose(file_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::fail(const char* what) const {
    int code = errno;
    check_interrupt();  // a signal may be why
    throw Error(Status::file, name_ + ": " + what + ": " + std::strerror(code));
}

void OutputFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot write");
}

void OutputFile::commit() {
    if (std::fflush(file_) != 0) fail("cannot write");
    if (file_ == stdout) return;
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail("cannot write");
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot replace");
    temporary_.clear();
}

void print(std::string_view text) {
    OutputFile out("-");
    out.write(text);
    out.commit();
}

}  // namespace csgrt::cli
