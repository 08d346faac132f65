// Partition memory: the buffers on the device in which the five kernels store their results for a batch's rays.
//
//   kernel             1 count      | 2 store segments | 3 weave | 4 evaluate | 5 shade, host
//   candidate places   w r            r
//   ... ray tallies                                      w                     r w
//   candidates         w r            r
//   found segments     w              r
//   ... partitions                                       w         w           r
//   offsets            w              r                  r         r           r
//   boundaries, bits                  w                  r w       r           r
//
// Two pairs share memory on purpose: a line that begins with dots uses the memory of the line above, which has been
// read by then.
#pragma once

#include <cstdint>

#include "compile/records/converter.hpp"
#include "device/program.hpp"

namespace csgrt {

/// The sizes that rays need, or the capacity of the buffers.
struct PartitionSizes {
    std::uint32_t candidates = 0;
    kernel::RayCount total{};  ///< segments, and words of partitions' bits

    bool fit(const PartitionSizes& capacity) const {
        return candidates <= capacity.candidates && total.segments <= capacity.total.segments &&
               total.words <= capacity.total.words;
    }
};

/// The buffers of a batch's segments and partitions. They are kept from batch to batch and grow to the size of the
/// largest batch.
class PartitionMemory {
public:
    PartitionMemory(Device& device, const RecordConverter& records);

    Buffer& candidate_places() { return ray_counts_; }  ///< kernel::CandidateCount, one a ray and one more
    Buffer& ray_tallies() { return ray_counts_; }       ///< kernel::RayTally, one a ray
    Buffer& offsets() { return offsets_; }              ///< kernel::RayCount, one a ray and one more
    Buffer& candidates() { return candidates_; }        ///< kernel::Candidate
    Buffer& found() { return found_; }                  ///< two kernel::Boundary a candidate
    Buffer& partitions() { return found_; }             ///< two kernel::PartitionNode a segment
    Buffer& boundaries() { return boundaries_; }        ///< two kernel::Boundary a segment
    Buffer& bits() { return bits_; }                    ///< words; at least 2 a segment
    Buffer& tally_sums() { return tally_sums_; }        ///< kernel::RayTally, one a scan block

    /// Bytes that each ray needs even if it hits nothing.
    static constexpr std::uint64_t ray_bytes = 2 * sizeof(kernel::RayCount) + sizeof(kernel::RayTally);

    /// The three functions below reserve memory. They return false if there is not enough device memory. Buffers only
    /// grow, unless they would not fit.
    bool reserve_rays(std::uint32_t rays);
    bool reserve_candidates(std::uint32_t candidates);
    bool reserve_segments(const kernel::RayCount& total);
    /// Reserves memory for partitions, when kernel 2 is queued: partitions use the memory of kernel 2's input.
    void reserve_partitions(std::uint32_t segments) { found_.reserve(partition_bytes(segments)); }

    /// The bytes that reserve_partitions() will take.
    std::uint64_t to_reserve(std::uint32_t segments) const {
        return partition_bytes(segments) > found_.size() ? partition_bytes(segments) : 0;
    }

    bool holds_rays(std::uint32_t rays) const;
    PartitionSizes capacity() const;
    std::uint64_t held() const;
    void release();          ///< gives all memory back
    void release_counted();  ///< gives back only the memory that depends on what rays hit

private:
    static std::uint64_t partition_bytes(std::uint32_t segments) {
        return 2 * std::uint64_t{segments} * sizeof(kernel::PartitionNode);
    }
    std::uint64_t segment_bytes() const { return 2 * std::uint64_t{boundary_bytes_}; }

    Device& device_;
    std::size_t boundary_bytes_;  ///< of kernel::Boundary in the program's precision
    Buffer ray_counts_, offsets_, candidates_, found_, boundaries_, bits_, tally_sums_;
};

/// The entries that one group of kernels/scan.cl sums.
inline constexpr std::uint32_t scan_block = 1024;
constexpr std::uint32_t scan_blocks_of(std::uint32_t entries) { return (entries + scan_block - 1) / scan_block; }

}  // namespace csgrt
