// Sources: a file in memory, the places in it, and a reader's findings. Shared by every format.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <csgrt/error.hpp>

#include "scene/faults/finding_list.hpp"

namespace csgrt {

/// The largest file that is read. Real scenes are a hundred times smaller; an endless device must not fill the memory.
inline constexpr std::size_t max_file_bytes = std::size_t{256} << 20;

/// The bytes of a file. Throws Error (file) if it cannot be read or is larger than max_file_bytes.
std::string read_file(const std::string& path);

/// The folders of files that a model may name: its own folder, and `allowed`.
std::vector<std::string> file_folders_of(const std::string& model, const std::vector<std::string>& allowed);

/// The bytes of standard input. Throws as read_file() does.
std::string read_standard_input();
inline constexpr const char* standard_input = "standard input";

/// A file, as far as a finding needs it. Offsets are bytes from the file's start.
class Source {
public:
    virtual Place place(std::size_t offset, std::string object = {}) const = 0;
    /// The text at the offset, for a person; empty if it would not help.
    virtual std::string excerpt(std::size_t offset) const = 0;

    /// The folders below which the files that it may name lie. None: it may name no file, as a scene from memory.
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

/// The action for a tolerated fault of an attribute or a setting.
inline constexpr const char* passed_over = "passed over";

/// The faults of one file, reported all at once.
class Findings {
public:
    /// Faults that a lenient scene tolerates go to `tolerated`.
    explicit Findings(const Source& source, std::vector<Warning>* tolerated = nullptr)
        : source_(source), tolerated_(tolerated) {}

    void add(std::size_t offset, std::string object, std::string message, std::string suggestion = {});
    void add(Fault fault, std::string object) {
        add(fault.offset, std::move(object), std::move(fault.message), std::move(fault.suggestion));
    }
    /// Tolerates a fault after which the rest of the file keeps its meaning: adds a warning that ends in `done`, or a
    /// finding if the scene is strict.
    void tolerate(Fault fault, const std::string& object, const char* done);
    bool is_lenient() const noexcept { return tolerated_ != nullptr; }
    Place place(std::size_t offset, const std::string& object) const { return source_.place(offset, object); }
    bool empty() const noexcept { return list_.empty(); }
    /// Whether further findings are counted and not shown: they need no suggestion.
    bool full() const noexcept { return list_.full(); }
    /// Notes that the reader gives up: there may be more than it found.
    void stop() noexcept { list_.stop(); }

    /// Throws Error (scene) with the findings, in the order of the file, and the number of further ones; does nothing
    /// if there are none.
    void throw_if_any();

private:
    const Source& source_;
    std::vector<Warning>* tolerated_;
    FindingList list_;
};

}  // namespace csgrt
