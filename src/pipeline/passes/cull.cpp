#include "pipeline/passes/cull.hpp"

namespace csgrt {

Cull::Cull(Device& device, const Program& program) : device_(device), cull_tiles_(program.kernel("cull_tiles")) {}

// Measured (bench/NOTES.md): a GPU finds a ray's candidates as soon without.
bool Cull::is_listed(const kernel::Frame& frame) const {
    return !frame.every_partition || device_.info().type == "cpu";
}

void Cull::reserve(BatchBuffers& buffers, const kernel::Frame& frame, std::uint64_t rays) {
    const std::uint64_t tiles = rays / tile_rays;
    buffers.costs.reserve(tiles);
    if (is_listed(frame))
        buffers.lists.reserve(tiles * LISTED_NODES * sizeof(kernel::TileNode));
    else
        buffers.lists.release();
}

Event Cull::launch(const SceneBuffers& scene, BatchBuffers& buffers, const kernel::Frame& frame) {
    reserve(buffers, frame, frame.ray_count);
    if (frame.lines) buffers.tally.reserve(RayBatch{0, frame.ray_count}.tally_bytes());
    return cull_tiles_.launch(frame.ray_count / tile_rays, uneven_group(device_), buffers.frame, scene.nodes, buffers.costs,
                               buffers.lists, buffers.tally);
}

std::vector<std::uint32_t> Cull::seen(const RayBatch& batch, const BatchBuffers& buffers) {
    const Buffer::Mapping mapping = buffers.costs.map(batch.tiles());
    const auto* const costs = static_cast<const unsigned char*>(mapping.data());
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < batch.tiles(); ++i)
        if (costs[i] > 0) seen.push_back(batch.first_tile() + i);
    return seen;
}

}  // namespace csgrt
