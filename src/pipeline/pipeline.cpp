#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <utility>

#include "base/clock.hpp"

namespace csgrt {
namespace {

constexpr std::uint64_t most_rays = 1u << 24;  // of one tile: launches stay short

// Rays of a row of the window's blocks.
std::uint64_t row_of(const kernel::Frame& frame) { return std::uint64_t{kernel::blocks_across(frame.window)} * block_rays; }

}  // namespace

Pipeline::Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings,
                   Readback readback, std::uint64_t most_rays_of_picture)
    : device_(device),
      scene_(scene),
      kernels_(kernels),
      settings_(settings),
      most_rays_(most_rays_of_picture),
      buffers_(device, scene, kernels.tables()),
      tile_(device),
      picture_(device, "picture") {
    // The host's own processors need no copy, and have no time beside the kernels.
    if (readback == Readback::lines || device.info().type != "cpu") by_lines_.emplace(device);
}

Exact& Pipeline::exact() {
    if (!exact_) {
        const auto start = Clock::now();
        exact_.emplace(device_, scene_, kernels_, settings_, by_lines_.has_value());
        build_ms_ += milliseconds_since(start);
    }
    return *exact_;
}

FirstHits& Pipeline::first_hits() {
    if (!first_hits_) {
        const auto start = Clock::now();
        first_hits_.emplace(device_, scene_, settings_, by_lines_.has_value());
        build_ms_ += milliseconds_since(start);
    }
    return *first_hits_;
}

Cull& Pipeline::cull(const kernel::Frame& frame) { return frame.every_partition ? exact().cull() : first_hits().cull(); }

void Pipeline::prepare(bool every_partition) {
    every_partition ? static_cast<void>(exact()) : static_cast<void>(first_hits());
    if (!by_lines_ || by_lines_->list.is_built()) return;
    const auto start = Clock::now();
    by_lines_->list.build();
    build_ms_ += milliseconds_since(start);
}

// Rays of a tile that take no more than a quarter of the budget: the rest is for segments and partitions.
std::uint64_t Pipeline::fitting(std::uint64_t bytes_a_ray) const {
    const std::uint64_t held = picture_.size() + tile_.held() + (by_lines_ ? by_lines_->held() : 0) + (exact_ ? exact_->held() : 0);
    const std::uint64_t most = std::min((device_.available() + held) / 4, device_.max_buffer()) / bytes_a_ray;
    return std::clamp<std::uint64_t>(most, 1, most_rays);
}

// Of the frame's tiles. Every partition of more rays at once takes more memory and, on a processor, no less time. A GPU wants many: it
// gets half of a picture, for half of the memory and a fifth more of its time (docs/experiments/gpu-kernels.md).
std::uint64_t Pipeline::largest_tile(const kernel::Frame& frame) const {
    constexpr std::uint64_t of_processor = 1u << 16, of_gpu = 1u << 17;
    const std::uint64_t row = row_of(frame), rows = kernel::blocks_down(frame.window);
    const bool are_few = device_.info().type == "cpu" && frame.every_partition;
    const std::uint64_t most = are_few ? of_processor : frame.every_partition ? std::max(of_gpu, (rows + 1) / 2 * row) : most_rays_;
    return std::min({most, rows * row, most_rays_});
}

// For what a tile's rays need, whatever they hit: what the last call left may be in the way. `reused`: of what is
// needed, this much is held already.
void Pipeline::make_room(std::uint64_t bytes, std::uint64_t reused) {
    if (bytes <= device_.available() + reused) return;
    tile_.release_rays();
    if (by_lines_) by_lines_->release();
    if (exact_) exact_->release();
}

void Pipeline::for_each_tile(TileSource& source, const Told& told, const std::function<bool(const Tile&)>& work) {
    for (Tile tile = source.next(); tile.rays > 0; tile = source.next()) {
        if (!work(tile)) {
            source.halve(tile, device_.budget());
        } else if (told) {
            told(tile.rays);
        }
    }
}

void Pipeline::upload(const kernel::Frame& frame) {
    frame_upload_.start<std::byte>(tile_.frame, kernels_.frame(frame));
}

void Pipeline::upload_lights(const PreparedFrame& prepared) {
    const std::vector<std::byte> lights = kernels_.lights(prepared.lights);
    buffers_.lights.reserve(lights.size());
    if (!lights.empty()) buffers_.lights.upload(lights);
}

void Pipeline::render(const PreparedFrame& prepared, const TakeRays& take, const RenderTarget& target, const Told& told,
                      PipelineCounts& counts) {
    const bool every = prepared.frame.every_partition;
    upload_lights(prepared);
    prepare(every);
    if (by_lines_ && std::exchange(drew_every_partition_, every) != every) {  // there is memory for one way at a time
        by_lines_->release();
        if (exact_) exact_->release();
    }
    const std::uint64_t bytes = bytes_a_ray(prepared.frame, target), largest = largest_tile(prepared.frame);
    TileSource source(take, [&] { return std::min(fitting(bytes), largest); }, row_of(prepared.frame));
    const Drawing d{prepared.frame, source, target, told, counts};
    if (by_lines_) return every ? partitions_by_lines(d) : first_hits_by_lines(d);
    for_each_tile(source, [&](std::uint64_t rays) { d.tell(static_cast<std::uint32_t>(rays)); }, [&](const Tile& tile) {
        if (tile.rays % block_rays == 0) return draw_in_place(d, tile);
        draw_part_of_block(d, tile);
        return true;
    });
}

void Pipeline::finish() {
    if (by_lines_) by_lines_->lines.finish();
}

void Pipeline::abandon() noexcept {
    if (exact_) exact_->forget();
    if (!by_lines_) return;
    try {
        device_.finish();  // what was queued ahead draws into lines that a frame may take next
    } catch (...) {
    }
    by_lines_->give_up();
    by_lines_->lines.abandon();
}

void Pipeline::shoot(const PreparedFrame& prepared, std::span<const Ray> rays, const TakeRays& take, RayPartitions* answers,
                     const Told& told, PipelineCounts& counts) {
    const std::size_t bytes = kernels_.ray_bytes();
    if (exact_) exact_->forget();  // what a call that threw has left
    picture_.release();
    exact();
    TileSource source(take, [&] { return fitting(bytes + Exact::ray_bytes); }, 0);
    for_each_tile(source, told, [&](const Tile& tile) {
        const std::span<const Ray> some = rays.subspan(tile.first, tile.rays);
        make_room(tile.rays * (bytes + Exact::ray_bytes), tile_.rays.size());
        tile_.rays.reserve(tile.rays * bytes);
        tile_.rays.upload(kernels_.rays(some));
        kernel::Frame frame = prepared.frame;
        frame.ray_count = tile.rays;
        upload(frame);
        TimedKernels timed;
        const auto needs = weave(tile.rays, Rays::listed, timed);
        if (!needs) return false;
        exact().add_needs(*needs, tile.rays, counts);
        exact().settle(tile.rays, true, timed, counts);
        const auto claims = exact().claims(tile.rays);
        for (std::uint32_t i = 0; i < tile.rays; ++i) {
            answers[tile.first + i] = to_partitions(kernels_, prepared.frame, some[i], claims[i]);
            for (const ClaimedPartition& claim : claims[i]) counts.overlaps += !claim.claimants.empty();
        }
        ++counts.tiles;
        return true;
    });
}

}  // namespace csgrt
