#include "pipeline/scheduling/pipeline.hpp"

#include <algorithm>

#include "native/driver.hpp"

namespace csgrt {

Pipeline::Pipeline(Device& device, const CompiledScene& scene, const RecordConverter& records, const Settings& settings,
                   Readback readback, std::uint64_t most_rays)
    : passes_(device, scene, records, settings),
      most_rays_(most_rays),
      synchronous_(
          passes_, [this] { return memory(); }, [this] { return asynchronous_ && asynchronous_->reclaim(); }) {
    if (settings.precision == Precision::double_) native_level_ = native::level_of(device.cl().table, device.id());
    if (native_level_) native_.emplace(*native_level_, scene, device);
    // A processor shares the host's memory, and its kernels leave no time for other work.
    if (readback == Readback::asynchronous || !is_processor()) asynchronous_.emplace(passes_, synchronous_);
}

void Pipeline::set_scene(const CompiledScene& scene, const RecordConverter& records) {
    abandon();
    passes_.set_scene(scene, records);
    if (native_level_) native_.emplace(*native_level_, scene, passes_.device);
}

void Pipeline::prepare(bool every_partition) {
    every_partition ? static_cast<void>(passes_.partitions()) : static_cast<void>(passes_.first_hits());
    if (asynchronous_) asynchronous_->prepare();
}

DeviceMemory Pipeline::memory() const {
    const Device& device = passes_.device;
    return {.available = device.available(),
            .held = synchronous_.held() + passes_.held() + (asynchronous_ ? asynchronous_->held() : 0),
            .max_buffer = device.max_buffer()};
}

/// The most rays of a frame's batch. A frame with edges is one batch if the memory suffices.
std::uint64_t Pipeline::most_rays(const PreparedFrame& prepared, std::size_t channels) const {
    const FrameShape shape = shape_of(prepared.frame, channels);
    if (prepared.edges) return plan_memory(shape, memory(), 1, prepared.rays).batch_rays;
    const std::uint32_t underway = asynchronous_ ? 2 : 1;
    const std::uint64_t limit =
        asynchronous_ ? most_rays_ : std::min(most_rays_, most_rays_on_processor(shape.every_partition));
    return plan_memory(shape, memory(), underway, limit).batch_rays;
}

// The kernel that draws edges reads the frame's numbers in double.
bool Pipeline::draws_edges(const PreparedFrame& prepared) const {
    return asynchronous_ && !prepared.frame.every_partition && passes_.records().wide_bytes() == sizeof(double) &&
           prepared.rays > 0 && most_rays(prepared, MOST_CHANNELS) >= prepared.rays;
}

void Pipeline::render(const PreparedFrame& prepared, const TakeRays& take, const RenderTarget& target,
                      const ReportDone& report_done, PipelineCounts& counts) {
    const kernel::Frame& frame = prepared.frame;
    passes_.tables->set_lights(passes_.records().lights(prepared.lights));
    passes_.tables->set_ends(prepared.ends);
    prepare(frame.every_partition);
    const FrameShape shape = shape_of(frame, target.channels.size());
    const auto most = [&] { return most_rays(prepared, target.channels.size()); };
    BatchSource source(take, most, std::uint64_t{shape.tiles_across} * tile_rays);
    const FrameJob job{frame, source, target, report_done, counts, prepared.edges};
    asynchronous_ ? asynchronous_->render(job) : synchronous_.render(job);
}

void Pipeline::finish() {
    if (asynchronous_) asynchronous_->finish();
}

void Pipeline::abandon() noexcept {
    passes_.cancel_tallies();
    if (asynchronous_) asynchronous_->abandon();
}

void Pipeline::trace_list(const kernel::Frame& frame, const RayList& rays, const TakeRays& take, RowReceiver& receiver,
                          const ReportDone& report_done, PipelineCounts& counts) {
    if (native_) {
        for (RayNumbers range = take(); range.first < range.end; range = take())
            native_->trace(frame, rays, range, receiver, report_done, counts);
        return;
    }
    passes_.cancel_tallies();  // of a call that threw
    const auto most = [&] {
        return std::min(rays_fitting(memory(), synchronous_.listed_ray_bytes()),
                        is_processor() ? most_rays_on_processor(true) : most_rays_listed);
    };
    BatchSource source(take, most, 0);
    synchronous_.trace_list(frame, rays, source, receiver, report_done, counts);
}

}  // namespace csgrt
