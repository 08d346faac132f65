// Counts and times of the pipeline.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "device/opencl/opencl.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

/// Counts and times of one frame, summed over its batches. Times are the device's own, in milliseconds.
struct PipelineCounts {
    std::uint64_t ends = 0, segments = 0, partitions_used = 0, partitions_allocated = 0, overlaps = 0;
    std::uint64_t segment_bytes = 0, partition_bytes = 0;
    std::uint32_t batches = 0, retried = 0;  ///< retried: batches that ran again because the buffers were too small
    bool has_edges = false;                  ///< the frame's edges are drawn
    std::vector<RayBatch> done;              ///< the batches
    double count_segments = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0, shade = 0, rows = 0;
    double cull_tiles = 0, first_hits = 0;
    std::vector<TimeSpan> spans;  ///< of all kernels of one device; a sum over devices has none
    double kernels = 0;           ///< time in which at least one kernel ran

    PipelineCounts& operator+=(const PipelineCounts& other);
};

/// Kernels that run or have run, each with the member to which its time is added.
using TimedKernels = std::vector<std::pair<double PipelineCounts::*, Event>>;

/// Waits for a kernel, and adds its time.
void add_time(double PipelineCounts::*figure, const Event& kernel, PipelineCounts& counts);
void add_times(const TimedKernels& timed, PipelineCounts& counts);

/// The milliseconds that at least one of the spans covers.
double covered_time(std::vector<TimeSpan> spans);

}  // namespace csgrt
