// A file in memory, how places in it are told, and what a reader found wrong in it. Shared by every format.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <csgrt/error.hpp>

#include "scene/faults/finding_list.hpp"

namespace csgrt {

/// Largest file that is read. Real scenes are a hundred times smaller; an endless device must not fill the memory.
inline constexpr std::size_t max_file_bytes = std::size_t{256} << 20;

/// The bytes of a file. Throws Error (file) if it cannot be read or is larger than max_file_bytes.
std::string read_file(const std::string& path);

/// Of files that a model names: its own folder, and `allowed`.
std::vector<std::string> file_folders_of(const std::string& model, const std::vector<std::string>& allowed);

/// The bytes of standard input, likewise.
std::string read_standard_input();
inline constexpr const char* standard_input = "standard input";

/// What a finding needs to know of its file. Offsets are bytes from the file's start.
class Source {
public:
    virtual Place place(std::size_t offset, std::string object = {}) const = 0;
    /// What stands at the offset, for a person to see; empty if that would help nobody.
    virtual std::string excerpt(std::size_t offset) const = 0;

    /// The files that it may name lie below these. None: it may name no file, as a scene from memory.
    std::vector<std::string> file_folders;

protected:
    ~Source() = default;
};

/// Thrown inside a reader to give up one record. The reader turns it into a finding and goes on with the next record;
/// it never leaves the reader.
struct Fault {
    std::size_t offset = 0;
    std::string message;
    std::string suggestion;
};

/// What was done about a fault of an attribute or a setting that is borne.
inline constexpr const char* passed_over = "passed over";

/// What is wrong in one file, reported all at once.
class Findings {
public:
    /// Of a lenient scene, what can be borne goes to `borne`.
    explicit Findings(const Source& source, std::vector<Warning>* borne = nullptr) : source_(source), borne_(borne) {}

    void add(std::size_t offset, std::string object, std::string message, std::string suggestion = {});
    void add(Fault fault, std::string object) {
        add(fault.offset, std::move(object), std::move(fault.message), std::move(fault.suggestion));
    }
    /// A fault that leaves the rest of the file its meaning: a warning that ends in `done`, or a finding if the scene
    /// is strict.
    void bear(Fault fault, const std::string& object, const char* done);
    bool is_lenient() const noexcept { return borne_ != nullptr; }
    Place place(std::size_t offset, const std::string& object) const { return source_.place(offset, object); }
    bool empty() const noexcept { return list_.empty(); }
    /// What comes now is counted and not shown: it needs no suggestion.
    bool full() const noexcept { return list_.full(); }
    /// The reader gives up: there may be more than it found.
    void stop() noexcept { list_.stop(); }

    /// Throws Error (scene) with the findings, in the order of the file, and how many more there are; does nothing if
    /// there is none.
    void throw_if_any();

private:
    const Source& source_;
    std::vector<Warning>* borne_;
    FindingList list_;
};

}  // namespace csgrt
