#include "pipeline/scheduling/batch_source.hpp"

#include <algorithm>

namespace csgrt {
namespace {

// The range's first batch, of at most `most` rays: whole rows of the screen's tiles, else a part of one row, else a
// part of a tile.
std::uint64_t end_of_batch(const RayNumbers& range, std::uint64_t most, std::uint64_t row) {
    const std::uint64_t end = std::min(range.first + most, range.end);
    if (row == 0) return end;
    const auto end_of = [&](std::uint64_t unit) { return range.first / unit * unit + unit; };
    if (range.first % tile_rays != 0) return std::min(end, end_of(tile_rays));
    if (end - range.first < tile_rays) return end;
    if (range.first % row == 0 && end - range.first >= row) return end / row * row;
    return std::min(end / tile_rays * tile_rays, end_of(row));
}

}  // namespace

bool BatchSource::is_empty() {
    while (!has_ended_ && left_.empty()) {
        const RayNumbers range = take_();
        has_ended_ = range.first == range.end;
        if (has_ended_) break;
        left_.push_back(range);
        size_ = most_();
    }
    return left_.empty();
}

RayBatch BatchSource::next(std::uint64_t most) {
    if (is_empty()) return {};
    RayNumbers& range = left_.back();
    const std::uint64_t first = std::exchange(range.first, end_of_batch(range, std::min(size_, most), row_));
    const RayBatch batch{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.first - first)};
    if (range.first == range.end) left_.pop_back();
    return batch;
}

void BatchSource::halve(const RayBatch& batch, std::uint64_t budget) {
    if (batch.rays == 1) throw_too_long_ray(budget);
    size_ = batch.rays / 2;
    give_back(batch);
}

}  // namespace csgrt
