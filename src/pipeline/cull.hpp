// Which blocks of a tile can see anything, and what: kernel 0.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

class Cull {
public:
    /// `program` holds the kernel.
    Cull(Device& device, const Program& program);

    /// Looks what the frame's tile's blocks may see; does not wait. Lists every block's nodes, too: by
    /// distance if only first hits are wanted, else as they stand in the hierarchy (on a GPU, then, not at all).
    Event launch(const SceneBuffers& scene, const Buffer& frame_buffer, const kernel::Frame& frame);
    /// The numbers of those of the frame's tile's blocks that may see a solid, those that cost most first. Waits.
    std::vector<std::uint32_t> seen(const Tile& tile) const;

    const Buffer& costs() const { return costs_; }  ///< a byte a block
    const Buffer& lists() const { return lists_; }  ///< empty: there are none
    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::BlockNode) / block_rays;  ///< a ray
    std::uint64_t held() const { return costs_.size() + lists_.size(); }
    void release() {
        costs_.release();
        lists_.release();
    }

private:
    bool is_listed(const kernel::Frame& frame) const;

    Device& device_;
    Kernel cull_blocks_;
    Buffer costs_, lists_;
};

}  // namespace csgrt
