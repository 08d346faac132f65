// Which blocks of a tile can see anything, and what: kernel 0.
#pragma once

#include "device/queued.hpp"
#include "pipeline/stages.hpp"

namespace csgrt {

class Cull {
public:
    /// `program` holds the kernel.
    Cull(Device& device, const Program& program);

    /// Asks what the frame's tile's blocks may see; does not wait. Lists every block's nodes, too: by distance if only first
    /// hits are wanted, else as they stand in the hierarchy (on a GPU, then, not at all).
    void launch(const SceneBuffers& scene, const TileBuffers& tile, const kernel::Frame& frame);
    /// Has the answer copied; see QueuedRead.
    void fetch() { read_.fetch(); }
    /// The numbers of those of the tile's blocks that may see a solid, those that cost most first. Waits.
    std::vector<std::uint32_t> seen(PipelineCounts& counts);

    const Buffer& lists() const { return lists_; }  ///< empty: there are none
    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::BlockNode) / block_rays;  ///< a ray
    std::uint64_t held() const { return costs_.size() + lists_.size(); }

private:
    bool is_listed(const kernel::Frame& frame) const;

    Device& device_;
    Kernel cull_blocks_;
    Buffer costs_;  // a byte a block
    Buffer lists_;
    QueuedRead read_;  // costs_
    Event event_;
    std::uint32_t first_ = 0, count_ = 0;  // blocks
};

}  // namespace csgrt
