// Rays and points from a text file. A line holds one ray, ox oy oz dx dy dz, or one point, x y z. # begins a comment,
// and blank lines are ignored.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/rays.hpp>

#include "lines.hpp"
#include "scene/faults/finding_list.hpp"

namespace csgrt::cli {

/// Item: Ray or Vec3.
template <class Item>
class ItemReader {
public:
    /// Reads all items once, to count and check them. "-" is standard input. Throws Error (file) if the file cannot be
    /// read or has wrong lines. The error shows the first wrong lines and the number of the others.
    explicit ItemReader(const std::string& path);

    std::uint64_t count() const { return count_; }

    /// Replaces `items` by at most `limit` next items. False: no items are left.
    bool next(std::vector<Item>& items, std::size_t limit);
    /// Goes back to the first item.
    void rewind() { lines_.rewind(); }

private:
    bool parse(std::string_view line, Item& item);

    LineReader lines_;
    std::vector<Word> words_;
    FindingList findings_;
    std::uint64_t count_ = 0;
};

using RayReader = ItemReader<Ray>;
using PointReader = ItemReader<Vec3>;

}  // namespace csgrt::cli
