#include "pipeline/passes/cull.hpp"

namespace csgrt {

CullPass::CullPass(Device& device, const Program& program)
    : device_(device), cull_tiles_(program.kernel("cull_tiles")) {}

Event CullPass::launch(const SceneTables& scene, BatchBuffers& batch, const kernel::Frame& frame) {
    const std::uint32_t tiles = frame.ray_count / tile_rays;
    batch.costs.reserve(tiles);
    // For every partition a GPU finds the candidates as fast without lists, and the lists take most of culling's time.
    if (frame.every_partition && device_.info().type != "cpu")
        batch.tile_nodes.release();
    else
        batch.tile_nodes.reserve(tiles * LISTED_NODES * sizeof(kernel::TileNode));
    if (frame.rows) batch.report.reserve(BatchBuffers::report_bytes({0, frame.ray_count}));
    return cull_tiles_.launch(tiles, divergent_group(device_), batch.frame, scene.nodes(), scene.starting(),
                              scene.ends(), batch.costs, batch.tile_nodes, batch.report);
}

std::vector<std::uint32_t> CullPass::seen(const RayBatch& batch, const BatchBuffers& buffers) {
    const Buffer::Mapping mapping = buffers.costs.map(batch.tiles());
    const auto* const costs = static_cast<const unsigned char*>(mapping.data());
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < batch.tiles(); ++i)
        if (costs[i] > 0) seen.push_back(batch.first_tile() + i);
    return seen;
}

}  // namespace csgrt
