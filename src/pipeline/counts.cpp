#include "pipeline/counts.hpp"

#include <algorithm>

namespace csgrt {

PipelineCounts& PipelineCounts::operator+=(const PipelineCounts& other) {
    ends += other.ends;
    segments += other.segments;
    partitions_used += other.partitions_used;
    partitions_allocated += other.partitions_allocated;
    overlaps += other.overlaps;
    segment_bytes += other.segment_bytes;
    partition_bytes += other.partition_bytes;
    batches += other.batches;
    has_edges |= other.has_edges;
    done.insert(done.end(), other.done.begin(), other.done.end());
    retried += other.retried;
    count_segments += other.count_segments;
    scan += other.scan;
    store_segments += other.store_segments;
    weave += other.weave;
    evaluate += other.evaluate;
    shade += other.shade;
    rows += other.rows;
    cull_tiles += other.cull_tiles;
    first_hits += other.first_hits;
    kernels += other.kernels;
    return *this;
}

void add_time(double PipelineCounts::*figure, const Event& kernel, PipelineCounts& counts) {
    const TimeSpan span = time_span(kernel);
    counts.*figure += static_cast<double>(span.end - span.begin) * 1e-6;
    counts.spans.push_back(span);
}

void add_times(const TimedKernels& timed, PipelineCounts& counts) {
    for (const auto& [figure, kernel] : timed) add_time(figure, kernel, counts);
}

double covered_time(std::vector<TimeSpan> spans) {
    std::ranges::sort(spans, {}, &TimeSpan::begin);
    std::uint64_t covered = 0, end = 0;
    for (const TimeSpan& span : spans) {
        covered += std::max(span.end, end) - std::max(span.begin, end);
        end = std::max(span.end, end);
    }
    return static_cast<double>(covered) * 1e-6;
}

}  // namespace csgrt
