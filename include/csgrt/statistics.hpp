// Statistics: the counts and times of a Renderer's last call.
#pragma once

#include <cstdint>
#include <string>

namespace csgrt {

/// Counts and times of the last call of a Renderer. If only first hits are drawn, segments and partitions are counted
/// only for rays that need the computation of every partition.
struct Statistics {
    std::string device = {};  ///< The device that computed, or "reference".
    /// The device that is made ready at the time of this call and will replace `device`: its name, "gpu" while none is
    /// found, empty if none is awaited.
    std::string awaited_device = {};
    std::string precision = {};  ///< "double", "single" or "quad".
    std::string method = {};     ///< The numerical method, in a few words.
    double tolerance = 0;        ///< The tolerance in millimetres, which Settings::tolerance_rule gave.
    int width = 0;               ///< Width of the picture, pixels; 0 for rays.
    int height = 0;              ///< Height of the picture, pixels; 0 for rays.
    std::uint64_t rays = 0;
    std::uint64_t ends = 0;                  ///< Number of boundaries of segments along all rays.
    std::uint64_t segments = 0;              ///< Intervals of rays inside single solids.
    std::uint64_t partitions_used = 0;       ///< Intervals between neighbouring boundaries that are inside any solid.
    std::uint64_t partitions_allocated = 0;  ///< Number of partitions for which memory was allocated.
    std::uint64_t overlaps = 0;              ///< Partitions that several regions of the same rank claim.
    std::uint64_t device_bytes = 0;          ///< Memory in use on all devices.
    std::uint64_t segment_bytes = 0;         ///< Memory for segments, all batches.
    std::uint64_t partition_bytes = 0;       ///< Memory for partitions, all batches.
    std::uint32_t batches = 0;               ///< Number of batches of rays.
    /// Milliseconds. Times of kernels are measured by the device, and times of several devices are added up. Batches of
    /// first hits may run at the same time. Then kernels share the device, each time is from a kernel's begin to its
    /// end, and the sum of the times is above `kernels`.
    struct {
        double load = 0;     ///< Reading the scene's file. Only the command line sets this member.
        double compile = 0;  ///< Compiling the scene.
        /// Finding devices and compiling all kernels so far. A call that waits for this does not count the wait as
        /// `frame`.
        double build = 0;
        double count_segments = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0, shade = 0;  ///< kernels
        double cull_tiles = 0, first_hits = 0, rows = 0;                                              ///< kernels
        double kernels = 0;  ///< Time in which kernels ran on a device, one or several at once.
        double frame = 0;    ///< The whole call, on the host's clock.
        double write = 0;    ///< Writing the picture's file. Only the command line sets this member.
    } ms = {};
};

}  // namespace csgrt
