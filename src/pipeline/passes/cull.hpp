// Which tiles of a batch can see anything, and what: kernel 0.
#pragma once

#include "pipeline/passes/stages.hpp"

namespace csgrt {

class Cull {
public:
    /// `program` holds the kernel of `file`.
    Cull(Device& device, const Program& program);
    static constexpr const char* file = "0_cull_tiles.cl";

    /// Looks what the frame's batch's tiles may see, and clears the tally of one that comes by lines; does not wait. Lists every
    /// tile's nodes, too: by distance if only first hits are wanted, else as they stand in the hierarchy (on a GPU, then, not at all).
    Event launch(const SceneBuffers& scene, BatchBuffers& buffers, const kernel::Frame& frame);
    /// Makes room for as many rays of such a frame.
    void reserve(BatchBuffers& buffers, const kernel::Frame& frame, std::uint64_t rays);
    /// The numbers of those of the frame's batch's tiles that may see a solid, ascending. Waits.
    static std::vector<std::uint32_t> seen(const RayBatch& batch, const BatchBuffers& buffers);

    static constexpr std::uint64_t list_bytes = LISTED_NODES * sizeof(kernel::TileNode) / tile_rays;  ///< a ray

private:
    bool is_listed(const kernel::Frame& frame) const;

    Device& device_;
    Kernel cull_tiles_;
};

}  // namespace csgrt
