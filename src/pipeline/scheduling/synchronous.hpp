// One batch at a time: the host reads which of its tiles see anything, has kernels run for these alone, and reads their
// pixels. So processors draw, which share the host's memory. On every device, so single pixels and lists of rays are
// traced.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "compile/lists/ray_list.hpp"
#include "compile/lists/sink.hpp"
#include "pipeline/scheduling/device_passes.hpp"

namespace csgrt {

/// How many rays a batch has that takes some 10 ms, as far as the last ones tell.
class Pace {
public:
    std::uint64_t rays() const { return rays_; }
    /// So many rays that see something, or of a list, took so long.
    void add(std::uint64_t rays, double ms) {
        if (rays == 0) return;
        ms_a_ray_ = std::max(ms / static_cast<double>(rays), 0.9 * ms_a_ray_);
        rays_ = std::clamp(static_cast<std::uint64_t>(10 / ms_a_ray_), std::uint64_t{tile_rays}, 2 * rays_);
    }

private:
    double ms_a_ray_ = 0;  ///< of the costliest batch, which is forgotten by and by
    std::uint64_t rays_ = 1 << 13;
};

class SynchronousSchedule {
public:
    /// `memory`: the device's, with all that the pipeline holds of it. `reclaim` gives back what others hold for later;
    /// false: they held none.
    SynchronousSchedule(DevicePasses& passes, std::function<DeviceMemory()> memory, std::function<bool()> reclaim);

    void render(const FrameJob& job);
    /// Every partition of single pixels, by their rays' numbers, and what is seen of them.
    void draw_pixels(const FrameJob& job, std::span<const std::uint32_t> numbers);
    /// The pixels of a batch that is less than a tile.
    void draw_part_of_tile(const FrameJob& job, const RayBatch& batch);
    /// Puts the rows of the rays that `source` gives, by number.
    void trace_list(const kernel::Frame& frame, const RayList& rays, BatchSource& source, RowTaker& sink,
                    const Told& told, PipelineCounts& counts);

    ~SynchronousSchedule() { wait_until_done(rays_upload_); }

    std::uint64_t listed_ray_bytes() const { return passes_.kernels().ray_bytes() + PartitionMemory::ray_bytes; }
    std::uint64_t held() const { return batch_.held() + picture_.size(); }

private:
    template <class Work>
    void for_each_batch(BatchSource& source, const Work& work);
    bool draw_tiles(const FrameJob& job, const RayBatch& batch);
    void draw_first_hits(const FrameJob& job, std::uint32_t rays, std::vector<std::uint32_t>& overflown);
    bool draw_partitions(const FrameJob& job, Work work, std::uint32_t rays, bool are_tallied);
    std::optional<PartitionSizes> trace(const PartitionPass::Input& input, TimedKernels& timed);
    void finish_trace(std::uint32_t rays, bool are_tallied, TimedKernels& timed, PipelineCounts& counts);
    void make_room(std::uint64_t bytes, std::uint64_t reused);
    void upload_rays(const RayList& rays, const RayBatch& batch);
    void upload(const kernel::Frame& frame) {
        frame_upload_.start<std::byte>(batch_.frame, passes_.kernels().frame(frame));
    }
    /// Makes the frame one of the rays that are listed, uploads both and makes room for their pixels.
    void start_work(kernel::Frame& frame, Work work, std::span<const std::uint32_t> numbers, std::uint64_t pixel_bytes,
                    std::uint64_t ray_bytes);

    DevicePasses& passes_;
    std::function<DeviceMemory()> memory_;
    std::function<bool()> reclaim_;
    BatchBuffers batch_;
    Buffer picture_;  ///< of each channel a float a ray
    QueuedUpload frame_upload_, list_upload_;
    std::optional<PinnedMemory> staged_rays_;
    Event rays_upload_;
    Pace pace_;
    std::uint64_t seen_ = 0;  ///< rays of the last batch that see something
};

}  // namespace csgrt
