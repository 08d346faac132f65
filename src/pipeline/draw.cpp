// A tile of a picture in place, and rays one by one.
#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace csgrt {

std::uint64_t Pipeline::pixel_bytes_of(const RenderTarget& target) { return target.planes.size() * sizeof(float); }

std::uint64_t Pipeline::cull_bytes(const Tile& tile) { return tile.rays * Cull::list_bytes + tile.blocks(); }

std::uint64_t Pipeline::bytes_a_ray(const kernel::Frame& frame, const RenderTarget& target) const {
    const std::uint64_t own = frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes;
    const std::uint64_t pictures = by_lines_ ? 2 : 1;  // and what they are drawn with, at a time
    return pictures * (pixel_bytes_of(target) + sizeof(std::uint32_t) + own) + Cull::list_bytes;
}

// Makes the frame's tile one of these rays, or blocks of them.
bool Pipeline::list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                         std::uint64_t pixel_bytes, std::uint64_t ray_bytes) {
    frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * rays_each;
    frame.picked = rays_each == 1;
    if (numbers.empty()) return false;
    const std::uint64_t picture = frame.ray_count * pixel_bytes, list = numbers.size() * sizeof(std::uint32_t);
    make_room(picture + list + frame.ray_count * ray_bytes,
              std::min<std::uint64_t>(picture, picture_.size()) + std::min<std::uint64_t>(list, tile_.rays.size()));
    picture_.reserve(picture);
    list_upload_.start<std::uint32_t>(tile_.rays, numbers);
    upload(frame);
    return true;
}

// Every partition of a tile's rays, while no other is under way. What tiles' lines took comes before a smaller tile.
std::optional<Exact::Needs> Pipeline::weave(std::uint32_t rays, Rays kind, TimedKernels& timed) {
    if (auto needs = exact().weave(buffers_, tile_, rays, kind, timed)) return needs;
    if (!by_lines_ || by_lines_->held() == 0) return {};
    by_lines_->release();
    return exact().weave(buffers_, tile_, rays, kind, timed);
}

// False: the tile does not fit the memory.
bool Pipeline::draw_in_place(const Drawing& d, const Tile& tile) {
    kernel::Frame frame = d.frame;
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    make_room(cull_bytes(tile), tile_.costs.size() + tile_.lists.size());
    upload(frame);
    const Event culled = cull(frame).launch(buffers_, tile_, frame);
    const std::vector<std::uint32_t> seen = Cull::seen(tile, tile_);
    d.counts.cull_blocks += milliseconds(culled);

    const std::uint64_t pixel_bytes = pixel_bytes_of(d.target);
    const bool sees =
        list_rays(frame, seen, block_rays, pixel_bytes, frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes);
    std::vector<std::uint32_t> overflown;
    if (sees && frame.every_partition) {
        TimedKernels timed;
        const auto needs = weave(frame.ray_count, Rays::blocks, timed);
        if (!needs) return false;
        exact().shade(buffers_, tile_, picture_, frame.ray_count, timed);
        exact().add_needs(*needs, frame.ray_count, d.counts);
        exact().settle(frame.ray_count, true, timed, d.counts);
    } else if (sees) {
        tile_.tally.reserve(sizeof(kernel::TileTally));
        tile_.tally.queue_fill(0, sizeof(kernel::TileTally));
        const TimedKernels timed = first_hits().launch(buffers_, tile_, picture_, frame.ray_count);
        const std::uint32_t overflows = tile_.tally.read<kernel::TileTally>(1).front().overflows;
        overflown = tile_.overflown.read<std::uint32_t>(overflows);
        add_times(timed, d.counts);
    }
    {
        const Buffer::Mapping picture = picture_.map(seen.size() * block_rays * pixel_bytes);
        put_blocks(frame, tile.first_block(), tile.end_block(), seen, static_cast<const float*>(picture.data()), d.target);
    }
    draw_exactly(d, overflown);
    return true;
}

// Rays of a picture the exact way, one by one, while no tile is under way.
void Pipeline::draw_exactly(const Drawing& d, const std::vector<std::uint32_t>& numbers) {
    const std::uint64_t pixel_bytes = pixel_bytes_of(d.target), bytes = pixel_bytes + sizeof(std::uint32_t) + Exact::ray_bytes;
    if (!numbers.empty() && by_lines_) by_lines_->lines.finish();  // what comes in whole blocks comes before
    kernel::Frame frame = d.frame;
    bool is_taken = false;
    TileSource source([&] { return std::exchange(is_taken, true) ? RayRange{} : RayRange{0, numbers.size()}; },
                      [&] { return fitting(bytes); }, 0);
    for_each_tile(source, nullptr, [&](const Tile& tile) {
        const auto begin = numbers.begin() + tile.first;
        const std::vector<std::uint32_t> picked(begin, begin + tile.rays);
        list_rays(frame, picked, 1, pixel_bytes, Exact::ray_bytes);
        TimedKernels timed;
        const auto needs = weave(frame.ray_count, Rays::picked, timed);
        if (!needs) return false;
        exact().shade(buffers_, tile_, picture_, frame.ray_count, timed);
        const Buffer::Mapping picture = picture_.map(picked.size() * pixel_bytes);
        put_rays(frame, picked, static_cast<const float*>(picture.data()), d.target);
        exact().add_needs(*needs, frame.ray_count, d.counts);
        exact().settle(tile.rays, frame.every_partition, timed, d.counts);
        return true;
    });
}

// Rays of less than a block: there is memory for no more.
void Pipeline::draw_part_of_block(const Drawing& d, const Tile& tile) {
    std::vector<std::uint32_t> numbers(tile.rays);
    std::iota(numbers.begin(), numbers.end(), tile.first);
    draw_exactly(d, numbers);
}

}  // namespace csgrt
