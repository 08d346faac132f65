// On a GPU, for batches whose pixels are row-major: the list of tiles that see anything, made without the host, and the
// background of all others (kernels/tile_list.cl).
#pragma once

#include <array>
#include <optional>

#include "pipeline/passes/batch_buffers.hpp"

namespace csgrt {

class TileListPass {
public:
    explicit TileListPass(Device& device) : device_(device) {}

    /// Compiles its kernels.
    void build();
    bool is_built() const { return list_.has_value(); }

    /// Lists the batch's tiles whose cost is not 0 in `buffers.tiles`, the dearest first, and counts them in the
    /// report, which is clear. The dearest come in parts (PART_SHIFT) if they are no more than `most_in_parts` and
    /// others see nothing; kernels but first_hits know of no parts: for them it is 0. Does not wait. Returns its two
    /// kernels.
    std::array<Event, 2> list(const RayBatch& batch, BatchBuffers& buffers, std::uint32_t most_in_parts);
    /// Writes the background of the tiles whose cost is 0 into a row-major picture. Does not wait.
    Event write_background(const kernel::Frame& frame, const RayBatch& batch, const Buffer& costs,
                           const kernel::ChannelValues& background, std::uint32_t channels, const Buffer& picture);

    /// More dear tiles than this keep the device busy as they are.
    static std::uint32_t most_in_parts(const Device& device) { return 4 * device.info().compute_units; }

private:
    Device& device_;
    std::optional<Program> program_;
    std::optional<Kernel> count_, list_, write_background_;
};

}  // namespace csgrt
