// Which blocks of a tile can see anything, and what: kernel 0.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

class Cull {
public:
    /// `program` holds the kernel of file(together). `together`: several work-items take a block, of first hits whose pixels come by
    /// lines.
    Cull(Device& device, const Program& program, bool together);
    static const char* file(bool together) { return together ? "0_cull_together.cl" : "0_cull_blocks.cl"; }

    /// Looks what the frame's tile's blocks may see, and clears the tally of one that comes by lines; does not wait. Lists every
    /// block's nodes, too: by distance if only first hits are wanted, else as they stand in the hierarchy (on a GPU, then, not at all).
    std::vector<Event> launch(const SceneBuffers& scene, TileBuffers& buffers, const kernel::Frame& frame);
    /// Makes room for as many rays of such a frame.
    void reserve(TileBuffers& buffers, const kernel::Frame& frame, std::uint64_t rays);
    /// The numbers of those of the frame's tile's blocks that may see a solid, those that cost most first. Waits.
    static std::vector<std::uint32_t> seen(const Tile& tile, const TileBuffers& buffers);

    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::BlockNode) / block_rays;  ///< a ray

private:
    bool is_listed(const kernel::Frame& frame) const;
    std::uint32_t items_a_block(std::uint32_t blocks) const;

    Device& device_;
    Kernel cull_blocks_;
    bool together_;
};

}  // namespace csgrt
