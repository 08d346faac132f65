// Failures and warnings. Every failure of csgrt is one csgrt::Error.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(_WIN32)
#define CSGRT_API __declspec(dllexport)
#else
#define CSGRT_API __attribute__((visibility("default")))
#endif

namespace csgrt {

/// The kind of a failure. The values are the exit statuses of the command line.
enum class Status : int {
    ok = 0,
    usage = 2,          ///< an option of the command line or an argument of the library is invalid
    scene = 3,          ///< the scene is invalid
    no_device = 4,      ///< no device fits the choice
    out_of_memory = 5,  ///< host memory, device memory or the memory limit (Settings::max_memory) is too small
    file = 6,           ///< a file cannot be read or written
    device_fault = 7,   ///< a device or its driver failed, or took too long
    differs = 8,        ///< a comparison or a verification found a difference
    interrupted = 130,  ///< the user or Settings::progress stopped the call
};

/// A place in a scene file. Text formats give `line` and `column`, binary formats give `offset`.
struct Place {
    std::string file = {};
    int line = 0;              ///< from 1; 0: unknown
    int column = 0;            ///< from 1; 0: unknown
    std::int64_t offset = -1;  ///< in bytes from the file's begin; -1: unknown
    std::string pointer = {};  ///< a JSON pointer, or the name of an object; may be empty
};

/// An error: the fault, its place, and what to do.
struct Diagnostic {
    Place place = {};
    std::string message = {};     ///< the fault, and what was expected
    std::string suggestion = {};  ///< what to do; may be empty
    std::string excerpt = {};     ///< the line of the file, with a caret under the place; may be empty
};

/// The text that the command line prints: "file:line:column: pointer: message\n    excerpt\n  suggestion", without the
/// parts that are unknown or empty. Any thread.
CSGRT_API std::string format(const Diagnostic& diagnostic);

/// A fault that was tolerated: csgrt left a part out or replaced it, and uses the rest of the model unchanged.
struct Warning {
    std::string object = {};  ///< the object's name; empty: the warning is about the whole file, or about a device
    Place place = {};         ///< the place of the first occurrence; may be unknown
    std::string reason = {};  ///< the fault, and what csgrt did about it
    std::uint64_t count = 1;  ///< the number of occurrences
    bool appearance = false;  ///< true: the fault changes colours only, not what rays hit
};

/// "place: object: reason (N times)", on one line. Any thread.
CSGRT_API std::string format(const Warning& warning);

/// The exception that every failing function of csgrt throws. `what()` holds all diagnostics as text, each on one line
/// or more.
class CSGRT_API Error : public std::runtime_error {
public:
    /// An error with one diagnostic, which has this message and no place.
    Error(Status status, std::string message);
    Error(Status status, std::vector<Diagnostic> diagnostics);

    Status status() const noexcept { return status_; }
    /// All errors that were found, at least one.
    const std::vector<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }

private:
    Status status_;
    std::vector<Diagnostic> diagnostics_;
};

}  // namespace csgrt
