// Kernel 0: which tiles of a batch can see anything, and which nodes of the hierarchy their rays meet.
#pragma once

#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/program_options.hpp"
#include "pipeline/passes/scene_tables.hpp"

namespace csgrt {

class CullPass {
public:
    /// `program` holds the kernel of `file`.
    CullPass(Device& device, const Program& program);
    static constexpr const char* file = "0_cull_tiles.cl";

    /// Writes the costs of the frame's tiles and lists their nodes: by distance for first hits, else in the hierarchy's
    /// order (on a GPU, for every partition, not at all: `tile_nodes` is empty). Clears the report of a batch whose
    /// pixels are row-major. Does not wait.
    Event launch(const SceneTables& scene, BatchBuffers& batch, const kernel::Frame& frame);
    /// The numbers of the batch's tiles that may see a solid, ascending. Waits.
    static std::vector<std::uint32_t> seen(const RayBatch& batch, const BatchBuffers& buffers);

    /// Bytes of a batch's costs and lists.
    static std::uint64_t bytes(std::uint64_t rays) {
        return rays / tile_rays * (1 + LISTED_NODES * sizeof(kernel::TileNode));
    }

private:
    Device& device_;
    Kernel cull_tiles_;
};

}  // namespace csgrt
