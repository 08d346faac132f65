// What can go wrong, and where. Every failure of csgrt is one csgrt::Error.
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

/// The kind of a failure; its value is the exit status of the command line.
enum class Status : int {
    ok = 0,
    usage = 2,          ///< the command line or an argument of the library makes no sense
    scene = 3,          ///< the scene is wrong
    no_device = 4,      ///< no device fits
    out_of_memory = 5,  ///< host or device memory, or the budget, does not suffice
    file = 6,           ///< a file cannot be read or written
    device_fault = 7,   ///< the device failed, or took too long
    differs = 8,        ///< a comparison or verification found a difference
    interrupted = 130,  ///< the user stopped it
};

/// A place in a scene file. Text formats give line and column (from 1), binary ones `offset`; 0 and -1 mean "unknown".
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
    std::int64_t offset = -1;
    std::string pointer;  ///< JSON pointer, or the name of the object
};

/// One finding: what is wrong, where, and what to do.
struct Diagnostic {
    Place place;
    std::string message;     ///< what is wrong, and what was expected
    std::string suggestion;  ///< what to do; may be empty
    std::string excerpt;     ///< the line of the file, with a caret under the place; may be empty
};

/// "file:line:column: pointer: message\n    excerpt\n  suggestion", the form that the command line prints.
CSGRT_API std::string format(const Diagnostic& diagnostic);

/// What was borne, not refused: the rest of the model is as it should be.
struct Warning {
    std::string object;       ///< its name; empty: the whole file
    Place place;              ///< the first of them, where it is known
    std::string reason;       ///< what is wrong, and what was done about it
    std::uint64_t count = 1;  ///< how often this was met
    bool appearance = false;  ///< pictures show less than they should; what rays meet does not change
};

/// "place: object: reason (N times)", on one line.
CSGRT_API std::string format(const Warning& warning);

/// Thrown by every function of csgrt that fails. `what()` holds all diagnostics, formatted, a line or more each.
class CSGRT_API Error : public std::runtime_error {
public:
    Error(Status status, std::string message);
    Error(Status status, std::vector<Diagnostic> diagnostics);

    Status status() const noexcept { return status_; }
    const std::vector<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }

private:
    Status status_;
    std::vector<Diagnostic> diagnostics_;
};

}  // namespace csgrt
