// Memory plan: computes how many rays a batch may have, and how much device memory it needs. It uses numbers alone, no
// device and no buffers.
#pragma once

#include <cstdint>

#include "pipeline/batch.hpp"

namespace csgrt {

/// The properties of a frame that decide about memory.
struct FrameShape {
    std::uint32_t tiles_across = 0, tiles_down = 0;  ///< of the screen bounds
    std::uint64_t pixel_bytes = 0;                   ///< of all channels of a pixel
    bool every_partition = false;
};
FrameShape shape_of(const kernel::Frame& frame, std::size_t channels);

/// The memory that a device has for a batch.
struct DeviceMemory {
    std::uint64_t available = 0;   ///< bytes that are free
    std::uint64_t held = 0;        ///< bytes that the pipeline uses and may give back
    std::uint64_t max_buffer = 0;  ///< bytes of one buffer at most
};

/// The sizes of batches that fit the memory.
struct MemoryPlan {
    std::uint64_t ray_bytes = 0;   ///< of each ray even if it hits nothing, for all batches that are underway at a time
    std::uint64_t batch_rays = 1;  ///< at most; less than a tile if the memory is that small
};

/// Plans the memory. `underway`: batches that have memory at a time. `most_rays`: the most rays of a batch. A quarter
/// of the memory is for buffers whose sizes are known beforehand; the rest is for segments and partitions.
MemoryPlan plan_memory(const FrameShape& frame, const DeviceMemory& memory, std::uint32_t underway,
                       std::uint64_t most_rays);

/// The number of rays, of `ray_bytes` each, that fit this quarter of the memory.
std::uint64_t rays_fitting(const DeviceMemory& memory, std::uint64_t ray_bytes);

/// The bytes of a batch of whole tiles without its picture and its partitions: its frame (`frame_bytes`), costs, lists
/// and report.
std::uint64_t batch_bytes(const FrameShape& frame, const RayBatch& batch, std::uint64_t frame_bytes);

}  // namespace csgrt
