// Of a batch whose pixels come by lines: which tiles see anything, listed on the device, and the background of the others
// (kernels/tile_list.cl).
#pragma once

#include <array>
#include <optional>

#include "pipeline/cull.hpp"

namespace csgrt {

class TileList {
public:
    explicit TileList(Device& device) : device_(device) {}

    /// Compiles its kernels.
    void build();
    bool is_built() const { return list_.has_value(); }

    /// Lists the batch's tiles that see anything, whose costs are known, in buffers.rays, those that cost most first, and counts them
    /// in buffers.tally, which is 0. The dearest come in parts (PART_SHIFT) if they are no more than `most_in_parts` and others see
    /// nothing; only first hits know of parts, so that is 0 for every partition. Does not wait. Returns what the two kernels tell.
    std::array<Event, 2> list(const RayBatch& batch, BatchBuffers& buffers, std::uint32_t most_in_parts);
    /// The pixels of those that see nothing, in a picture of whole lines. Does not wait.
    Event put_background(const kernel::Frame& frame, const RayBatch& batch, const Buffer& costs, const kernel::ChannelValues& background,
                         std::uint32_t planes, const Buffer& picture);

    /// Of first hits: more of the dearest tiles keep the device busy as they are.
    static std::uint32_t most_in_parts(const Device& device) { return 4 * device.info().compute_units; }

private:
    Device& device_;
    std::optional<Program> program_;
    std::optional<Kernel> count_, list_, put_background_;
};

}  // namespace csgrt
