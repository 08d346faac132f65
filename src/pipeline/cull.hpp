// Which blocks of a tile can see anything, and what: kernel 0.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

class Cull {
public:
    /// `program` holds the kernel.
    Cull(Device& device, const Program& program);

    /// The numbers of a picture's blocks, out of those of the frame's tile, that may see a solid; ascending. Waits.
    /// If only first hits are wanted, lists every block's nodes, too.
    std::vector<std::uint32_t> run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                                   PipelineCounts& counts);

    const Buffer& lists() const { return lists_; }
    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::BlockNode) / block_rays;  ///< a ray
    std::uint64_t held() const { return seen_.size() + lists_.size(); }
    void release();  ///< gives all its memory back

private:
    Device& device_;
    Kernel cull_blocks_;
    Buffer seen_;  // a byte a block
    Buffer lists_;
};

}  // namespace csgrt
