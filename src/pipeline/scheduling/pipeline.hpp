// CompiledScene + Frame -> a picture or partitions. Rays go through in batches (ranges of their numbers): of a picture the
// tiles that see nothing are left out (cull.hpp), the rays of the others go the short way (first_hits.hpp) if only the first
// hits are wanted, else the exact way (exact.hpp), and their pixels into the image: in place (picture.hpp), or by lines from a GPU,
// which is given the next batches before the host looks at this one (by_lines.hpp). A batch that does not fit the memory is halved, down
// to one ray. Nothing a ray computes depends on its batch.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/scheduling/by_lines.hpp"
#include "pipeline/passes/partitions.hpp"
#include "pipeline/passes/first_hits.hpp"
#include "pipeline/readback/picture.hpp"
#include "pipeline/scheduling/batch_source.hpp"

namespace csgrt {

/// How pixels come to the host: by lines, as from a GPU, also from another device?
enum class Readback { by_device, lines };

class Pipeline {
public:
    /// Of a picture's batch: the pixels of one are put while the next is drawn.
    static constexpr std::uint64_t most_rays_drawn = 1u << 22;

    /// Uploads the scene. Kernels are compiled when they are first wanted. `kernels` are the host's in the same precision.
    /// `most_rays`: of a picture's batches. All three objects must outlive the pipeline.
    Pipeline(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings,
             Readback readback = Readback::by_device, std::uint64_t most_rays = most_rays_drawn);

    /// Compiles the kernels of such frames, if that was not done.
    void prepare(bool every_partition);
    /// Is told how many more rays are done. What it throws ends the work.
    using Told = std::function<void(std::uint64_t rays)>;

    /// Draws the frame's rays, so far as `take` gives them; each range begins with a tile. Some of it may come into the target until
    /// finish(). Throws Error (out_of_memory, device_fault).
    void render(const PreparedFrame& prepared, const TakeRays& take, const RenderTarget& target, const Told& told,
                PipelineCounts& counts);
    /// Returns when the target holds all that was drawn. Throws what kept it from doing so.
    void finish();
    /// Returns when nothing more comes into the target.
    void abandon() noexcept;
    /// An answer for each ray that `take` gives.
    void shoot(const PreparedFrame& prepared, std::span<const Ray> rays, const TakeRays& take, RayPartitions* answers, const Told& told,
               PipelineCounts& counts);

    /// Does its device draw a batch while it copies another's pixels?
    bool copies_beside() const { return by_lines_.has_value(); }
    double build_ms() const { return build_ms_; }  ///< spent on compiling kernels so far

private:
    Exact& exact();
    FirstHits& first_hits();
    Cull& cull(const kernel::Frame& frame);
    std::uint64_t fitting(std::uint64_t bytes_a_ray) const;
    std::uint64_t largest_batch(const kernel::Frame& frame) const;
    void make_room(std::uint64_t bytes, std::uint64_t reused);
    void for_each_batch(BatchSource& source, const Told& told, const std::function<bool(const RayBatch&)>& work);
    void upload(const kernel::Frame& frame);
    void upload_lights(const PreparedFrame& prepared);
    bool list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                   std::uint64_t pixel_bytes, std::uint64_t ray_bytes);
    std::optional<Exact::Needs> weave(std::uint32_t rays, Rays kind, TimedKernels& timed);

    /// What a frame's batches have in common.
    struct Drawing {
        const kernel::Frame& frame;
        BatchSource& source;
        const RenderTarget& target;
        const Told& told;
        PipelineCounts& counts;

        /// A batch is done.
        void tell(std::uint32_t rays) const {
            ++counts.batches;
            if (told) told(rays);
        }
    };
    static std::uint64_t pixel_bytes_of(const RenderTarget& target);
    static std::uint64_t cull_bytes(const RayBatch& batch);
    std::uint64_t bytes_a_ray(const kernel::Frame& frame, const RenderTarget& target) const;
    bool draw_in_place(const Drawing& d, const RayBatch& batch);
    void draw_part_of_tile(const Drawing& d, const RayBatch& batch);
    void draw_exactly(const Drawing& d, const std::vector<std::uint32_t>& numbers);

    void first_hits_by_lines(const Drawing& d);
    void partitions_by_lines(const Drawing& d);
    QueuedBatch* queue_next(const Drawing& d);
    bool queue(QueuedBatch& queued, const Drawing& d, const RayBatch& batch);
    void put_background(QueuedBatch& queued, const RenderTarget& target);
    void put(QueuedBatch& batch, const Drawing& d);
    void read_overflown(QueuedBatch& batch);
    std::uint32_t take_list(QueuedBatch& batch);
    PictureLines::Lines* take_lines(const QueuedBatch& batch, const Drawing& d);
    bool weave_alone(QueuedBatch& batch, const Drawing& d);
    bool draw_alone(QueuedBatch& batch, const Drawing& d);
    void shade(QueuedBatch& batch, const Drawing& d);
    static const Event& end_of(const QueuedBatch& batch);
    bool settle(QueuedBatch& batch, const Drawing& d);
    static void give_up(QueuedBatch& batch);
    static void give_back(QueuedBatch& batch, const Drawing& d);

    Device& device_;
    const CompiledScene& scene_;
    const HostKernels& kernels_;
    Settings settings_;
    std::uint64_t most_rays_;
    SceneBuffers buffers_;
    BatchBuffers batch_;  ///< in place, single rays, and lists
    Buffer picture_;    ///< its pixels, ray by ray
    QueuedUpload frame_upload_, list_upload_;
    std::optional<Exact> exact_;
    std::optional<FirstHits> first_hits_;
    std::optional<ByLines> by_lines_;
    bool drew_every_partition_ = false;  ///< of the last frame
    double build_ms_ = 0;
};

}  // namespace csgrt
