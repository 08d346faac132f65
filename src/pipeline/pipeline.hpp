// CompiledScene + Frame -> pixels or partitions, through the five kernels in order:
//
//   count hits -> (scan) -> store segments -> weave -> evaluate -> shade
//
// Memory is counted, then allocated, never guessed. Rays go through in tiles (ranges of their numbers); a tile whose
// segments do not fit the budget is halved, down to one ray. Nothing a ray computes depends on its tile.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "compile/claims.hpp"
#include "compile/frame.hpp"
#include "device/program.hpp"

namespace csgrt {

/// The compiled scene on the device.
struct SceneBuffers {
    SceneBuffers(Device& device, const CompiledScene& scene);
    Buffer solids, reals, planes, plane_refs, words, inner_nodes, region_lists, regions, trees, materials, nodes;
};

/// Figures of one frame, summed over its tiles. Times in milliseconds, the device's own.
struct PipelineCounts {
    std::uint64_t hits = 0, segments = 0, partitions_used = 0, partitions_allocated = 0, overlaps = 0;
    std::uint64_t segment_bytes = 0, partition_bytes = 0;  ///< of all tiles together
    std::uint32_t tiles = 0;
    double count_hits = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0, shade = 0;
};

class Pipeline {
public:
    /// Compiles the kernels for what the scene holds, and uploads it. Both must outlive the pipeline.
    Pipeline(Device& device, const CompiledScene& scene, const Settings& settings = {});

    using Progress = std::function<bool(double)>;
    /// Pixels by row from the top left. Throws Error (out_of_memory, device_fault; interrupted if `progress` says so).
    std::vector<kernel::Pixel> render(const PreparedFrame& prepared, const Progress& progress, PipelineCounts& counts);
    std::vector<RayPartitions> shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays, const Progress& progress,
                                     PipelineCounts& counts);

private:
    struct Tile;
    void for_each_tile(const PreparedFrame& prepared, bool pictured, const Progress& progress, PipelineCounts& counts,
                       const std::function<void(const Tile&)>& finish);
    bool run_tile(const PreparedFrame& prepared, Tile& tile, bool pictured, PipelineCounts& counts);
    void release_counted();
    double scan(std::uint32_t size);
    std::vector<ClaimedPartition> claims_of(const std::vector<kernel::End>& ends, const std::vector<kernel::PartitionNode>& nodes,
                                            const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                            const kernel::RayCount& end, std::uint32_t first_node) const;
    std::vector<std::uint32_t> claimants(const kernel::End* ends, std::uint32_t segments, const std::uint32_t* bits) const;

    Device& device_;
    const CompiledScene& scene_;
    SceneBuffers buffers_;
    Program program_;
    Kernel count_hits_, scan_blocks_, scan_add_, store_segments_, weave_, evaluate_, shade_;
    Buffer frame_, lights_, rays_;
    Buffer counts_, results_, pixels_;             // one entry a ray
    Buffer ends_, partitions_, bits_, candidates_;  // by what was counted
    std::vector<std::unique_ptr<Buffer>> sums_;    // of the scan, a level each
    std::vector<kernel::RayRecord> list_;          // the rays that are being shot, on the host
};

}  // namespace csgrt
