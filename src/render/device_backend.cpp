#include "render/device_backend.hpp"

#include <algorithm>
#include <utility>

#include "base/clock.hpp"
#include "base/laboratory.hpp"
#include "device/driver_call.hpp"

namespace csgrt {

DeviceBackend::DeviceBackend(DevicePlan plan, std::shared_ptr<const ModelInUse> model, const Settings& settings,
                             double search_ms)
    : model_(std::move(model)),
      search_ms_(search_ms),
      spot_check_(settings),
      retried_(laboratory(settings).retried),
      takeover_(
          std::move(plan),
          [this, settings](const std::vector<FoundDevice>& devices) {
              const std::shared_ptr<const ModelInUse> in_use = this->model();
              auto group = std::make_unique<DeviceGroup>(devices, in_use->scene, *in_use->records, settings);
              group->keep(in_use);
              return group;
          },
          [this](DeviceGroup& group) { adapt(group); }, settings.wait_for_device) {}

/// Gives the group the model, if it has another model.
void DeviceBackend::adapt(DeviceGroup& group) const {
    const std::shared_ptr<const ModelInUse> in_use = model();
    if (group.owner() != in_use) group.set_scene(in_use->scene, *in_use->records, in_use);
}

void DeviceBackend::set_model(std::shared_ptr<const ModelInUse> model) {
    if (model == model_) return;
    spot_check_.forget_scene();
    const std::lock_guard lock(mutex_);
    model_ = std::move(model);
}

void DeviceBackend::prepare(bool every_partition) {
    const auto start = Clock::now();
    drawer_ = &takeover_.drawer(every_partition, model_->scene);
    if (drawer_->owner() != model_) {
        const DriverCall call(drawer_->uses_driver());
        adapt(*drawer_);
        drawer_->prepare(every_partition);
    }
    build_ms_in_call_ = milliseconds_since(start);
}

template <class Call>
void DeviceBackend::counted(const Call& call) {
    const DriverCall driver_call(drawer_->uses_driver());
    const double built_ms = drawer_->build_ms();
    counts_ = {};
    call();
    build_ms_in_call_ += drawer_->build_ms() - built_ms;
    if (retried_) *retried_ += counts_.retried;
}

void DeviceBackend::render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) {
    const std::size_t pixels = std::size_t{frame.frame.width} * frame.frame.height;
    if (std::exchange(memory.drawn_by, drawer_->number()) != drawer_->number())
        memory.registered = nullptr;
    else if (!memory.registered)
        memory.registered = drawer_->register_memory(memory.channels, pixels);
    const RenderTarget target{
        .channels = memory.channels, .covered = memory.covered, .registered = memory.registered.get()};
    try {
        counted([&] { drawer_->render(frame, target, &watch, counts_); });
        spot_check_.compare(model_->scene, frame, memory, counts_.done, drawer_->name(), watch);
    } catch (...) {  // pixels may be missing in covered tiles
        std::ranges::fill(memory.covered, std::uint8_t{1});
        throw;
    }
}

void DeviceBackend::trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch& watch) {
    counted([&] { drawer_->trace_list(frame, rays, receiver, &watch, counts_); });
}

void DeviceBackend::check(const kernel::Frame& frame, const RayList& rays, const RowReceiver& receiver, Watch& watch) {
    spot_check_.compare(model_->scene, frame, rays, receiver, counts_.done, drawer_->name(), watch);
}

std::string DeviceBackend::method(bool every_partition) const {
    return every_partition ? "every partition, five kernels" : "first hits, front to back";
}

void DeviceBackend::report(Statistics& statistics) const {
    const PipelineCounts& c = counts_;
    statistics.ms.build = search_ms_ + group().build_ms();
    if (!drawer_) return;
    statistics.device_bytes = group().device_bytes();
    statistics.ends = c.ends;
    statistics.segments = c.segments;
    statistics.partitions_used = c.partitions_used;
    statistics.partitions_allocated = c.partitions_allocated;
    statistics.overlaps = c.overlaps;
    statistics.segment_bytes = c.segment_bytes;
    statistics.partition_bytes = c.partition_bytes;
    statistics.batches = c.batches;
    statistics.ms.count_segments = c.count_segments;
    statistics.ms.scan = c.scan;
    statistics.ms.store_segments = c.store_segments;
    statistics.ms.weave = c.weave;
    statistics.ms.evaluate = c.evaluate;
    statistics.ms.shade = c.shade;
    statistics.ms.rows = c.rows;
    statistics.ms.cull_tiles = c.cull_tiles;
    statistics.ms.first_hits = c.first_hits;
    statistics.ms.kernels = c.kernels;
}

}  // namespace csgrt
