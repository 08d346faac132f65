// Partition pass: makes every partition of a batch's rays by five kernels:
//
//   1 count segments -> 2 store segments -> 3 weave -> 4 evaluate -> 5 shade
//
// They run in one of two modes. Either the host reads between the kernels how much memory the rays need and allocates
// exactly this memory (trace_counted). Or all kernels are queued at once, with the existing buffers (trace_queued).
// Then the kernels write nothing if the rays need more than the capacity that their frame states, or if a ray is deep;
// the batch's report has the sizes that the rays need. Once the number of deep rays is known, other kernels replace
// kernels 3 and 4 for them (deep_rays.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/laboratory.hpp"
#include "device/queued.hpp"
#include "pipeline/counts.hpp"
#include "pipeline/passes/cull.hpp"
#include "pipeline/passes/deep_rays.hpp"
#include "pipeline/passes/partition_memory.hpp"
#include "pipeline/passes/rows.hpp"

namespace csgrt {

/// The pass launches kernels 1 to 5 for a batch, and kernel 6 for a list. It owns the buffers between them. It
/// remembers how many segments rays had, to predict the sizes of later batches.
class PartitionPass {
public:
    /// The input of the kernels. The batch's frame and lists are uploaded already.
    struct Input {
        const SceneTables& scene;
        const BatchBuffers& batch;
        Work work;
        std::uint32_t rays;
    };

    /// Compiles the kernels. Throws Error (device_fault).
    PartitionPass(Device& device, const CompiledScene& scene, const RecordConverter& records, const Settings& settings);

    /// Sets another scene, which the pass's programs can draw (see draws()). The two arguments must outlive the pass.
    void set_scene(const CompiledScene& scene, const RecordConverter& records);

    /// Runs kernels 1 to 4. The frame's capacities are COUNT_MAX. Waits for the counts only. Returns the sizes that the
    /// rays need; nullopt if they do not fit the memory: then the caller makes a smaller batch.
    std::optional<PartitionSizes> trace_counted(const Input& input, TimedKernels& timed);
    /// The capacity of the existing buffers; nullopt if it is probably too small for so many rays, by the average of
    /// earlier rays.
    std::optional<PartitionSizes> capacity_for(std::uint32_t rays) const;
    /// Queues kernels 1 to 4 with the existing buffers. The frame's capacities are `capacity`. Does not wait.
    void trace_queued(const Input& input, const PartitionSizes& capacity, TimedKernels& timed);

    /// Queues kernel 5: the pixels of the rays that were traced last. Does not wait.
    void shade(const Input& input, const Buffer& picture, TimedKernels& timed);
    /// Queues the sum of the tallies of the rays that were traced last. Does not wait.
    void sum_tallies(std::uint32_t rays, TimedKernels& timed);
    /// Queues the copy of the sums to the host. To be called when their kernels are done, before the next
    /// sum_tallies().
    void copy_tallies() { read_.copy(); }
    /// Adds the copied sums up. Waits for the copy.
    void add_tallies(PipelineCounts& counts);
    /// Drops the copied sums.
    void cancel_tallies() noexcept { read_.cancel(); }
    /// Adds the sizes to the counts, and remembers them for capacity_for().
    void add_sizes(const PartitionSizes& needed, std::uint32_t rays, PipelineCounts& counts);

    /// Queues the kernel that makes the rays of the grid in the batch's frame (put_grid). Returns the kernel's event.
    Event make_rays(const BatchBuffers& batch, std::uint32_t rays, RayRange range);
    /// Runs kernel 6, which writes the rows of the rays of the last trace_counted(). `first`: the first ray's number.
    /// Waits for the number of rows only. Returns false if there is not enough memory.
    bool write_rows(const Input& input, std::uint64_t first, Fields fields, TimedKernels& timed);
    /// Starts to copy the rows to the host, once their kernels are done.
    void start_copy() { rows_.start_copy(has_deep_rays_ && rows_.has_overlaps() ? read_deep_rays() : SomeRays{}); }
    RowPass& rows() { return rows_; }
    /// Reads the results of the last trace_counted(), for the laboratory and tests. Waits.
    TracedBatch read(std::uint32_t rays);

    CullPass& cull() { return cull_; }
    DeepRayPass& deep_rays() { return deep_rays_; }
    std::uint64_t held() const { return memory_.held() + deep_rays_.held() + rows_.held(); }
    void release() {
        memory_.release();
        rows_.release();
        deep_rays_.release();
    }

private:
    /// The sizes that a ray needs on average.
    struct Average {
        double candidates = 0, segments = 0, words = 0;
    };
    void place_candidates(const Input& input, TimedKernels& timed);
    void count_segments(const Input& input, std::uint32_t candidates, TimedKernels& timed);
    /// `deep_words`: see kernels/1_count_segments.cl.
    void sum_segments(const Input& input, std::uint32_t deep_words, TimedKernels& timed);
    void make_partitions(const Input& input, std::uint32_t candidates, std::uint32_t segments, TimedKernels& timed);
    std::optional<PartitionSizes> try_counted(const Input& input, TimedKernels& timed);
    SomeRays read_deep_rays();
    void sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums, TimedKernels& timed);
    void scan(const Buffer& counts, std::uint32_t rays, TimedKernels& timed);
    kernel::RayCount read_total(const Buffer& counts, std::uint32_t rays, const TimedKernels& timed);
    /// Whether the rays are traced in packets. Pixels that are listed one by one are not, since they may lie far from
    /// each other.
    bool in_packets(const Input& input) const { return input.work != Work::pixels && packet_candidates_; }
    RowPass::Input rows_of(const Input& input, std::uint64_t first) {
        return {input.batch.frame,
                input.batch.rays,
                memory_.offsets(),
                memory_.boundaries(),
                memory_.partitions(),
                memory_.bits(),
                first,
                input.rays};
    }

    Device& device_;
    const CompiledScene* scene_;
    const RecordConverter* records_;
    const Evaluation* other_evaluation_;
    Program program_;
    CullPass cull_;
    struct PacketCandidates {
        Kernel count, list;
    };
    std::optional<PacketCandidates> packet_candidates_;  ///< on processors
    struct RaysInFaces {
        Kernel count, store;
    };
    std::optional<RaysInFaces> rays_in_faces_;  ///< if the scene has solids that need them
    Kernel make_rays_, find_candidates_, count_segments_, sum_segments_, scan_blocks_, scan_sums_, scan_add_,
        store_segments_, order_boundaries_, weave_, evaluate_, shade_;
    PartitionMemory memory_;
    DeepRayPass deep_rays_;
    RowPass rows_;
    Buffer no_buffer_;  ///< a null pointer
    Buffer scan_sums_buffer_;
    bool has_deep_rays_ = false;
    std::vector<kernel::RayCount> offsets_;          ///< of the rays, if there are deep rays
    std::optional<PinnedMemory> deep_;               ///< boundaries and nodes of deep rays
    std::vector<kernel::Boundary> deep_boundaries_;  ///< in double, if the device's are not
    Average average_, average_before_;               ///< of the last rays whose sizes are known, and of the rays before
    std::size_t tally_count_ = 0;                    ///< of sums
    QueuedRead read_, read_total_;
};

/// A kernel in place of kernel 4, for the laboratory of methods (bench/methods). It evaluates deep rays, too.
struct Evaluation {
    std::string name, source;  ///< the source is appended to all kernels' sources, and may use them
    /// Queues the kernel for the rays' `segments`.
    std::function<Event(Kernel&, const PartitionPass::Input&, PartitionMemory&, std::uint32_t segments)> launch;
};

}  // namespace csgrt
