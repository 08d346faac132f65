#include "pipeline/cull.hpp"

namespace csgrt {

Cull::Cull(Device& device, const Settings& settings)
    : program_(device, assemble_program({"0_cull_blocks.cl"}), precision_defines(settings), settings.precision != Precision::double_),
      cull_blocks_(program_.kernel("cull_blocks")),
      seen_(device, "blocks") {}

std::vector<std::uint32_t> Cull::run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                                     PipelineCounts& counts) {
    const std::uint32_t count = frame.ray_count / block_rays, first = frame.first_ray / block_rays;
    seen_.reserve(count);
    const Event cull = cull_blocks_.launch(count, work_group, tile.frame, scene.nodes, seen_);
    const auto seen = seen_.read<unsigned char>(count);
    counts.cull_blocks += milliseconds(cull);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < count; ++i)
        if (seen[i]) numbers.push_back(first + i);
    return numbers;
}

}  // namespace csgrt
