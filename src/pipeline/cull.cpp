#include "pipeline/cull.hpp"

namespace csgrt {

Cull::Cull(Device& device, const Program& program) : device_(device), cull_blocks_(program.kernel("cull_blocks")) {}

// Measured (bench/NOTES.md): a GPU finds a ray's candidates as soon without.
bool Cull::is_listed(const kernel::Frame& frame) const {
    return !frame.every_partition || device_.info().type == "cpu";
}

void Cull::reserve(TileBuffers& buffers, const kernel::Frame& frame, std::uint64_t rays) {
    const std::uint64_t blocks = rays / block_rays;
    buffers.costs.reserve(blocks);
    if (is_listed(frame))
        buffers.lists.reserve(blocks * LISTED_NODES * sizeof(kernel::BlockNode));
    else
        buffers.lists.release();
}

Event Cull::launch(const SceneBuffers& scene, TileBuffers& buffers, const kernel::Frame& frame) {
    reserve(buffers, frame, frame.ray_count);
    if (frame.lines) buffers.tally.reserve(Tile{0, frame.ray_count}.tally_bytes());
    return cull_blocks_.launch(frame.ray_count / block_rays, uneven_group(device_), buffers.frame, scene.nodes, buffers.costs,
                               buffers.lists, buffers.tally);
}

std::vector<std::uint32_t> Cull::seen(const Tile& tile, const TileBuffers& buffers) {
    const Buffer::Mapping mapping = buffers.costs.map(tile.blocks());
    const auto* const costs = static_cast<const unsigned char*>(mapping.data());
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < tile.blocks(); ++i)
        if (costs[i] > 0) seen.push_back(tile.first_block() + i);
    return seen;
}

}  // namespace csgrt
