// Which blocks of a tile can see anything, and what: kernel 0.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

/// Blocks of a picture's that may see a solid.
struct SeenBlocks {
    std::vector<std::uint32_t> numbers;  ///< ascending
    std::vector<std::uint32_t> places;   ///< where each stands if those that cost most come first
};

class Cull {
public:
    /// `program` holds the kernel.
    Cull(Device& device, const Program& program);

    /// Which of the frame's tile's blocks may see a solid. Lists every block's nodes, too: by distance if only first
    /// hits are wanted, else as they stand in the hierarchy (on a GPU, then, not at all). Waits.
    SeenBlocks run(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame,
                   PipelineCounts& counts);

    const Buffer& lists() const { return lists_; }  ///< empty: there are none
    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::BlockNode) / block_rays;  ///< a ray
    std::uint64_t held() const { return costs_.size() + lists_.size(); }

private:
    bool is_listed(const kernel::Frame& frame) const;

    Device& device_;
    Kernel cull_blocks_;
    Buffer costs_;  // a byte a block
    Buffer lists_;
};

}  // namespace csgrt
