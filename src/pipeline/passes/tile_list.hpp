// Tile list: on a GPU, for batches whose pixels are row-major, kernels list the tiles that see anything, write the
// background of the others (kernels/tile_list.cl), and draw edges (kernels/edges.cl).
#pragma once

#include <array>
#include <optional>

#include "pipeline/passes/batch_buffers.hpp"

namespace csgrt {

/// The pass launches these kernels. The list is made on the device, so the host can queue the drawing kernels without
/// waiting for the list.
class TileListPass {
public:
    explicit TileListPass(Device& device) : device_(device) {}

    /// Compiles the kernels.
    void build();
    bool is_built() const { return list_.has_value(); }

    /// Lists the batch's tiles whose cost is not 0 in `buffers.tiles`, the most expensive first, and counts them in the
    /// report, which must be clear. The most expensive tiles are listed in parts (PART_SHIFT) if there are no more than
    /// `most_in_parts` of them and enough other tiles see nothing. Only first_hits can draw parts: for other kernels
    /// `most_in_parts` is 0. Does not wait. Returns the events of the two kernels.
    std::array<Event, 2> list(const RayBatch& batch, BatchBuffers& buffers, std::uint32_t most_in_parts);
    /// Writes the background of the tiles whose cost is 0 into a row-major picture. Does not wait.
    Event write_background(const kernel::Frame& frame, const RayBatch& batch, const Buffer& costs,
                           const kernel::ChannelValues& background, std::uint32_t channels, const Buffer& picture);
    /// Draws the edges of a batch that is a whole picture, with its distances, normals and ids, after the first hits.
    /// Draws nothing if rays overflowed. Does not wait.
    Event draw_edges(const RayBatch& batch, const BatchBuffers& buffers, const Buffer& picture);

    /// The number of expensive tiles that keep the device busy even as whole tiles.
    static std::uint32_t most_in_parts(const Device& device) { return 4 * device.info().compute_units; }

private:
    Device& device_;
    std::optional<Program> program_;
    std::optional<Kernel> count_, list_, write_background_, draw_edges_;
};

}  // namespace csgrt
