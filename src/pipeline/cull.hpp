// Which blocks of a tile can see anything: kernel 0.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

class Cull {
public:
    Cull(Device& device, const Settings& settings);

    /// The numbers of a picture's blocks, out of those of the frame's tile, that may see a solid; ascending. Waits.
    std::vector<std::uint32_t> run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                                   PipelineCounts& counts);

private:
    Program program_;
    Kernel cull_blocks_;
    Buffer seen_;  // a byte a block
};

}  // namespace csgrt
