#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "clock.hpp"

namespace csgrt {
namespace {

constexpr std::uint64_t most_rays = 1u << 24;  // of one tile: launches stay short

// Rays of a row of the window's blocks.
std::uint64_t row_of(const kernel::Frame& frame) { return std::uint64_t{kernel::blocks_across(frame.window)} * block_rays; }

// The range's first tile, of at most `most` rays: whole blocks, or parts of one; and whole rows of the window's blocks if they are
// many, for what a GPU copies of them is in few pieces then.
Tile first_tile(RayRange range, std::uint64_t most, std::uint64_t row) {
    std::uint64_t end = std::min(range.first + most, range.end);
    const std::uint64_t in_block = range.first % block_rays;
    if (in_block != 0) {
        end = std::min(end, range.first - in_block + block_rays);
    } else if (end < range.end && most >= block_rays) {
        const std::uint64_t unit = most >= 4 * row ? row : block_rays;
        end = std::max(end / unit * unit, range.first + block_rays);
    }
    return {static_cast<std::uint32_t>(range.first), static_cast<std::uint32_t>(end - range.first)};
}

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
        exact_.emplace(device_, scene_, kernels_, settings_);
        build_ms_ += milliseconds_since(start);
    }
    return *exact_;
}

FirstHits& Pipeline::first_hits() {
    if (!first_hits_) {
        const auto start = Clock::now();
        first_hits_.emplace(device_, scene_, settings_);
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
// gets half of a picture, for half of the memory and a fifth more of its time (bench/NOTES.md).
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
    if (by_lines_) release_lines();
    if (exact_) exact_->release();
}

// `tile_of`: the first one of a range's, of at most so many rays. `work` is told the following one, too.
void Pipeline::for_each_tile(RayRange range, std::uint64_t size, const FirstTile& tile_of, const Progress& progress,
                             const std::function<bool(const Tile&, const Tile&)>& work) {
    std::uint64_t first = range.first;
    while (first < range.end) {
        const Tile tile = tile_of({first, range.end}, size);
        if (!work(tile, tile_of({first + tile.rays, range.end}, size))) {
            if (tile.rays == 1)
                throw Error(Status::out_of_memory, "the segments of one ray do not fit the device's memory (" +
                                                       std::to_string(device_.budget() >> 20) +
                                                       " MiB): raise --max-memory, or use --reference");
            size = tile.rays / 2;
            continue;
        }
        first += tile.rays;
        if (progress &&
            !progress(static_cast<double>(first - range.first) / static_cast<double>(range.end - range.first)))
            throw Error(Status::interrupted, "interrupted");
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

void Pipeline::render(const PreparedFrame& prepared, RayRange range, const std::function<RayRange()>& next,
                      const RenderTarget& target, const Progress& progress, PipelineCounts& counts) {
    const bool every = prepared.frame.every_partition;
    if (!by_lines_ || !by_lines_->ahead) upload_lights(prepared);  // else the frame's are there
    prepare(every);
    if (by_lines_ && std::exchange(drew_every_partition_, every) != every) {  // there is memory for one way at a time
        release_lines();
        if (exact_) exact_->release();
    }
    const std::uint64_t bytes = bytes_a_ray(prepared.frame, target);
    const std::uint64_t row = row_of(prepared.frame), largest = largest_tile(prepared.frame);
    const FirstTile tile_of = [&](RayRange r, std::uint64_t size) { return first_tile(r, size, row); };
    for_each_tile(range, std::min(fitting(bytes), largest), tile_of, progress, [&](const Tile& tile, const Tile& following) {
        ++counts.tiles;
        if (tile.rays % block_rays != 0) {
            std::vector<std::uint32_t> numbers(tile.rays);
            std::iota(numbers.begin(), numbers.end(), tile.first);
            draw_exactly(prepared.frame, numbers, target, counts);
            return true;
        }
        if (!by_lines_) return draw_in_place(prepared.frame, tile, target, counts);
        const Tile after = following.rays > 0 ? following : tile_of(next(), std::min(fitting(bytes), largest));
        return draw_by_lines(prepared.frame, tile, after, target, counts);
    });
}

void Pipeline::finish() {
    if (!by_lines_) return;
    put_drawn();
    by_lines_->begin();
    by_lines_->lines.finish();
}

void Pipeline::abandon() noexcept {
    if (exact_) exact_->forget();
    if (!by_lines_) return;
    try {
        device_.finish();  // what was queued ahead draws into lines that a frame may take next
    } catch (...) {
    }
    by_lines_->begin();
    by_lines_->lines.abandon();
}

void Pipeline::shoot(const PreparedFrame& prepared, std::span<const Ray> rays, RayPartitions* answers,
                     const Progress& progress, PipelineCounts& counts) {
    const std::vector<std::byte> list = kernels_.rays(rays);
    const std::size_t bytes = kernels_.ray_bytes();
    if (exact_) exact_->forget();  // what a call that threw has left
    picture_.release();
    exact();
    for_each_tile({0, rays.size()}, fitting(bytes + Exact::ray_bytes), first_rays, progress, [&](const Tile& tile, const Tile&) {
        make_room(tile.rays * (bytes + Exact::ray_bytes), tile_.rays.size());
        tile_.rays.reserve(tile.rays * bytes);
        tile_.rays.upload(list.data() + tile.first * bytes, tile.rays * bytes);
        kernel::Frame frame = prepared.frame;
        frame.ray_count = tile.rays;
        upload(frame);
        if (!weave(tile_, tile.rays, Rays::listed, counts)) return false;
        exact().settle(tile.rays, true, counts);
        const auto claims = exact().claims(tile.rays);
        for (std::uint32_t i = 0; i < tile.rays; ++i) {
            answers[tile.first + i] = to_partitions(kernels_, prepared.frame, rays[tile.first + i], claims[i]);
            for (const ClaimedPartition& claim : claims[i]) counts.overlaps += !claim.claimants.empty();
        }
        ++counts.tiles;
        return true;
    });
}

}  // namespace csgrt
