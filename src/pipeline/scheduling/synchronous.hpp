// Synchronous schedule: one batch at a time. The host reads which tiles of the batch see anything, runs kernels for
// these tiles alone, and reads their pixels. Processors, which share the host's memory, draw pictures by this schedule.
// All devices use it for single pixels and for lists of rays.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "pipeline/scheduling/device_passes.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// The size of batches: so many rays that a batch takes about 10 ms, estimated from the last batches.
class BatchSize {
public:
    std::uint64_t rays() const { return rays_; }
    /// Adds a measurement: the time of `rays` rays, which see something or are of a list.
    void add(std::uint64_t rays, double ms) {
        if (rays == 0) return;
        ms_a_ray_ = std::max(ms / static_cast<double>(rays), 0.9 * ms_a_ray_);
        rays_ = std::clamp(static_cast<std::uint64_t>(10 / ms_a_ray_), std::uint64_t{tile_rays}, 2 * rays_);
    }

private:
    double ms_a_ray_ = 0;  ///< of the costliest batch; decays from batch to batch
    std::uint64_t rays_ = 1 << 13;
};

/// The schedule draws frames on processors, and traces single pixels and lists on any device, one batch at a time.
class SynchronousSchedule {
public:
    /// Refers to the passes. `memory` returns the device's memory, with the bytes that the pipeline uses. `reclaim`
    /// frees memory that others keep for later; it returns false if there was none.
    SynchronousSchedule(DevicePasses& passes, std::function<DeviceMemory()> memory, std::function<bool()> reclaim);

    void render(const FrameJob& job);
    /// Draws single pixels, by their rays' numbers, with every partition.
    void draw_pixels(const FrameJob& job, std::span<const std::uint32_t> numbers);
    /// Draws the pixels of a batch that is less than a tile.
    void draw_part_of_tile(const FrameJob& job, const RayBatch& batch);
    /// Puts the rows of the rays that `source` gives, by number, into the receiver.
    void trace_list(const kernel::Frame& frame, const RayList& rays, BatchSource& source, RowReceiver& receiver,
                    const ReportDone& report_done, PipelineCounts& counts);

    ~SynchronousSchedule() { wait_until_done(rays_upload_); }

    std::uint64_t listed_ray_bytes() const { return passes_.records().ray_bytes() + PartitionMemory::ray_bytes; }
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
        frame_upload_.start<std::byte>(batch_.frame, passes_.records().frame(frame));
    }
    /// Sets the frame's work to the listed rays, uploads frame and list, and reserves memory for the pixels.
    void start_work(kernel::Frame& frame, Work work, std::span<const std::uint32_t> numbers, std::uint64_t pixel_bytes,
                    std::uint64_t ray_bytes);

    DevicePasses& passes_;
    std::function<DeviceMemory()> memory_;
    std::function<bool()> reclaim_;
    BatchBuffers batch_;
    Buffer picture_;  ///< a float a ray for each channel
    QueuedUpload frame_upload_, list_upload_;
    std::optional<PinnedMemory> staged_rays_;
    Event rays_upload_;
    BatchSize batch_size_;
    std::uint64_t seen_ = 0;  ///< rays of the last batch that see something
};

}  // namespace csgrt
