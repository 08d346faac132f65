// Files that a command writes: looked at before the work begins, and there whole or not at all.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace csgrt::cli {

/// A file named on the command line, with the option or argument that named it.
struct NamedFile {
    std::string option, path;
    bool replaced = false;  ///< an output that is written beside its place and then renamed: pictures and scenes
};

/// Throws Error with every finding: usage, if an output is also an input or another output, or if standard output is
/// asked for twice; file, if an output cannot be written where it is wanted. "-" is standard output.
void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Text on its way into a file. It stands under a temporary name beside the file until commit(), and is removed if that
/// never comes. "-" is standard output; that, devices and pipes are written directly.
class OutputFile {
public:
    /// Throws Error (file), like the other functions.
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view text);
    void commit();

private:
    [[noreturn]] void fail(const char* what) const;

    std::string name_, target_, temporary_;  ///< no temporary: written directly
    std::FILE* file_ = nullptr;
};

/// Prints on standard output; Error (file) if that fails.
void print(std::string_view text);

}  // namespace csgrt::cli
