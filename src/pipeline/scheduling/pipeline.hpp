// Pipeline: one device makes a picture or rows from a CompiledScene and a Frame, in batches of rays. The result of a
// ray does not depend on its batch.
#pragma once

#include <optional>

#include "pipeline/scheduling/native_lists.hpp"
#include "pipeline/scheduling/asynchronous.hpp"

namespace csgrt {

/// The number of batches that are underway. by_device: one on processors, two on GPUs. asynchronous: two on any device.
enum class Readback { by_device, asynchronous };

/// The pipeline draws frames and traces lists on one device. It has the scene's tables, the passes and two schedules;
/// the device's type decides which schedule draws.
class Pipeline {
public:
    /// The most rays of a picture's batch: the pixels of one batch are copied while the next is drawn.
    static constexpr std::uint64_t most_rays_drawn = 1u << 22;
    /// The most rays of a processor's batch, of a picture or of a list: the batch takes some 16 to 64 MiB
    /// (docs/performance.md).
    static constexpr std::uint64_t most_rays_on_processor(bool every_partition) {
        return every_partition ? 1u << 17 : 1u << 20;
    }

    /// The most rays of a list's batch on a GPU: the rows of one batch are copied while the next is traced.
    static constexpr std::uint64_t most_rays_listed = 1u << 18;

    /// Uploads the scene. Kernels are compiled when they are first needed. `records`: the converter for the kernels'
    /// precision. `most_rays`: the most rays of a picture's batch. `device`, `scene` and `records` must outlive the
    /// pipeline.
    Pipeline(Device& device, const CompiledScene& scene, const RecordConverter& records, const Settings& settings,
             Readback readback = Readback::by_device, std::uint64_t most_rays = most_rays_drawn);

    /// Sets another scene for the next calls; the two arguments must outlive the pipeline. Keeps buffers, and programs
    /// that can draw this scene. Throws Error (out_of_memory, device_fault).
    void set_scene(const CompiledScene& scene, const RecordConverter& records);
    bool can_draw(const CompiledScene& scene) const { return passes_.can_draw(scene); }
    /// Compiles the kernels for every partition or for first hits, if they are not compiled yet.
    void prepare(bool every_partition);
    /// Draws the frame's rays that `take` gives; each range begins with a tile. Some pixels may be written into the
    /// target later, until finish(). Throws Error (out_of_memory, device_fault).
    void render(const PreparedFrame& prepared, const TakeRays& take, const RenderTarget& target,
                const ReportDone& report_done, PipelineCounts& counts);
    /// Whether render() can draw the edges of such a frame: the device has memory for the whole picture.
    bool draws_edges(const PreparedFrame& prepared) const;
    /// Returns when the target has all pixels that were drawn. Throws if a copy failed.
    void finish();
    /// Returns when nothing more will be written into the target.
    void abandon() noexcept;
    /// Puts the rows of each ray that `take` gives into the receiver. The kernels of the native device are called
    /// directly, without OpenCL.
    void trace_list(const kernel::Frame& frame, const RayList& rays, const TakeRays& take, RowReceiver& receiver,
                    const ReportDone& report_done, PipelineCounts& counts);

    bool is_asynchronous() const { return asynchronous_.has_value(); }
    double build_ms() const { return passes_.build_ms(); }  ///< spent on compiling kernels so far

private:
    DeviceMemory memory() const;
    std::uint64_t most_rays(const PreparedFrame& prepared, std::size_t channels) const;
    bool is_processor() const { return passes_.device.info().type == "cpu"; }

    DevicePasses passes_;
    std::uint64_t most_rays_;
    SynchronousSchedule synchronous_;
    std::optional<AsynchronousSchedule> asynchronous_;
    const native::Level* native_level_ = nullptr;  ///< of a native device, else null
    std::optional<NativeLists> native_;            ///< with the kernels of `native_level_`
};

}  // namespace csgrt
