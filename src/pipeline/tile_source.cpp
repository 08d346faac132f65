#include "pipeline/tile_source.hpp"

#include <algorithm>
#include <string>

#include <csgrt/error.hpp>

namespace csgrt {
namespace {

// The range's first tile, of at most `most` rays: whole blocks, or parts of one; and whole rows of the window's blocks if they are
// many, for what a GPU copies of them is in few pieces then.
std::uint64_t end_of_tile(const RayRange& range, std::uint64_t most, std::uint64_t row) {
    const std::uint64_t end = std::min(range.first + most, range.end), in_block = range.first % block_rays;
    if (row == 0) return end;
    if (in_block != 0) return std::min(end, range.first - in_block + block_rays);
    if (end == range.end || most < block_rays) return end;
    const std::uint64_t unit = most >= 4 * row ? row : block_rays;
    return std::max(end / unit * unit, range.first + block_rays);
}

}  // namespace

bool TileSource::is_empty() {
    while (!has_ended_ && left_.empty()) {
        const RayRange range = take_();
        has_ended_ = range.first == range.end;
        if (has_ended_) break;
        left_.push_back(range);
        size_ = most_();
    }
    return left_.empty();
}

Tile TileSource::next() {
    if (is_empty()) return {};
    RayRange& range = left_.back();
    const std::uint64_t first = std::exchange(range.first, end_of_tile(range, size_, row_));
    const Tile tile{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.first - first)};
    if (range.first == range.end) left_.pop_back();
    return tile;
}

void TileSource::halve(const Tile& tile, std::uint64_t budget) {
    if (tile.rays == 1)
        throw Error(Status::out_of_memory, "the segments of one ray do not fit the device's memory (" + std::to_string(budget >> 20) +
                                               " MiB): raise --max-memory, or use --reference");
    size_ = tile.rays / 2;
    give_back(tile);
}

}  // namespace csgrt
