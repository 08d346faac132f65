#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "clock.hpp"
#include "kernel_geometry.hpp"

namespace csgrt {
namespace {

constexpr std::uint64_t most_rays = 1u << 24;   // of one tile: launches stay short
constexpr std::uint64_t most_drawn = 1u << 22;  // of a picture: the pixels of one tile are put while the next is drawn

// Every partition of more rays at once takes more memory and, on a processor, no less time. A GPU wants many: it gets half of a
// picture, for half of the memory and a fifth more of its time (bench/NOTES.md).
std::uint64_t most_rays_woven(const Device& device, std::uint64_t rays) {
    constexpr std::uint64_t of_processor = 1u << 16, of_gpu = 1u << 18;
    if (device.info().type == "cpu") return of_processor;
    return std::clamp((rays + 1) / 2, of_gpu, most_drawn);
}

}  // namespace

Pipeline::Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings,
                   Readback readback)
    : device_(device),
      scene_(scene),
      kernels_(kernels),
      settings_(settings),
      buffers_(device, scene, kernels.tables()),
      tile_(device),
      reader_(device, readback) {}

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

void Pipeline::prepare(bool every_partition) {
    every_partition ? static_cast<void>(exact()) : static_cast<void>(first_hits());
    if (reader_.is_prepared()) return;
    const auto start = Clock::now();
    reader_.prepare();
    build_ms_ += milliseconds_since(start);
}

// Rays of a tile that take no more than a quarter of the budget: the rest is for segments and partitions.
std::uint64_t Pipeline::fitting(std::uint64_t bytes_a_ray) const {
    const std::uint64_t held = tile_.picture.size() + tile_.rays.size() + reader_.held() + (exact_ ? exact_->held() : 0) +
                               (first_hits_ ? first_hits_->held() : 0);
    const std::uint64_t most = std::min((device_.available() + held) / 4, device_.max_buffer()) / bytes_a_ray;
    return std::clamp<std::uint64_t>(most, 1, most_rays);
}

// For what a tile's rays need, whatever they hit: what the last call left may be in the way. `reused`: of what is
// needed, this much is held already.
void Pipeline::make_room(std::uint64_t bytes, std::uint64_t reused) {
    if (bytes <= device_.available() + reused) return;
    tile_.rays = Buffer(device_, tile_.rays.name());
    reader_.release();
    if (exact_) exact_->release();
    if (first_hits_) first_hits_->release();
}

// `unit`: tiles are whole numbers of these, or parts of one.
void Pipeline::for_each_tile(RayRange range, std::uint64_t size, std::uint64_t unit, const Progress& progress,
                             const std::function<bool(const Tile&)>& work) {
    std::uint64_t first = range.first;
    while (first < range.end) {
        size = size >= unit ? size / unit * unit : size;
        const std::uint64_t most = first % unit == 0 && size >= unit ? size : std::min(size, unit - first % unit);
        const Tile tile{static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(std::min(most, range.end - first))};
        if (!work(tile)) {
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
    tile_.lights.reserve(lights.size());
    if (!lights.empty()) tile_.lights.upload(lights);
}

Cull& Pipeline::cull(const kernel::Frame& frame) { return frame.every_partition ? exact().cull() : first_hits().cull(); }

void Pipeline::ask_for_seen(kernel::Frame frame, const Tile& tile) {
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    upload(frame);
    cull(frame).launch(buffers_, tile_, frame);
}

// The numbers of the tile's blocks that may see anything.
std::vector<std::uint32_t> Pipeline::seen_blocks(const kernel::Frame& frame, const Tile& tile, PipelineCounts& counts) {
    if (std::exchange(ahead_, {}) != tile) {
        make_room(cull_bytes(tile), cull(frame).held());
        ask_for_seen(frame, tile);
    }
    return cull(frame).seen(counts);
}

// What the next tile sees comes with what there is to know of this one: a device, and the bus, stand still whenever the host
// waits for an answer before it says what comes next.
void Pipeline::look_ahead(const kernel::Frame& frame, const Tile& tile) {
    if (tile.rays == 0 || tile.rays % block_rays != 0 || reader_.in_place()) return;
    if (cull_bytes(tile) > device_.available() + cull(frame).held()) return;  // this tile's memory is still wanted
    ask_for_seen(frame, tile);
    ahead_ = tile;
}

// Makes the frame's tile one of these rays, or blocks of them.
bool Pipeline::list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                         std::uint64_t pixel_bytes, std::uint64_t ray_bytes) {
    frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * rays_each;
    frame.picked = rays_each == 1;
    if (numbers.empty()) return false;
    const std::uint64_t picture = frame.ray_count * pixel_bytes, list = numbers.size() * sizeof(std::uint32_t);
    make_room(picture + list + frame.ray_count * ray_bytes, tile_.picture.size() + tile_.rays.size());
    tile_.picture.reserve(picture);
    list_upload_.start<std::uint32_t>(tile_.rays, numbers);
    upload(frame);
    return true;
}

// As Exact's, of a picture: what the last tile's pixels took comes before a smaller tile.
bool Pipeline::run_exactly(std::uint32_t rays, Rays kind, PipelineCounts& counts) {
    if (exact().run(buffers_, tile_, rays, kind, counts)) return true;
    if (reader_.held() == 0) return false;
    reader_.release();
    return exact().run(buffers_, tile_, rays, kind, counts);
}

// Rays of a picture the exact way, one by one.
void Pipeline::draw_exactly(kernel::Frame frame, const std::vector<std::uint32_t>& numbers,
                            const RenderTarget& target, PipelineCounts& counts) {
    const std::uint64_t pixel_bytes = target.planes.size() * sizeof(float),
                        bytes = pixel_bytes + sizeof(std::uint32_t) + Exact::ray_bytes;
    for_each_tile({0, numbers.size()}, fitting(bytes), 1, nullptr, [&](const Tile& tile) {
        const auto begin = numbers.begin() + tile.first;
        const std::vector<std::uint32_t> picked(begin, begin + tile.rays);
        list_rays(frame, picked, 1, pixel_bytes, Exact::ray_bytes);
        if (!run_exactly(frame.ray_count, Rays::picked, counts)) return false;
        reader_.put_rays(frame, picked, tile_, target);
        if (frame.every_partition) exact().add_tallies(tile.rays, counts);
        return true;
    });
}

// false: the tile does not fit the memory.
bool Pipeline::draw(kernel::Frame frame, const Tile& tile, const Tile& next, const RenderTarget& target,
                    PipelineCounts& counts) {
    const std::uint32_t first = tile.first / block_rays, end = (tile.first + tile.rays) / block_rays;
    const std::vector<std::uint32_t> seen = seen_blocks(frame, tile, counts);
    frame.first_ray = tile.first;
    const bool sees = list_rays(frame, seen, block_rays, target.planes.size() * sizeof(float),
                                frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes);
    const bool short_way = sees && !frame.every_partition;
    if (short_way) {
        first_hits().launch(buffers_, tile_, frame.ray_count);
    } else if (sees) {
        if (!run_exactly(frame.ray_count, Rays::blocks, counts)) return false;
        exact().add_tallies(frame.ray_count, counts);
    }
    look_ahead(frame, next);
    reader_.look(frame, first, end, seen.size(), tile_, target);
    device_.finish();
    if (short_way) first_hits().fetch();
    reader_.fetch();
    if (ahead_) cull(frame).fetch();
    std::vector<std::uint32_t> overflown;
    if (short_way) overflown = first_hits().overflown(counts);
    reader_.put_blocks(frame, first, end, seen, tile_, next.rays == 0, target);
    draw_exactly(frame, overflown, target, counts);
    return true;
}

void Pipeline::render(const PreparedFrame& prepared, RayRange range, const std::function<RayRange()>& next,
                      const RenderTarget& target, const Progress& progress, PipelineCounts& counts) {
    const bool every = prepared.frame.every_partition;
    if (!ahead_) upload_lights(prepared);  // else the frame's are there
    prepare(every);
    const std::uint64_t bytes = target.planes.size() * sizeof(float) + sizeof(std::uint32_t) + Cull::list_bytes +
                                (every ? Exact::ray_bytes : FirstHits::ray_bytes);
    const std::uint64_t most = every ? most_rays_woven(device_, prepared.rays) : most_drawn;
    const auto begin_of = [](RayRange r, std::uint64_t size) {
        return Tile{static_cast<std::uint32_t>(r.first),
                    static_cast<std::uint32_t>(std::min(size / block_rays * block_rays, r.end - r.first))};
    };
    for_each_tile(range, std::min(fitting(bytes), most), block_rays, progress, [&](const Tile& tile) {
        ++counts.tiles;
        const std::uint64_t end = std::uint64_t{tile.first} + tile.rays;
        if (tile.rays % block_rays != 0) {
            std::vector<std::uint32_t> numbers(tile.rays);
            std::iota(numbers.begin(), numbers.end(), tile.first);
            draw_exactly(prepared.frame, numbers, target, counts);
            return true;
        }
        Tile following = begin_of({end, range.end}, tile.rays);
        if (end == range.end) {
            following = begin_of(next(), std::min(fitting(bytes), most));
        }
        return draw(prepared.frame, tile, following, target, counts);
    });
}

void Pipeline::finish() {
    ahead_.reset();
    reader_.finish();
}

void Pipeline::abandon() noexcept {
    ahead_.reset();
    reader_.abandon();
}

void Pipeline::shoot(const PreparedFrame& prepared, std::span<const Ray> rays, RayPartitions* answers,
                     const Progress& progress, PipelineCounts& counts) {
    const std::vector<std::byte> list = kernels_.rays(rays);
    const std::size_t bytes = kernels_.ray_bytes();
    tile_.picture = Buffer(device_, tile_.picture.name());
    exact();
    for_each_tile({0, rays.size()}, fitting(bytes + Exact::ray_bytes), 1, progress, [&](const Tile& tile) {
        make_room(tile.rays * (bytes + Exact::ray_bytes), tile_.rays.size());
        tile_.rays.reserve(tile.rays * bytes);
        tile_.rays.upload(list.data() + tile.first * bytes, tile.rays * bytes);
        kernel::Frame frame = prepared.frame;
        frame.ray_count = tile.rays;
        upload(frame);
        if (!exact().run(buffers_, tile_, tile.rays, Rays::listed, counts)) return false;
        exact().add_tallies(tile.rays, counts);
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
