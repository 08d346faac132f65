// Every partition of a tile's rays, in five kernels:
//
//   count hits -> store segments -> weave -> evaluate -> shade
//
// Memory is counted, then allocated, never guessed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "compile/claims.hpp"
#include "device/queued.hpp"
#include "pipeline/cull.hpp"

namespace csgrt {

/// How a tile's rays are given: blocks of a picture's that kernel 0 has looked at, single ones of a picture's, or a
/// list.
enum class Rays { blocks, picked, listed };

class Exact {
public:
    Exact(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings);

    /// Runs the kernels on the tile's rays, but the last one; waits for counts only. False: the rays' segments do not fit the
    /// memory; nothing is lost then, the caller takes a smaller tile. `beside` is called while most of them run.
    bool weave(const SceneBuffers& scene, const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts,
               const std::function<void()>& beside = nullptr);
    /// Runs the last one on the last run's rays, if they are a picture's. Does not wait.
    void shade(const SceneBuffers& scene, const TileBuffers& tile, const Buffer& picture, std::uint32_t rays);
    /// Has the last run's partitions and overlaps summed, once it is shaded. Does not wait.
    void tally(std::uint32_t rays);
    /// Has the sums copied; see QueuedRead. When the last run's kernels are done, and before those of the next one.
    void fetch();
    /// Adds them up, once fetch() was called. Waits.
    void add_tallies(PipelineCounts& counts);
    /// Adds up how long kernels took, those up to the last fetch().
    void add_times(PipelineCounts& counts);
    /// All that at once, the sums only if they are `tallied`. Waits.
    void settle(std::uint32_t rays, bool tallied, PipelineCounts& counts);
    /// Leaves aside what the last runs have yet to tell.
    void forget() noexcept;

    /// The claimed partitions of each ray of the last run, from the first that is seen on.
    std::vector<std::vector<ClaimedPartition>> claims(std::uint32_t rays) const;

    Cull& cull() { return cull_; }
    static constexpr std::uint64_t ray_bytes =
        2 * sizeof(kernel::RayCount) + sizeof(std::uint32_t) + 4;  ///< whatever a ray hits, and its part of the sums
    std::uint64_t held() const;
    void release();  ///< gives that back: another use of the budget wants it

private:
    bool try_weave(const SceneBuffers& scene, const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts,
                   const std::function<void()>& beside);
    /// A step of the scan: of each block of entries the sum; the entries become sums within their block.
    void sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums);
    /// Exclusive prefix sums over the first rays + 1 entries, the last of which need not be set.
    void queue_scan(Buffer& counts, std::uint32_t rays);
    kernel::RayCount sum_of(const Buffer& counts, std::uint32_t rays);  // the last one of them, once queue_scan() was called; waits
    void release_counted();  // what holds segments and partitions
    bool reserve_counted(const kernel::RayCount& total);
    std::vector<ClaimedPartition> claims_of(const std::vector<kernel::End>& ends,
                                            const std::vector<kernel::PartitionNode>& nodes,
                                            const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                            const kernel::RayCount& end, std::uint32_t first_node) const;
    std::vector<std::uint32_t> claimants(const kernel::End* ends, std::uint32_t segments,
                                         const std::uint32_t* bits) const;

    Device& device_;
    const CompiledScene& scene_;
    const HostKernels& kernels_;
    Program program_;
    Cull cull_;
    Kernel find_candidates_;
    struct PacketCandidates {
        Kernel count, list;
    };
    std::optional<PacketCandidates> packet_candidates_;  // on processors
    Kernel count_hits_, sum_hits_, scan_blocks_, scan_add_, store_segments_, order_ends_, weave_,
        evaluate_, shade_;
    Buffer places_;            // of the rays' candidates; from weaving on their tallies
    Buffer counts_, firsts_;   // one entry a ray, too
    Buffer candidates_;        // this and the others: by what was counted
    Buffer found_;             // the candidates' only segments; once they are stored, the partitions
    Buffer ends_, bits_;
    std::vector<std::unique_ptr<Buffer>> sums_;             // of the scan, a level each
    kernel::RayCount total_{};                              // of the last run
    std::vector<std::pair<double PipelineCounts::*, Event>> timed_, done_;  // kernels that run, and those that have
    Buffer tally_sums_;        // read while the next run's kernels run
    std::size_t tallies_ = 0;  // how many sums
    QueuedRead read_, sum_;
};

}  // namespace csgrt
