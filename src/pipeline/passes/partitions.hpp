// Every partition of a batch's rays, in five kernels:
//
//   count hits -> store segments -> weave -> evaluate -> shade
//
// Memory is counted, then allocated; or, while other rays are under way, what there is is taken to do, and where it does not, nothing
// is written and the host, once it is told, has the rays counted.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "compile/regions/claims.hpp"
#include "device/queued.hpp"
#include "pipeline/passes/cull.hpp"

namespace csgrt {

/// How a batch's rays are given: tiles of a picture's that kernel 0 has looked at, single ones of a picture's, or a
/// list.
enum class Rays { tiles, picked, listed };

class Exact {
public:
    Exact(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings);

    /// What rays need, or have room for.
    struct Needs {
        std::uint32_t candidates = 0;
        kernel::RayCount total{};

        bool have_room(const Needs& room) const {
            return candidates <= room.candidates && total.segments <= room.total.segments && total.words <= room.total.words;
        }
    };

    /// Runs the kernels on the batch's rays, but the last one; waits for counts only. None: the rays' segments do not fit the
    /// memory; nothing is lost then, the caller takes a smaller batch.
    std::optional<Needs> weave(const SceneBuffers& scene, const BatchBuffers& batch, std::uint32_t rays, Rays kind, TimedKernels& timed);
    /// What there is memory for; none: by what earlier rays needed it would hardly do for so many.
    std::optional<Needs> capacity_for(std::uint32_t rays) const;
    /// The same in the memory that there is, of a picture's tiles whose frame says so; does not wait, not even for what runs. What the
    /// rays need, and so whether that was enough, stands in the batch's tally once they are shaded.
    void weave_ahead(const SceneBuffers& scene, const BatchBuffers& batch, std::uint32_t rays, const Needs& capacity, TimedKernels& timed);
    /// Runs the last one on the last run's rays, if they are a picture's. Does not wait.
    void shade(const SceneBuffers& scene, const BatchBuffers& batch, const Buffer& picture, std::uint32_t rays, TimedKernels& timed);
    /// Has the last run's partitions and overlaps summed, once it is shaded. Does not wait.
    void tally(std::uint32_t rays, TimedKernels& timed);
    /// Has the sums copied; see QueuedRead. When that is done, and before the next call of tally().
    void fetch();
    /// Adds them up, once fetch() was called. Waits.
    void add_tallies(PipelineCounts& counts);
    /// Adds up what rays needed, and tells what the next ones may need.
    void add_needs(const Needs& needs, std::uint32_t rays, PipelineCounts& counts);
    /// Sums the last run's partitions and overlaps, if they are `tallied`, and adds up how long its kernels took. Waits.
    void settle(std::uint32_t rays, bool tallied, TimedKernels& timed, PipelineCounts& counts);
    /// Leaves aside what the last runs have yet to tell.
    void forget() noexcept { read_.forget(); }

    /// The claimed partitions of each ray of the last run, from the first that is seen on.
    std::vector<std::vector<ClaimedPartition>> claims(std::uint32_t rays) const;

    Cull& cull() { return cull_; }
    static constexpr std::uint64_t ray_bytes =
        2 * sizeof(kernel::RayCount) + sizeof(std::uint32_t) + 4;  ///< whatever a ray hits, and its part of the sums
    std::uint64_t held() const;
    void release();  ///< gives that back: another use of the budget wants it

private:
    /// One batch's kernels, of which steps are queued.
    struct Run {
        const SceneBuffers& scene;
        const BatchBuffers& batch;
        std::uint32_t rays;
        Rays kind;
        TimedKernels& timed;
    };
    /// What a ray needs, on average.
    struct RayNeeds {
        double candidates = 0, segments = 0, words = 0;
    };
    /// Only a picture's tiles hold rays that lie side by side.
    bool by_packets(const Run& run) const { return run.kind == Rays::tiles && packet_candidates_; }
    std::optional<Needs> try_weave(const Run& run);
    void queue_places(const Run& run);  // where each ray's candidates stand
    void queue_counts(const Run& run, std::size_t candidates);
    void queue_partitions(const Run& run, std::size_t candidates, std::size_t nodes);
    /// A step of the scan: of each tile of entries the sum; the entries become sums within their tile.
    void sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums, TimedKernels& timed);
    /// Exclusive prefix sums over the first rays + 1 entries, the last of which, which need not be set, has a part in none.
    void queue_scan(Buffer& counts, std::uint32_t rays, TimedKernels& timed);
    kernel::RayCount sum_of(const Buffer& counts, const Run& run);  // the last one of them, once queue_scan() was called; waits
    std::vector<std::pair<Buffer*, std::uint64_t>> bytes_of_rays(std::uint32_t rays);
    bool hold_rays(std::uint32_t rays) const;
    Needs room() const;  // in what holds candidates, segments and partitions
    void release_counted();  // that
    bool reserve_candidates(std::uint32_t candidates);
    bool reserve_counted(const kernel::RayCount& total);
    std::vector<ClaimedPartition> claims_of(const std::vector<kernel::End>& ends,
                                            const std::vector<kernel::PartitionNode>& nodes,
                                            const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                            const kernel::RayCount& end) const;
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
    Kernel count_hits_, sum_hits_, scan_blocks_, scan_sums_, scan_add_, store_segments_, order_ends_, weave_,
        evaluate_, shade_;
    Buffer places_;            // of the rays' candidates; from weaving on their tallies
    Buffer counts_;            // one entry a ray, too
    Buffer candidates_;        // this and the others: by what was counted
    Buffer found_;             // the candidates' only segments; once they are stored, the partitions
    Buffer ends_, bits_;
    Buffer sums_;              // of the scan's tiles
    kernel::RayCount total_{};                              // of the last run that was counted
    RayNeeds needed_, needed_before_;                       // by the last rays whose needs are known, and by those before
    Buffer tally_sums_;        // read while the next run's kernels run
    std::size_t tallies_ = 0;  // how many sums
    QueuedRead read_, sum_;
};

}  // namespace csgrt
