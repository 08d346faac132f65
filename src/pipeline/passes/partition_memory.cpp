#include "pipeline/passes/partition_memory.hpp"

#include <algorithm>

namespace csgrt {

PartitionMemory::PartitionMemory(Device& device, const RecordConverter& records)
    : device_(device),
      boundary_bytes_(records.boundary_bytes()),
      ray_counts_(device, "candidates' places, then rays' tallies"),
      offsets_(device, "rays' offsets"),
      candidates_(device, "candidates"),
      found_(device, "candidates' segments, then partitions"),
      boundaries_(device, "segments"),
      bits_(device, "partitions' bits"),
      tally_sums_(device, "sums of tallies") {}

namespace {
struct Wanted {
    Buffer* buffer;
    std::uint64_t bytes;
};
}  // namespace

bool PartitionMemory::reserve_rays(std::uint32_t rays) {
    const std::uint64_t entries = (std::uint64_t{rays} + 1) * sizeof(kernel::RayCount);
    const Wanted wanted[] = {
        {&ray_counts_, entries}, {&offsets_, entries}, {&tally_sums_, scan_blocks_of(rays) * sizeof(kernel::RayTally)}};
    std::uint64_t more = 0;
    for (const Wanted& w : wanted) more += w.bytes > w.buffer->size() ? w.bytes : 0;
    if (more > device_.available()) release_counted();
    if (more > device_.available()) return false;
    for (const Wanted& w : wanted) w.buffer->reserve(w.bytes);
    return true;
}

bool PartitionMemory::holds_rays(std::uint32_t rays) const {
    const std::uint64_t entries = (std::uint64_t{rays} + 1) * sizeof(kernel::RayCount);
    return entries <= ray_counts_.size() && entries <= offsets_.size() &&
           scan_blocks_of(rays) * sizeof(kernel::RayTally) <= tally_sums_.size();
}

bool PartitionMemory::reserve_candidates(std::uint32_t candidates) {
    const std::uint64_t candidate_bytes = std::uint64_t{candidates} * sizeof(kernel::Candidate);
    const std::uint64_t found_bytes = candidates * segment_bytes();
    if (candidates == COUNT_MAX || found_bytes > device_.max_buffer()) return false;
    if (candidate_bytes <= candidates_.size() && found_bytes <= found_.size()) return true;
    const std::uint64_t bytes = candidate_bytes + found_bytes;
    if (bytes > device_.available() + candidates_.size() + found_.size()) release_counted();
    if (bytes > device_.available() + candidates_.size() + found_.size()) return false;
    candidates_.reserve(candidate_bytes);
    found_.reserve(found_bytes);
    return true;
}

bool PartitionMemory::reserve_segments(const kernel::RayCount& total) {
    if (total.segments >= NONE / 2 || total.words == COUNT_MAX) return false;
    // Kernel 2 stores the number of each boundary's ray there.
    const std::uint64_t words = std::max<std::uint64_t>(total.words, 2 * std::uint64_t{total.segments});
    const Wanted wanted[] = {{&boundaries_, total.segments * segment_bytes()}, {&bits_, words * sizeof(std::uint32_t)}};
    const std::uint64_t partitions = partition_bytes(total.segments),
                        more = partitions > found_.size() ? partitions : 0;
    std::uint64_t needed = more, grown = more, held = 0;
    if (more > device_.max_buffer()) return false;
    for (const Wanted& w : wanted) {
        if (w.bytes > device_.max_buffer()) return false;
        needed += w.bytes;
        grown += std::max<std::uint64_t>(w.bytes, w.buffer->size());
        held += w.buffer->size();
    }
    if (needed > device_.available() + held) return false;
    if (grown > device_.available() + held)
        for (const Wanted& w : wanted) w.buffer->release();
    for (const Wanted& w : wanted) w.buffer->reserve(w.bytes);
    return true;
}

PartitionSizes PartitionMemory::capacity() const {
    const auto holds = [](const Buffer& buffer, std::size_t bytes) {
        return static_cast<std::uint32_t>(std::min<std::size_t>(buffer.size() / bytes, NONE / 2));
    };
    return {.candidates = std::min(holds(candidates_, sizeof(kernel::Candidate)), holds(found_, segment_bytes())),
            .total = {.segments = std::min(holds(boundaries_, segment_bytes()),
                                           holds(found_, 2 * sizeof(kernel::PartitionNode))),
                      .words = holds(bits_, sizeof(std::uint32_t))}};
}

std::uint64_t PartitionMemory::held() const {
    std::uint64_t sum = 0;
    for (const Buffer* buffer : {&ray_counts_, &offsets_, &candidates_, &found_, &boundaries_, &bits_, &tally_sums_})
        sum += buffer->size();
    return sum;
}

void PartitionMemory::release() {
    for (Buffer* buffer : {&ray_counts_, &offsets_, &tally_sums_}) buffer->release();
    release_counted();
}

void PartitionMemory::release_counted() {
    for (Buffer* buffer : {&candidates_, &found_, &boundaries_, &bits_}) buffer->release();
}

}  // namespace csgrt
