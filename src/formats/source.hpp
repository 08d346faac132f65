// Sources: files in memory, places in them, and a reader's findings. All formats share this.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <csgrt/error.hpp>

#include "scene/faults/finding_list.hpp"

namespace csgrt {

/// The largest file that is read. The limit is a hundred times larger than real scenes; it keeps an endless device from
/// filling the memory.
inline constexpr std::size_t max_file_bytes = std::size_t{256} << 20;

/// The bytes of a file. Throws Error (file) if it cannot be read or is larger than max_file_bytes.
std::string read_file(const std::string& path);

/// The folders of files that a model may name: its own folder, and `allowed`.
std::vector<std::string> file_folders_of(const std::string& model, const std::vector<std::string>& allowed);

/// The bytes of standard input. Throws as read_file() does.
std::string read_standard_input();
inline constexpr const char* standard_input = "standard input";

/// The interface of a file for findings. Offsets are bytes from the file's start.
class Source {
public:
    virtual Place place(std::size_t offset, std::string object = {}) const = 0;
    /// The text around the offset, for a message. Empty for binary files.
    virtual std::string excerpt(std::size_t offset) const = 0;

    /// Folders of the files that this file may name. Empty: it may name no files, for example because it was in memory.
    std::vector<std::string> file_folders;

protected:
    ~Source() = default;
};

/// A reader throws a Fault to give up one record, catches it, adds a finding and goes on with the next record. A Fault
/// never leaves the reader.
struct Fault {
    std::size_t offset = 0;
    std::string message;
    std::string suggestion;
};

/// The end of a warning about a faulty attribute or setting.
inline constexpr const char* passed_over = "passed over";

/// The faults of one file, which are reported together.
class Findings {
public:
    /// Faults that a lenient scene tolerates go to `tolerated`.
    explicit Findings(const Source& source, std::vector<Warning>* tolerated = nullptr)
        : source_(source), tolerated_(tolerated) {}

    void add(std::size_t offset, std::string object, std::string message, std::string suggestion = {});
    void add(Fault fault, std::string object) {
        add(fault.offset, std::move(object), std::move(fault.message), std::move(fault.suggestion));
    }
    /// Tolerates a fault that does not change the meaning of the rest of the file: adds a warning that ends in `done`,
    /// or in a strict scene a finding.
    void tolerate(Fault fault, const std::string& object, const char* done);
    bool is_lenient() const noexcept { return tolerated_ != nullptr; }
    Place place(std::size_t offset, const std::string& object) const { return source_.place(offset, object); }
    bool empty() const noexcept { return list_.empty(); }
    /// Whether further findings are only counted, so that they need no suggestion.
    bool full() const noexcept { return list_.full(); }
    /// Notes that the reader gives up, so that there may be further faults.
    void stop() noexcept { list_.stop(); }

    /// Throws Error (scene) if there are findings: with the findings in the file's order, and the number of those that
    /// are only counted.
    void throw_if_any();

private:
    const Source& source_;
    std::vector<Warning>* tolerated_;
    FindingList list_;
};

}  // namespace csgrt
