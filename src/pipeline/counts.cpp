#include "pipeline/counts.hpp"

namespace csgrt {

PipelineCounts& PipelineCounts::operator+=(const PipelineCounts& other) {
    hits += other.hits;
    segments += other.segments;
    partitions_used += other.partitions_used;
    partitions_allocated += other.partitions_allocated;
    overlaps += other.overlaps;
    segment_bytes += other.segment_bytes;
    partition_bytes += other.partition_bytes;
    batches += other.batches;
    retried += other.retried;
    count_hits += other.count_hits;
    scan += other.scan;
    store_segments += other.store_segments;
    weave += other.weave;
    evaluate += other.evaluate;
    shade += other.shade;
    cull_tiles += other.cull_tiles;
    first_hits += other.first_hits;
    return *this;
}

void add_times(const TimedKernels& timed, PipelineCounts& counts) {
    for (const auto& [time, kernel] : timed) counts.*time += milliseconds(kernel);
}

}  // namespace csgrt
