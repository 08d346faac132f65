// Rays from a text file: one a line, ox oy oz dx dy dz; # begins a comment, blank lines do not count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "lines.hpp"
#include "scene/faults/finding_list.hpp"

namespace csgrt::cli {

class RayReader {
public:
    /// Reads all rays once, to count and check them. "-" is standard input.
    /// Throws Error (file) if it cannot be read, or with the first wrong lines and the number of the others.
    explicit RayReader(const std::string& path);

    std::uint64_t count() const { return count_; }

    /// Replaces `rays` by the next ones, at most `limit`; false when there are none left.
    bool next(std::vector<Ray>& rays, std::size_t limit);

private:
    bool parse(std::string_view line, Ray& ray);

    LineReader lines_;
    std::vector<Word> words_;
    FindingList findings_;
    std::uint64_t count_ = 0;
};

}  // namespace csgrt::cli
