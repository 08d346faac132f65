#include "pipeline/scheduling/device_passes.hpp"

#include "base/clock.hpp"

namespace csgrt {

DevicePasses::DevicePasses(Device& on, const CompiledScene& compiled, const RecordConverter& records,
                           const Settings& settings)
    : device(on), scene_(&compiled), records_(&records), needs_(compiled), settings_(settings), tile_list_(on) {
    tables.emplace(on, compiled, records.tables());
}

void DevicePasses::set_scene(const CompiledScene& compiled, const RecordConverter& records) {
    if (tables && !tables->takes(compiled)) tables.reset();  // the memory may not suffice for the two scenes
    scene_ = &compiled;
    records_ = &records;
    const ProgramNeeds needs(compiled);
    if (!draws(device, needs_, needs)) {
        first_hits_.reset();
        partitions_.reset();
        needs_ = needs;
    } else if (partitions_) {
        partitions_->set_scene(compiled, records);
    }
    if (tables)
        tables->take(compiled, records.tables());
    else
        tables.emplace(device, compiled, records.tables());
}

template <class Build>
void DevicePasses::timed_build(const Build& build) {
    const auto start = Clock::now();
    build();
    build_ms_ += milliseconds_since(start);
}

FirstHitPass& DevicePasses::first_hits() {
    if (!first_hits_) timed_build([&] { first_hits_.emplace(device, *scene_, settings_); });
    return *first_hits_;
}

PartitionPass& DevicePasses::partitions() {
    if (!partitions_) timed_build([&] { partitions_.emplace(device, *scene_, *records_, settings_); });
    return *partitions_;
}

TileListPass& DevicePasses::tile_list() {
    if (!tile_list_.is_built()) timed_build([&] { tile_list_.build(); });
    return tile_list_;
}

}  // namespace csgrt
