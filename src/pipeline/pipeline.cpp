#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <chrono>

#include "kernel_geometry.hpp"

namespace csgrt {
namespace {

constexpr std::uint64_t most_rays = 1u << 24;  // of one tile: launches stay short
constexpr std::uint32_t block_rays = BLOCK * BLOCK;

template <class Make>
double timed(const Make& make) {
    const auto start = std::chrono::steady_clock::now();
    make();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::uint64_t pixel_bytes(const kernel::Frame& frame) {
    std::uint64_t floats = 0;
    const auto add = [&](std::uint32_t channels, std::uint64_t planes) {
        if (frame.channels & channels) floats += planes;
    };
    add(CHANNEL_COLOR, 4);
    add(CHANNEL_DISTANCE, 1);
    add(CHANNEL_NORMAL, 3);
    add(CHANNEL_IDS, 2);
    add(CHANNEL_COUNTS, 3);
    return floats * sizeof(float);
}

std::uint64_t row_of_blocks(const kernel::Frame& frame) {
    return (std::uint64_t{frame.width} + BLOCK - 1) / BLOCK * block_rays;
}

}  // namespace

Pipeline::Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings)
    : device_(device),
      scene_(scene),
      kernels_(kernels),
      settings_(settings),
      buffers_(device, scene, kernels.tables()),
      tile_(device) {}

Exact& Pipeline::exact() {
    if (!exact_) build_ms_ += timed([&] { exact_.emplace(device_, scene_, kernels_, settings_); });
    return *exact_;
}

FirstHits& Pipeline::first_hits() {
    if (!first_hits_) build_ms_ += timed([&] { first_hits_.emplace(device_, scene_, settings_); });
    return *first_hits_;
}

// Rays of a tile that take no more than a quarter of the budget: the rest is for segments and partitions.
std::uint64_t Pipeline::fitting(std::uint64_t bytes_a_ray) const {
    const std::uint64_t held = tile_.picture.size() + tile_.rays.size() + (exact_ ? exact_->held() : 0) +
                               (first_hits_ ? first_hits_->held() : 0);
    const std::uint64_t most = std::min((device_.available() + held) / 4, device_.max_buffer()) / bytes_a_ray;
    return std::clamp<std::uint64_t>(most, 1, most_rays);
}

// For what a tile's rays need, whatever they hit: what the last call left may be in the way.
void Pipeline::make_room(std::uint64_t bytes) {
    if (bytes <= device_.available() + tile_.picture.size()) return;
    if (exact_) exact_->release();
    if (first_hits_) first_hits_->release();
}

// `row`: tiles are whole numbers of these, or parts of one.
void Pipeline::for_each_tile(std::uint64_t rays, std::uint64_t size, std::uint64_t row, const Progress& progress,
                             const std::function<bool(const Tile&)>& work) {
    std::uint64_t first = 0;
    while (first < rays) {
        size = size >= row ? size / row * row : size;
        const std::uint64_t most = first % row == 0 && size >= row ? size : std::min(size, row - first % row);
        const Tile tile{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::min(most, rays - first))};
        if (!work(tile)) {
            if (tile.rays == 1)
                throw Error(Status::out_of_memory,
                            "the segments of one ray do not fit the device's memory (" +
                                std::to_string(device_.budget() >> 20) + " MiB): raise --max-memory, or use --reference");
            size = tile.rays / 2;
            continue;
        }
        first += tile.rays;
        if (progress && !progress(static_cast<double>(first) / static_cast<double>(rays)))
            throw Error(Status::interrupted, "interrupted");
    }
}

kernel::Frame Pipeline::frame_of(const PreparedFrame& prepared, const Tile& tile) const {
    kernel::Frame frame = prepared.frame;
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    if (frame.listed) {
        frame.first_ray = 0;  // the device holds this tile's part of the list only
        return frame;
    }
    const auto row = static_cast<std::uint32_t>(row_of_blocks(frame));
    frame.first_row = tile.first / row * BLOCK;
    frame.rows = std::min((tile.first + tile.rays - 1) / row * BLOCK + BLOCK, frame.height) - frame.first_row;
    frame.columns = frame.width;
    if (tile.rays < row) {  // part of a row
        frame.first_column = tile.first % row / block_rays * BLOCK;
        frame.columns = std::min<std::uint32_t>(((tile.first + tile.rays - 1) % row / block_rays + 1) * BLOCK, frame.width) -
                        frame.first_column;
    }
    return frame;
}

void Pipeline::upload(const kernel::Frame& frame) {
    const std::vector<std::byte> bytes = kernels_.frame(frame);
    tile_.frame.reserve(bytes.size());
    tile_.frame.upload(bytes);
}

void Pipeline::upload_lights(const PreparedFrame& prepared) {
    const std::vector<std::byte> lights = kernels_.lights(prepared.lights);
    tile_.lights.reserve(lights.size());
    if (!lights.empty()) tile_.lights.upload(lights);
}

void Pipeline::read_picture(const kernel::Frame& frame, const std::vector<float*>& planes) {
    const std::size_t width = frame.width, size = std::size_t{frame.columns} * frame.rows;
    if (frame.columns == frame.width && frame.ray_count % row_of_blocks(frame) == 0) {
        for (std::size_t i = 0; i < planes.size(); ++i)
            tile_.picture.read(planes[i] + frame.first_row * width, size * sizeof(float), i * size * sizeof(float));
        return;
    }
    const auto values = tile_.picture.read<float>(planes.size() * size);
    for (std::uint32_t ray = frame.first_ray; ray < frame.first_ray + frame.ray_count; ++ray) {
        const kernel::pixel_position at = kernel::pixel_of(ray, frame.width, frame.height);
        if (!at.inside) continue;
        const std::size_t from = std::size_t{at.y - frame.first_row} * frame.columns + (at.x - frame.first_column);
        for (std::size_t i = 0; i < planes.size(); ++i) planes[i][at.y * width + at.x] = values[i * size + from];
    }
}

// Into the picture of the tile that they are of.
void Pipeline::draw_picked(kernel::Frame frame, const std::vector<std::uint32_t>& numbers, PipelineCounts& counts) {
    for_each_tile(numbers.size(), fitting(Exact::ray_bytes + sizeof(std::uint32_t)), 1, nullptr, [&](const Tile& tile) {
        make_room(tile.rays * (sizeof(std::uint32_t) + Exact::ray_bytes));
        tile_.rays.reserve(tile.rays * sizeof(std::uint32_t));
        tile_.rays.upload(numbers.data() + tile.first, tile.rays * sizeof(std::uint32_t));
        frame.picked = 1;
        frame.ray_count = tile.rays;
        upload(frame);
        return exact().run(buffers_, tile_, tile.rays, true, counts);
    });
}

void Pipeline::render(const PreparedFrame& prepared, const std::vector<float*>& planes, const Progress& progress,
                      PipelineCounts& counts) {
    const bool every = prepared.frame.every_partition;
    upload_lights(prepared);
    tile_.rays = Buffer(device_, tile_.rays.name());
    every ? static_cast<void>(exact()) : static_cast<void>(first_hits());
    const std::uint64_t bytes = pixel_bytes(prepared.frame) + (every ? Exact::ray_bytes : FirstHits::ray_bytes);
    for_each_tile(prepared.rays, fitting(bytes), row_of_blocks(prepared.frame), progress, [&](const Tile& tile) {
        const kernel::Frame frame = frame_of(prepared, tile);
        const std::uint64_t picture = std::uint64_t{frame.columns} * frame.rows * pixel_bytes(frame);
        make_room(picture + tile.rays * bytes);
        tile_.picture.reserve(picture);
        upload(frame);
        if (every) {
            if (!exact().run(buffers_, tile_, tile.rays, true, counts)) return false;
            exact().add_results(tile.rays, counts);
        } else {
            const std::vector<std::uint32_t> overflown = first_hits().run(buffers_, tile_, tile.rays, counts);
            if (!overflown.empty()) draw_picked(frame, overflown, counts);
        }
        read_picture(frame, planes);
        ++counts.tiles;
        return true;
    });
}

std::vector<RayPartitions> Pipeline::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays,
                                           const Progress& progress, PipelineCounts& counts) {
    const std::vector<std::byte> list = kernels_.rays(rays);
    const std::size_t bytes = kernels_.ray_bytes();
    std::vector<RayPartitions> answers(rays.size());
    tile_.picture = Buffer(device_, tile_.picture.name());
    exact();
    for_each_tile(rays.size(), fitting(bytes + Exact::ray_bytes), 1, progress, [&](const Tile& tile) {
        make_room(tile.rays * (bytes + Exact::ray_bytes));
        tile_.rays.reserve(tile.rays * bytes);
        tile_.rays.upload(list.data() + tile.first * bytes, tile.rays * bytes);
        upload(frame_of(prepared, tile));
        if (!exact().run(buffers_, tile_, tile.rays, false, counts)) return false;
        const auto claims = exact().claims(tile.rays, counts);
        for (std::uint32_t i = 0; i < tile.rays; ++i)
            answers[tile.first + i] = to_partitions(kernels_, prepared.frame, rays[tile.first + i], claims[i]);
        ++counts.tiles;
        return true;
    });
    return answers;
}

}  // namespace csgrt
