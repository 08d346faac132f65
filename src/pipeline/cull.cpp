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

Cull::Cull(Device& device, const Program& program)
    : device_(device),
      cull_blocks_(program.kernel("cull_blocks")),
      costs_(device, "blocks"),
      lists_(device, "blocks' nodes"),
      read_(device, "blocks") {}

// Measured (bench/NOTES.md): a GPU finds a ray's candidates as soon without.
bool Cull::is_listed(const kernel::Frame& frame) const {
    return !frame.every_partition || device_.info().type == "cpu";
}

void Cull::launch(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame) {
    count_ = frame.ray_count / block_rays;
    first_ = frame.first_ray / block_rays;
    costs_.reserve(count_);
    if (is_listed(frame))
        lists_.reserve(std::size_t{count_} * LISTED_NODES * sizeof(kernel::BlockNode));
    else
        lists_ = Buffer(device_, lists_.name());
    event_ = cull_blocks_.launch(count_, uneven_group(device_), tile.frame, scene.nodes, costs_, lists_);
    read_.start(costs_, count_);
}

std::vector<std::uint32_t> Cull::seen(PipelineCounts& counts) {
    const std::span<const unsigned char> costs = read_.wait<unsigned char>(count_);
    counts.cull_blocks += milliseconds(event_);

    // A device that ends with the longest waits for it.
    std::array<std::uint32_t, 256> begin{};  // where those of a cost stand, by 255 - cost
    for_each_seen(costs, [&](std::size_t, unsigned char cost) { ++begin[255 - cost]; });
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0u);
    std::vector<std::uint32_t> seen(begin[255]);
    for_each_seen(costs, [&](std::size_t i, unsigned char cost) {
        seen[begin[255 - cost]++] = first_ + static_cast<std::uint32_t>(i);
    });
    return seen;
}

}  // namespace csgrt
