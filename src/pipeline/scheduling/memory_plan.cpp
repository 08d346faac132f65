#include "pipeline/scheduling/memory_plan.hpp"

#include <algorithm>

#include "pipeline/passes/first_hits.hpp"
#include "pipeline/passes/partition_memory.hpp"

namespace csgrt {

FrameShape shape_of(const kernel::Frame& frame, std::size_t channels) {
    return {.tiles_across = kernel::tiles_across(frame.screen),
            .tiles_down = kernel::tiles_down(frame.screen),
            .pixel_bytes = channels * sizeof(float),
            .every_partition = frame.every_partition != 0};
}

std::uint64_t rays_fitting(const DeviceMemory& memory, std::uint64_t ray_bytes) {
    constexpr std::uint64_t most = 1u << 24;  // a larger launch could take so long that a watchdog ends it
    const std::uint64_t bytes = std::min((memory.available + memory.held) / 4, memory.max_buffer);
    return std::clamp<std::uint64_t>(bytes / ray_bytes, 1, most);
}

MemoryPlan plan_memory(const FrameShape& frame, const DeviceMemory& memory, std::uint32_t underway,
                       std::uint64_t most_rays) {
    const std::uint64_t own = frame.every_partition ? PartitionMemory::ray_bytes : FirstHitPass::ray_bytes;
    MemoryPlan plan;
    plan.ray_bytes =
        underway * (frame.pixel_bytes + sizeof(std::uint32_t) + own) + CullPass::bytes(tile_rays) / tile_rays;
    const std::uint64_t all = std::uint64_t{frame.tiles_across} * frame.tiles_down * tile_rays;
    plan.batch_rays = std::max<std::uint64_t>(1, std::min({rays_fitting(memory, plan.ray_bytes), all, most_rays}));
    return plan;
}

std::uint64_t batch_bytes(const FrameShape& frame, const RayBatch& batch, std::uint64_t frame_bytes) {
    const std::uint64_t overflown = frame.every_partition ? 0 : batch.rays * FirstHitPass::ray_bytes;
    return frame_bytes + CullPass::bytes(batch.rays) + batch.tiles() * sizeof(std::uint32_t) +
           BatchBuffers::report_bytes(batch) + overflown;
}

}  // namespace csgrt
