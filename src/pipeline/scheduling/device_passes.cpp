#include "pipeline/scheduling/device_passes.hpp"

#include "base/clock.hpp"

namespace csgrt {

DevicePasses::DevicePasses(Device& on, const CompiledScene& compiled, const HostKernels& host_kernels,
                           const Settings& settings)
    : device(on),
      scene(compiled),
      kernels(host_kernels),
      tables(on, compiled, host_kernels.tables()),
      settings_(settings),
      tile_list_(on) {}

template <class Build>
void DevicePasses::timed_build(const Build& build) {
    const auto start = Clock::now();
    build();
    build_ms_ += milliseconds_since(start);
}

FirstHitPass& DevicePasses::first_hits() {
    if (!first_hits_) timed_build([&] { first_hits_.emplace(device, scene, settings_); });
    return *first_hits_;
}

PartitionPass& DevicePasses::partitions() {
    if (!partitions_) timed_build([&] { partitions_.emplace(device, scene, kernels, settings_); });
    return *partitions_;
}

TileListPass& DevicePasses::tile_list() {
    if (!tile_list_.is_built()) timed_build([&] { tile_list_.build(); });
    return tile_list_;
}

}  // namespace csgrt
