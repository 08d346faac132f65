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
    std::string method = {};     ///< A few words.
    double tolerance = 0;        ///< Millimetres: the one that Settings::tolerance_rule gave.
    int width = 0;               ///< Of the picture, pixels; 0 for rays.
    int height = 0;              ///< The same.
    std::uint64_t rays = 0;
    std::uint64_t ends = 0;             ///< Of segments along all rays.
    std::uint64_t segments = 0;         ///< Intervals of rays inside single solids.
    std::uint64_t partitions_used = 0;  ///< Intervals between neighbouring ends of segments that are inside any solid.
    std::uint64_t partitions_allocated = 0;  ///< For how many partitions there was memory.
    std::uint64_t overlaps = 0;              ///< Partitions that several regions of the same rank claim.
    std::uint64_t device_bytes = 0;          ///< Memory in use on all devices.
    std::uint64_t segment_bytes = 0;         ///< Memory for segments, all batches.
    std::uint64_t partition_bytes = 0;       ///< Memory for partitions, all batches.
    std::uint32_t batches = 0;               ///< Of rays.
    /// Milliseconds. Those of kernels are the device's own measurements; those of several devices are added up. Batches
    /// of first hits may run at the same time. Then kernels share the device, each time is from a kernel's begin to its
    /// end, and their sum is above `kernels`.
    struct {
        double load = 0;     ///< Reading the scene's file; the command line sets it.
        double compile = 0;  ///< Compiling the scene.
        /// Finding devices and compiling all kernels so far. A call that waits for that does not count it as `frame`.
        double build = 0;
        double count_segments = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0, shade = 0;  ///< kernels
        double cull_tiles = 0, first_hits = 0, rows = 0;                                              ///< kernels
        double kernels = 0;  ///< In which kernels ran on a device, whether one or several at once.
        double frame = 0;    ///< The whole call, on the host's clock.
        double write = 0;    ///< Writing the picture's file; the command line sets it.
    } ms = {};
};

}  // namespace csgrt
