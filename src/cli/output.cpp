#include "output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <csgrt/error.hpp>

#include "base/letters.hpp"
#include "interrupt.hpp"

namespace csgrt::cli {

namespace fs = std::filesystem;

namespace {

/// The path of the file itself, after all links.
fs::path behind_links(const std::string& name) {
    std::error_code error;
    const fs::path path = fs::absolute(target_of(name).path, error), real = fs::weakly_canonical(path, error);
    return error ? path : real;
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return !target_of(a).direct;
    return behind_links(a) == behind_links(b);
}

/// The reason why nothing can be written at `path`, or "".
std::string obstacle(const std::string& name) {
    std::error_code error;
    const Target target = target_of(name);
    if (target.endless) return "is a link that leads to itself";
    if (target.descriptor >= 0 && fcntl(target.descriptor, F_GETFD) < 0) return "is not open";
    if (target.direct) return "";
    if (fs::is_directory(target.path, error)) return "is a folder";
    fs::path folder = fs::absolute(target.path, error).parent_path();
    if (!fs::exists(folder, error)) return "the folder " + target.path.parent_path().string() + " does not exist";
    if (!fs::is_directory(folder, error)) return target.path.parent_path().string() + " is no folder";
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        return std::string("cannot write in its folder: ") + std::strerror(errno);
    if (fs::exists(target.path, error) && access(target.path.c_str(), W_OK) != 0)
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

std::string extension_of(const std::string& path) { return lower(fs::path(path).extension().string()); }

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
            return other.path != "-" && clash(other);  // standard input is not an output
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
        } else if (std::string why = output->path == "-" ? "" : obstacle(output->path); !why.empty()) {
            findings.push_back(finding(*output, why));
        }
    }
    std::vector<std::string> piped;
    for (const NamedFile& input : inputs)
        if (input.path == "-") piped.push_back(input.option);
    if (piped.size() > 1) {
        status = Status::usage;
        Diagnostic both;
        both.place.pointer = piped[1];
        both.message = "standard input is taken by " + piped[0];
        both.suggestion = "give one of the two as a file";
        findings.push_back(std::move(both));
    }
    if (!findings.empty()) throw Error(status, std::move(findings));
}

OutputFile::OutputFile(const std::string& path) {
    if (path != "-") file_.emplace(path, check_interrupt);
}

void OutputFile::write(std::string_view text) {
    if (file_) return file_->write(text);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail();
}

void OutputFile::commit() {
    if (file_) return file_->keep();
    if (std::fflush(stdout) != 0) fail();
}

void OutputFile::fail() const {
    int code = errno;
    check_interrupt();  // a signal may have caused the failure
    throw Error(Status::file, std::string("standard output: cannot write: ") +
                                  (code == EBADF ? "it is closed" : std::strerror(code)));
}

void write_file(const std::string& path, std::string_view text) {
    if (path.empty()) return;
    OutputFile out(path);
    out.write(text);
    out.commit();
}

void print(std::string_view text) { write_file("-", text); }

std::size_t table_width() {
    winsize size{};
    const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return std::clamp<std::size_t>(is_known ? size.ws_col : 100, 80, 120);
}

}  // namespace csgrt::cli
