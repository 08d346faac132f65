#include "pipeline/cull.hpp"

namespace csgrt {

Cull::Cull(Device& device, const Program& program)
    : device_(device),
      cull_blocks_(program.kernel("cull_blocks")),
      seen_(device, "blocks"),
      lists_(device, "blocks' nodes") {}

void Cull::release() {
    for (Buffer* buffer : {&seen_, &lists_}) *buffer = Buffer(device_, buffer->name());
}

std::vector<std::uint32_t> Cull::run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                                     PipelineCounts& counts) {
    const std::uint32_t count = frame.ray_count / block_rays, first = frame.first_ray / block_rays;
    seen_.reserve(count);
    if (frame.every_partition) lists_ = Buffer(device_, lists_.name());
    else lists_.reserve(std::size_t{count} * LISTED_NODES * sizeof(kernel::BlockNode));
    const Event cull = cull_blocks_.launch(count, work_group, tile.frame, scene.nodes, seen_, lists_);
    const auto seen = seen_.read<unsigned char>(count);
    counts.cull_blocks += milliseconds(cull);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < count; ++i)
        if (seen[i]) numbers.push_back(first + i);
    return numbers;
}

}  // namespace csgrt
