// What the two ways through the pipeline share: the scene on the device, one batch's frame and rays, and the figures.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "compile/frame.hpp"
#include "compile/host_kernels.hpp"
#include "device/program.hpp"

namespace csgrt {

// Work-items in a group, always the same for a kernel, so that each is compiled once.
inline constexpr std::size_t work_group = 64;
/// The same for kernels whose items differ much in what they do. A processor's thread takes whole groups: 64 of the longest
/// would keep it busy after all others have ended, and what a loop over items has to keep for each of them is no small thing.
std::size_t uneven_group(const Device& device);

inline constexpr std::uint32_t tile_rays = TILE * TILE;

/// The compiled scene on the device, and the frame's lights.
struct SceneBuffers {
    SceneBuffers(Device& device, const CompiledScene& scene, const HostKernels::Tables& tables);
    Buffer solids, reals, planes, plane_refs, words, inner_nodes, starts, leaves, regions, trees, materials, nodes, lights;
};

/// Rays [first, first + rays) of a picture, of a list or of those picked.
struct RayBatch {
    std::uint32_t first = 0, rays = 0;
    bool operator==(const RayBatch&) const = default;

    std::uint32_t first_tile() const { return first / tile_rays; }
    std::uint32_t end_tile() const { return (first + rays) / tile_rays; }
    std::uint32_t tiles() const { return rays / tile_rays; }
    /// A kernel::BatchReport and a byte a tile.
    std::uint64_t tally_bytes() const { return sizeof(kernel::BatchReport) + (tiles() + 3) / 4 * 4; }
};

/// One batch on the device: its frame; what its tiles see (cull.hpp); its rays, or their numbers, or those of their tiles; what the
/// host wants to know of them (kernel::BatchReport); and, of first hits, the numbers of the rays that had no room.
struct BatchBuffers {
    explicit BatchBuffers(Device& device)
        : frame(device, "frame"), costs(device, "tiles"), lists(device, "tiles' nodes"), rays(device, "rays"),
          tally(device, "tally"), overflown(device, "rays without room") {}
    Buffer frame, costs, lists, rays, tally, overflown;

    std::uint64_t held() const { return costs.size() + lists.size() + rays.size() + tally.size() + overflown.size(); }
    /// For a batch's tiles, its tally, and bytes for each ray that may have no room.
    void reserve(const RayBatch& batch, std::uint64_t bytes_a_ray) {
        rays.reserve(batch.tiles() * sizeof(std::uint32_t));
        tally.reserve(batch.tally_bytes());
        overflown.reserve(batch.rays * bytes_a_ray);
    }
    /// Gives that back; or but for what its tiles see.
    void release() {
        costs.release();
        lists.release();
        release_rays();
    }
    void release_rays() {
        for (Buffer* buffer : {&rays, &tally, &overflown}) buffer->release();
    }
};

/// Figures of one frame, summed over its batches. Times in milliseconds, the device's own; `build`: the host's.
struct PipelineCounts {
    std::uint64_t hits = 0, segments = 0, partitions_used = 0, partitions_allocated = 0, overlaps = 0;
    std::uint64_t segment_bytes = 0, partition_bytes = 0;  ///< of all batches together
    std::uint32_t batches = 0, drawn_again = 0;  ///< and, of them, those for which memory did not do at first
    double count_hits = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0, shade = 0;
    double cull_tiles = 0, first_hits = 0;

    PipelineCounts& operator+=(const PipelineCounts& other);
};

/// Kernels that run or have run, each with what its time counts as.
using TimedKernels = std::vector<std::pair<double PipelineCounts::*, Event>>;
/// Adds up how long kernels took. Waits.
void add_times(const TimedKernels& timed, PipelineCounts& counts);

/// Do a picture's rays go side by side in a processor's vectors, `packet_rays` a work-item?
bool in_packets(const Device& device, const Settings& settings);
inline constexpr std::uint32_t packet_rays = 8;  // PACKET of kernels/packet/packet.h

/// The options that a program for this scene is compiled with.
std::vector<std::string> defines_of(const Device& device, const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
