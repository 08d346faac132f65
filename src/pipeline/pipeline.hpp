// CompiledScene + Frame -> a picture or partitions. Rays go through in tiles (ranges of their numbers), each the short way
// (first_hits.hpp) if only the first hits are wanted, else the exact way (exact.hpp). A tile that does not fit the memory
// is halved, down to one ray. Nothing a ray computes depends on its tile.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/exact.hpp"
#include "pipeline/first_hits.hpp"

namespace csgrt {

class Pipeline {
public:
    /// Uploads the scene. Kernels are compiled when they are first wanted. `kernels` are the host's in the same precision.
    /// All three must outlive the pipeline.
    Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings);

    using Progress = std::function<bool(double)>;
    /// Fills the planes of the frame's channels, each width x height, by row from the top left.
    /// Throws Error (out_of_memory, device_fault; interrupted if `progress` says so).
    void render(const PreparedFrame& prepared, const std::vector<float*>& planes, const Progress& progress, PipelineCounts& counts);
    std::vector<RayPartitions> shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays, const Progress& progress,
                                     PipelineCounts& counts);

    double build_ms() const { return build_ms_; }  ///< spent on compiling kernels so far

private:
    /// Rays [first, first + rays) of a picture, of a list or of those picked.
    struct Tile {
        std::uint32_t first = 0, rays = 0;
    };
    Exact& exact();
    FirstHits& first_hits();
    std::uint64_t fitting(std::uint64_t bytes_a_ray) const;
    void make_room(std::uint64_t bytes);
    void for_each_tile(std::uint64_t rays, std::uint64_t size, std::uint64_t row, const Progress& progress,
                       const std::function<bool(const Tile&)>& work);
    kernel::Frame frame_of(const PreparedFrame& prepared, const Tile& tile) const;
    void upload(const kernel::Frame& frame);
    void upload_lights(const PreparedFrame& prepared);
    void read_picture(const kernel::Frame& frame, const std::vector<float*>& planes);
    void draw_picked(kernel::Frame frame, const std::vector<std::uint32_t>& numbers, PipelineCounts& counts);

    Device& device_;
    const CompiledScene& scene_;
    const HostKernels& kernels_;
    Settings settings_;
    SceneBuffers buffers_;
    TileBuffers tile_;
    std::optional<Exact> exact_;
    std::optional<FirstHits> first_hits_;
    double build_ms_ = 0;
};

}  // namespace csgrt
