#include "pipeline/cull.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <span>

namespace csgrt {
namespace {

/// Calls work(block, cost) for those that cost anything, eight that do not at once.
template <class Work>
void for_each_seen(std::span<const unsigned char> costs, const Work& work) {
    for (std::size_t i = 0; i < costs.size(); i += 8) {
        std::uint64_t eight = 0;
        const std::size_t count = std::min<std::size_t>(8, costs.size() - i);
        std::memcpy(&eight, costs.data() + i, count);
        if (eight == 0) continue;
        for (std::size_t k = 0; k < count; ++k)
            if (costs[i + k] > 0) work(i + k, costs[i + k]);
    }
}

}  // namespace

Cull::Cull(Device& device, const Program& program, bool together)
    : device_(device), cull_blocks_(program.kernel(together ? "cull_blocks_together" : "cull_blocks")), together_(together) {}

// Measured (docs/experiments/gpu-kernels.md): a GPU finds a ray's candidates as soon without.
bool Cull::is_listed(const kernel::Frame& frame) const {
    return !frame.every_partition || device_.info().type == "cpu";
}

// Measured (docs/experiments/gpu-kernels.md): of 8 items of a GPU one takes a block, as long as that makes fewer groups of 32 than it holds at a time.
std::uint32_t Cull::items_a_block(std::uint32_t blocks) const {
    const std::uint64_t most = device_.info().type == "cpu" ? 0 : std::uint64_t{1024} * device_.info().compute_units;
    std::uint32_t items = 1;
    while (items < 8 && 2 * items * std::uint64_t{blocks} <= most) items *= 2;
    return items;
}

void Cull::reserve(TileBuffers& buffers, const kernel::Frame& frame, std::uint64_t rays) {
    const std::uint64_t blocks = rays / block_rays;
    buffers.costs.reserve(blocks);
    if (is_listed(frame))
        buffers.lists.reserve(blocks * LISTED_NODES * sizeof(kernel::BlockNode));
    else
        buffers.lists.release();
}

std::vector<Event> Cull::launch(const SceneBuffers& scene, TileBuffers& buffers, const kernel::Frame& frame) {
    reserve(buffers, frame, frame.ray_count);
    if (frame.lines) buffers.tally.reserve(Tile{0, frame.ray_count}.tally_bytes());
    const std::uint32_t blocks = frame.ray_count / block_rays;
    if (together_)
        return cull_blocks_.launch_in_parts(std::size_t{blocks} * CULL_ITEMS, LOCKSTEP, buffers.frame, scene.nodes, buffers.costs, buffers.lists,
                                   buffers.tally);
    const std::uint32_t items = items_a_block(blocks);
    return cull_blocks_.launch_in_parts(blocks * items, uneven_group(device_), buffers.frame, scene.nodes, buffers.costs, buffers.lists,
                               buffers.tally, cl_uint{items});
}

std::vector<std::uint32_t> Cull::seen(const Tile& tile, const TileBuffers& buffers) {
    const Buffer::Mapping mapping = buffers.costs.map(tile.blocks());
    const std::span costs(static_cast<const unsigned char*>(mapping.data()), tile.blocks());

    // A device that ends with the longest waits for it.
    std::array<std::uint32_t, 256> begin{};  // where those of a cost stand, by 255 - cost
    for_each_seen(costs, [&](std::size_t, unsigned char cost) { ++begin[255 - cost]; });
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0u);
    std::vector<std::uint32_t> seen(begin[255]);
    for_each_seen(costs, [&](std::size_t i, unsigned char cost) {
        seen[begin[255 - cost]++] = tile.first_block() + static_cast<std::uint32_t>(i);
    });
    return seen;
}

}  // namespace csgrt
