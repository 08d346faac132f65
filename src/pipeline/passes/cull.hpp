// Culling pass (kernel 0): finds the tiles of a batch that can see anything, and the nodes of the hierarchy that their
// rays meet.
#pragma once

#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/program_options.hpp"
#include "pipeline/passes/scene_tables.hpp"

namespace csgrt {

/// The pass launches kernel 0. Later kernels leave out tiles that see nothing; rays of the other tiles test only the
/// nodes of their tile's list.
class CullPass {
public:
    /// Takes the kernel of `file` from `program`.
    CullPass(Device& device, const Program& program);
    static constexpr const char* file = "0_cull_tiles.cl";

    /// Writes the costs of the frame's tiles and lists their nodes: by distance for first hits, else in the hierarchy's
    /// order. A GPU lists no nodes for every partition: `tile_nodes` is empty. Clears the report of a batch whose
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
