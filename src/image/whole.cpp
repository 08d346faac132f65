#include "image/whole.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace csgrt {

namespace {

/// Reads a file from its front. Past the end there is nothing, and `good` becomes false.
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
    std::uint64_t number(std::size_t bytes, bool big_endian) {
        std::uint64_t value = 0;
        const auto taken = take(bytes);
        for (std::size_t i = 0; i < taken.size(); ++i)
            value = value << 8 | taken[big_endian ? i : taken.size() - 1 - i];
        return value;
    }
    /// Moves behind the next 0; returns the length before it.
    std::size_t word() {
        const auto end = static_cast<std::size_t>(std::find(rest.begin(), rest.end(), 0) - rest.begin());
        take(end + 1);
        return end;
    }
    bool begins(std::string_view text) {
        const auto taken = take(text.size());
        return good && std::memcmp(taken.data(), text.data(), text.size()) == 0;
    }
};

// OpenEXR's file layout: attributes up to an empty name, then the positions of blocks of 16 rows, then the blocks.
bool is_whole_exr(std::span<const unsigned char> file, int height) {
    constexpr int rows_a_block = 16;
    Bytes bytes{file};
    if (!bytes.begins("\x76\x2f\x31\x01\x02")) return false;
    bytes.take(3);  // flags: for example long names
    while (bytes.good && bytes.word() > 0) {
        bytes.word();  // its type
        bytes.take(bytes.number(4, false));
    }
    for (int row = 0; bytes.good && row < height; row += rows_a_block) {
        const std::uint64_t begin = bytes.number(8, false);
        if (begin == 0) return false;
        Bytes block{file};
        block.take(begin);
        const std::uint64_t first = block.number(4, false);
        block.take(block.number(4, false));
        if (!block.good || first != static_cast<std::uint64_t>(row)) return false;
    }
    return bytes.good;
}

bool is_whole_png(std::span<const unsigned char> file) {
    Bytes bytes{file};
    if (!bytes.begins("\x89PNG\r\n\x1a\n")) return false;
    for (;;) {
        const std::uint64_t size = bytes.number(4, true);
        const bool last = bytes.begins("IEND");
        bytes.take(size);
        bytes.take(4);  // its checksum
        if (!bytes.good) return false;
        if (last) return bytes.rest.empty();
    }
}

}  // namespace

bool is_whole(std::span<const unsigned char> file, const std::string& format, int height) {
    return format == "exr" ? is_whole_exr(file, height) : is_whole_png(file);
}

}  // namespace csgrt
