// Output: files that a command writes. They are checked before the work begins, and are written whole or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/new_file.hpp"

namespace csgrt::cli {

/// A file named on the command line, with the option or argument that named it.
struct NamedFile {
    std::string option, path;
};

/// ".png": the extension of a name, in small letters.
std::string extension_of(const std::string& path);

/// Throws Error with every finding. Error (usage): a file is an output and an input or is an output twice, or standard
/// output or standard input is named twice. Error (file): an output cannot be written. The output "-" is standard
/// output.
void check_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// A text file that is written whole or not at all (NewFile). "-" is standard output.
class OutputFile {
public:
    /// Throws Error (file), as the other functions do.
    explicit OutputFile(const std::string& path);

    void write(std::string_view text);
    void commit();

private:
    [[noreturn]] void fail() const;

    std::optional<NewFile> file_;  ///< absent: standard output
};

/// Writes a text to a file, as OutputFile does. An empty path, of an option that is not given, is no file.
void write_file(const std::string& path, std::string_view text);

/// Prints on standard output; Error (file) if that fails.
void print(std::string_view text);

/// Columns of a table on standard output: those of the terminal, from 80 to 120.
std::size_t table_width();

}  // namespace csgrt::cli
