// A batch of a picture in place, and rays one by one.
#include "pipeline/scheduling/pipeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace csgrt {

std::uint64_t Pipeline::pixel_bytes_of(const RenderTarget& target) { return target.planes.size() * sizeof(float); }

std::uint64_t Pipeline::cull_bytes(const RayBatch& batch) { return batch.rays * Cull::list_bytes + batch.tiles(); }

std::uint64_t Pipeline::bytes_a_ray(const kernel::Frame& frame, const RenderTarget& target) const {
    const std::uint64_t own = frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes;
    const std::uint64_t pictures = by_lines_ ? 2 : 1;  // and what they are drawn with, at a time
    return pictures * (pixel_bytes_of(target) + sizeof(std::uint32_t) + own) + Cull::list_bytes;
}

// Makes the frame's batch one of these rays, or tiles of them.
bool Pipeline::list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                         std::uint64_t pixel_bytes, std::uint64_t ray_bytes) {
    frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * rays_each;
    frame.picked = rays_each == 1;
    if (numbers.empty()) return false;
    const std::uint64_t picture = frame.ray_count * pixel_bytes, list = numbers.size() * sizeof(std::uint32_t);
    make_room(picture + list + frame.ray_count * ray_bytes,
              std::min<std::uint64_t>(picture, picture_.size()) + std::min<std::uint64_t>(list, batch_.rays.size()));
    picture_.reserve(picture);
    list_upload_.start<std::uint32_t>(batch_.rays, numbers);
    upload(frame);
    return true;
}

// Every partition of a batch's rays, while no other is under way. What batches' lines took comes before a smaller batch.
std::optional<Exact::Needs> Pipeline::weave(std::uint32_t rays, Rays kind, TimedKernels& timed) {
    if (auto needs = exact().weave(buffers_, batch_, rays, kind, timed)) return needs;
    if (!by_lines_ || by_lines_->held() == 0) return {};
    by_lines_->release();
    return exact().weave(buffers_, batch_, rays, kind, timed);
}

// False: the batch does not fit the memory.
bool Pipeline::draw_in_place(const Drawing& d, const RayBatch& batch) {
    kernel::Frame frame = d.frame;
    frame.first_ray = batch.first;
    frame.ray_count = batch.rays;
    make_room(cull_bytes(batch), batch_.costs.size() + batch_.lists.size());
    upload(frame);
    const Event culled = cull(frame).launch(buffers_, batch_, frame);
    const std::vector<std::uint32_t> seen = Cull::seen(batch, batch_);
    d.counts.cull_tiles += milliseconds(culled);

    const std::uint64_t pixel_bytes = pixel_bytes_of(d.target);
    const bool sees =
        list_rays(frame, seen, tile_rays, pixel_bytes, frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes);
    std::vector<std::uint32_t> overflown;
    if (sees && frame.every_partition) {
        TimedKernels timed;
        const auto needs = weave(frame.ray_count, Rays::tiles, timed);
        if (!needs) return false;
        exact().shade(buffers_, batch_, picture_, frame.ray_count, timed);
        exact().add_needs(*needs, frame.ray_count, d.counts);
        exact().settle(frame.ray_count, true, timed, d.counts);
    } else if (sees) {
        batch_.tally.reserve(sizeof(kernel::BatchReport));
        batch_.tally.queue_fill(0, sizeof(kernel::BatchReport));
        const TimedKernels timed = first_hits().launch(buffers_, batch_, picture_, frame.ray_count);
        const std::uint32_t overflows = batch_.tally.read<kernel::BatchReport>(1).front().overflows;
        overflown = batch_.overflown.read<std::uint32_t>(overflows);
        add_times(timed, d.counts);
    }
    {
        const Buffer::Mapping picture = picture_.map(seen.size() * tile_rays * pixel_bytes);
        put_tiles(frame, batch.first_tile(), batch.end_tile(), seen, static_cast<const float*>(picture.data()), d.target);
    }
    draw_exactly(d, overflown);
    return true;
}

// Rays of a picture the exact way, one by one, while no batch is under way.
void Pipeline::draw_exactly(const Drawing& d, const std::vector<std::uint32_t>& numbers) {
    const std::uint64_t pixel_bytes = pixel_bytes_of(d.target), bytes = pixel_bytes + sizeof(std::uint32_t) + Exact::ray_bytes;
    if (!numbers.empty() && by_lines_) by_lines_->lines.finish();  // what comes in whole tiles comes before
    kernel::Frame frame = d.frame;
    bool is_taken = false;
    BatchSource source([&] { return std::exchange(is_taken, true) ? RayRange{} : RayRange{0, numbers.size()}; },
                      [&] { return fitting(bytes); }, 0);
    for_each_batch(source, nullptr, [&](const RayBatch& batch) {
        const auto begin = numbers.begin() + batch.first;
        const std::vector<std::uint32_t> picked(begin, begin + batch.rays);
        list_rays(frame, picked, 1, pixel_bytes, Exact::ray_bytes);
        TimedKernels timed;
        const auto needs = weave(frame.ray_count, Rays::picked, timed);
        if (!needs) return false;
        exact().shade(buffers_, batch_, picture_, frame.ray_count, timed);
        const Buffer::Mapping picture = picture_.map(picked.size() * pixel_bytes);
        put_rays(frame, picked, static_cast<const float*>(picture.data()), d.target);
        exact().add_needs(*needs, frame.ray_count, d.counts);
        exact().settle(batch.rays, frame.every_partition, timed, d.counts);
        return true;
    });
}

// Rays of less than a tile: there is memory for no more.
void Pipeline::draw_part_of_tile(const Drawing& d, const RayBatch& batch) {
    std::vector<std::uint32_t> numbers(batch.rays);
    std::iota(numbers.begin(), numbers.end(), batch.first);
    draw_exactly(d, numbers);
}

}  // namespace csgrt
