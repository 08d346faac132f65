// CompiledScene + Frame -> a picture or partitions. Rays go through in tiles (ranges of their numbers): of a picture the
// blocks that see nothing are left out (cull.hpp), the rays of the others go the short way (first_hits.hpp) if only the first
// hits are wanted, else the exact way (exact.hpp), and their pixels into the image: in place (picture.hpp), or by lines from a GPU,
// which is given the next tile before the host looks at this one (by_lines.hpp). A tile that does not fit the memory is halved, down
// to one ray. Nothing a ray computes depends on its tile.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/by_lines.hpp"
#include "pipeline/exact.hpp"
#include "pipeline/first_hits.hpp"
#include "pipeline/frame_parts.hpp"
#include "pipeline/picture.hpp"

namespace csgrt {

using Progress = std::function<bool(double)>;

/// How pixels come to the host: by lines, as from a GPU, also from another device?
enum class Readback { by_device, lines };

class Pipeline {
public:
    /// Of a picture's tile: the pixels of one are put while the next is drawn.
    static constexpr std::uint64_t most_rays_drawn = 1u << 22;

    /// Uploads the scene. Kernels are compiled when they are first wanted. `kernels` are the host's in the same precision.
    /// `most_rays`: of a picture's tiles. All three objects must outlive the pipeline.
    Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings,
             Readback readback = Readback::by_device, std::uint64_t most_rays = most_rays_drawn);

    /// Compiles the kernels of such frames, if that was not done.
    void prepare(bool every_partition);
    /// Draws the frame, so far as the range goes; it begins with a block. Some of it may come into the target until finish().
    /// `next`: the range of the frame that the next call will have; empty: this is the frame's last.
    /// Throws Error (out_of_memory, device_fault; interrupted if `progress` says so).
    void render(const PreparedFrame& prepared, RayRange range, const std::function<RayRange()>& next,
                const RenderTarget& target, const Progress& progress, PipelineCounts& counts);
    /// Returns when the target holds all that was drawn. Throws what kept it from doing so.
    void finish();
    /// Returns when nothing more comes into the target.
    void abandon() noexcept;
    /// An answer for each ray.
    void shoot(const PreparedFrame& prepared, std::span<const Ray> rays, RayPartitions* answers, const Progress& progress,
               PipelineCounts& counts);

    /// Does its device draw a tile while it copies another's pixels?
    bool copies_beside() const { return by_lines_.has_value(); }
    double build_ms() const { return build_ms_; }  ///< spent on compiling kernels so far

private:
    Exact& exact();
    FirstHits& first_hits();
    Cull& cull(const kernel::Frame& frame);
    std::uint64_t fitting(std::uint64_t bytes_a_ray) const;
    std::uint64_t largest_tile(const kernel::Frame& frame) const;
    void make_room(std::uint64_t bytes, std::uint64_t reused);
    using FirstTile = std::function<Tile(RayRange, std::uint64_t)>;
    void for_each_tile(RayRange range, std::uint64_t size, const FirstTile& tile_of, const Progress& progress,
                       const std::function<bool(const Tile&, const Tile&)>& work);
    /// Of single rays.
    static Tile first_rays(RayRange range, std::uint64_t most) {
        return {static_cast<std::uint32_t>(range.first), static_cast<std::uint32_t>(std::min(most, range.end - range.first))};
    }
    void upload(const kernel::Frame& frame);
    void upload_lights(const PreparedFrame& prepared);
    bool list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                   std::uint64_t pixel_bytes, std::uint64_t ray_bytes);
    bool weave(const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts);

    std::uint64_t bytes_a_ray(const kernel::Frame& frame, const RenderTarget& target) const;
    bool draw_in_place(kernel::Frame frame, const Tile& tile, const RenderTarget& target, PipelineCounts& counts);
    bool draw_by_lines(const kernel::Frame& frame, const Tile& tile, const Tile& next, const RenderTarget& target,
                       PipelineCounts& counts);
    bool queue(QueuedTile& queued, kernel::Frame frame, const Tile& tile, const RenderTarget& target, const QueuedTile* before);
    void put_background(QueuedTile& queued, const RenderTarget& target);
    bool weave_queued(QueuedTile& queued, const RenderTarget& target, PipelineCounts& counts);
    void put_drawn();
    void read_overflown(QueuedTile& tile);
    void draw_overflown(const kernel::Frame& frame, const RenderTarget& target, PipelineCounts& counts);
    void release_lines(const QueuedTile* but = nullptr);
    void draw_exactly(kernel::Frame frame, const std::vector<std::uint32_t>& numbers, const RenderTarget& target,
                      PipelineCounts& counts);

    Device& device_;
    const CompiledScene& scene_;
    const HostKernels& kernels_;
    Settings settings_;
    std::uint64_t most_rays_;
    SceneBuffers buffers_;
    TileBuffers tile_;  ///< in place, single rays, and lists
    Buffer picture_;    ///< its pixels, ray by ray
    QueuedUpload frame_upload_, list_upload_;
    std::optional<Exact> exact_;
    std::optional<FirstHits> first_hits_;
    std::optional<ByLines> by_lines_;
    bool drew_every_partition_ = false;  ///< of the last frame
    double build_ms_ = 0;
};

}  // namespace csgrt
