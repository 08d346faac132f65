// Asynchronous schedule: on GPUs two batches are underway. While the kernels of one batch run, the kernels of the other
// are queued, and pixels of earlier batches are copied. Otherwise the device would be idle while the host waits for
// results before it queues more.
//
// clang-format off
//            start                 trace              shade             collect
//   free  ----------->  culled  ----------> traced  ---------> shaded  ---------->  free
//                       kernel 0,           kernels           kernel 5              pixels are copied
//                       tile list           1 to 4                                  (readback/ring.hpp)
// clang-format on
//
// A batch of first hits goes from free to shaded in one step: the host need not read the result of a kernel before it
// queues the next.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "pipeline/readback/ring.hpp"
#include "pipeline/scheduling/device_passes.hpp"
#include "pipeline/scheduling/synchronous.hpp"

namespace csgrt {

/// The schedule draws frames on a GPU. Each of its two batches goes through the stages above. It advances the batch
/// that needs no wait, so that the device always has queued work.
class AsynchronousSchedule {
public:
    /// Draws whole tiles by `passes`; `pixels` traces single pixels.
    AsynchronousSchedule(DevicePasses& passes, SynchronousSchedule& pixels);

    /// Compiles the kernels that every frame needs.
    void prepare() { passes_.tile_list(); }
    /// Draws all rays that the job's source gives. Some pixels may be written into the target later, until finish().
    void render(const FrameJob& job);
    /// Returns when all pixels are in the target. Throws if a copy failed.
    void finish() { ring_.finish(); }
    /// Returns when nothing more will be written into the target, whatever was underway.
    void abandon() noexcept;

    std::uint64_t held() const;
    /// Gives memory back that no batch uses. Returns false if there was none.
    bool reclaim();

private:
    enum class Stage { free, culled, traced, shaded };

    struct Batch {
        explicit Batch(Device& device) : buffers(device), report_read(device, "report") {}

        Stage stage = Stage::free;
        RayBatch rays;
        kernel::Frame frame{};  ///< of the batch's rays; after culling, only of the tiles that may see the scene
        BatchBuffers buffers;
        ReadbackRing::DevicePicture* picture = nullptr;
        QueuedUpload frame_upload;
        QueuedRead report_read;
        std::vector<Event> culling;  ///< kernel 0, the list's kernels, the background
        TimedKernels drawing;        ///< kernels 1 to 5, or the kernel of first hits
        PartitionSizes capacity;     ///< of the buffers with which kernels 1 to 4 were queued

        const Event& end() const { return drawing.empty() ? culling.back() : drawing.back().second; }
        const kernel::BatchReport& report() { return report_read.wait<kernel::BatchReport>(1).front(); }
        std::span<const std::uint8_t> shown() {
            return report_read.wait<std::uint8_t>(sizeof(kernel::BatchReport) + rays.tiles())
                .subspan(sizeof(kernel::BatchReport));
        }
    };

    Batch* next(const FrameJob& job);
    Batch* with(Stage stage);
    Batch* other(const Batch& batch) { return &batch == &batches_[0] ? &batches_[1] : &batches_[0]; }
    bool is_idle() const;
    std::size_t queue_of(const Batch& batch, bool every_partition) const;

    bool start_next(Batch& batch, const FrameJob& job);
    bool start(Batch& batch, const FrameJob& job, const RayBatch& rays);
    void trace(Batch& batch, const FrameJob& job);
    void shade(Batch& batch, const FrameJob& job);
    void collect(Batch& batch, const FrameJob& job);
    void collect_first_hits(Batch& batch, const FrameJob& job);
    void collect_partitions(Batch& batch, const FrameJob& job);
    void retry(Batch& batch, const FrameJob& job);
    void trace_alone(Batch& batch, const FrameJob& job);
    bool try_alone(Batch& batch, const FrameJob& job);
    void read_pixels(Batch& batch, const FrameJob& job);
    void cancel(Batch& batch);

    PartitionPass::Input input_of(const Batch& batch) const;
    void upload_frame(Batch& batch, const PartitionSizes& capacity);
    bool acquire_picture(Batch& batch, const FrameJob& job);
    void write_background(Batch& batch, const FrameJob& job);

    DevicePasses& passes_;
    SynchronousSchedule& pixels_;
    std::array<Batch, Device::queues> batches_;
    ReadbackRing ring_;
    std::vector<std::uint32_t> overflown_;  ///< first hits: rays that have to be traced as single pixels
    bool drew_every_partition_ = false;     ///< in the last frame
    bool is_memory_short_ = false;          ///< no other batch starts until a batch is collected
};

}  // namespace csgrt
