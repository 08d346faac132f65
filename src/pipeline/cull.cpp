#include "pipeline/cull.hpp"

#include <array>
#include <numeric>

namespace csgrt {

Cull::Cull(Device& device, const Program& program)
    : device_(device),
      cull_blocks_(program.kernel("cull_blocks")),
      costs_(device, "blocks"),
      lists_(device, "blocks' nodes") {}

// Measured (bench/NOTES.md): a GPU finds a ray's candidates as soon without.
bool Cull::is_listed(const kernel::Frame& frame) const {
    return !frame.every_partition || device_.info().type == "cpu";
}

SeenBlocks Cull::run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                     PipelineCounts& counts) {
    const std::uint32_t count = frame.ray_count / block_rays, first = frame.first_ray / block_rays;
    costs_.reserve(count);
    if (is_listed(frame))
        lists_.reserve(std::size_t{count} * LISTED_NODES * sizeof(kernel::BlockNode));
    else
        lists_ = Buffer(device_, lists_.name());
    const Event cull = cull_blocks_.launch(count, uneven_group(device_), tile.frame, scene.nodes, costs_, lists_);
    const auto costs = costs_.read<unsigned char>(count);
    counts.cull_blocks += milliseconds(cull);

    // A device that ends with the longest waits for it.
    std::array<std::uint32_t, 256> begin{};  // how many blocks cost more
    for (const unsigned char cost : costs)
        if (cost > 0) ++begin[255 - cost];
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0u);
    SeenBlocks seen;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (costs[i] == 0) continue;
        seen.numbers.push_back(first + i);
        seen.places.push_back(begin[255 - costs[i]]++);
    }
    return seen;
}

}  // namespace csgrt
