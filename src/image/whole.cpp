#include "image/whole.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

namespace csgrt {

namespace {

/// Reads bytes one after the other. A read beyond the end returns nothing, and sets `good` to false.
struct Bytes {
    std::span<const unsigned char> rest;
    bool good = true;

    std::span<const unsigned char> take(std::uint64_t count) {
        good = good && count <= rest.size();
        if (!good) return {};
        const auto taken = rest.first(static_cast<std::size_t>(count));
        rest = rest.subspan(static_cast<std::size_t>(count));
        return taken;
    }
    std::uint64_t number(std::size_t bytes) {
        std::uint64_t value = 0;
        const auto taken = take(bytes);
        for (std::size_t i = taken.size(); i-- > 0;) value = value << 8 | taken[i];
        return value;
    }
    /// The text before the next 0 byte. The 0 is skipped, too.
    std::string word() {
        const auto taken = take(static_cast<std::size_t>(std::find(rest.begin(), rest.end(), 0) - rest.begin()));
        take(1);
        return {taken.begin(), taken.end()};
    }
};

/// Whether the header has csgrt's own attributes. Others are not checked, because OpenImageIO renames some:
/// ImageDescription becomes "comments".
bool has_attributes(const std::set<std::string>& names, const Image& image) {
    for (const auto& [name, text] : image.attributes)
        if (name.starts_with("csgrt:") && !text.empty() && !names.contains(name)) return false;
    return std::ranges::all_of(image.matrices, [&](const auto& matrix) { return names.contains(matrix.first); });
}

}  // namespace

// An EXR file has attributes, which an empty name ends, then the offsets of the blocks of 16 rows, then the blocks.
bool is_whole(std::span<const unsigned char> exr, const Image& image) {
    constexpr int rows_a_block = 16;
    constexpr std::uint64_t magic = 20000630, version = 2;
    Bytes bytes{exr};
    if (bytes.number(4) != magic || bytes.number(1) != version) return false;
    bytes.take(3);  // flags, for example for long names
    std::set<std::string> names;
    for (std::string name; bytes.good && !(name = bytes.word()).empty(); names.insert(name)) {
        bytes.word();  // the attribute's type
        bytes.take(bytes.number(4));
    }
    for (int row = 0; bytes.good && row < image.height; row += rows_a_block) {
        const std::uint64_t begin = bytes.number(8);
        if (begin == 0) return false;
        Bytes block{exr};
        block.take(begin);
        const std::uint64_t first = block.number(4);
        block.take(block.number(4));
        if (!block.good || first != static_cast<std::uint64_t>(row)) return false;
    }
    return bytes.good && has_attributes(names, image);
}

}  // namespace csgrt
