// Native tracer: traces lists of rays by the native device's kernels, without OpenCL. A batch is traced on the calling
// thread, in memory of this thread that fits its caches. Several threads may trace batches at once.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "compile/regions/status_tree.hpp"
#include "native/kernels.hpp"
#include "pipeline/counts.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// The tracer calls the native kernels directly, batch by batch. One object serves all threads; each thread has its own
/// memory.
class NativeTracer {
public:
    /// Refers to the level's programs "partitions" and "first_hits", and to the scene, which must outlive the tracer.
    /// `budget`: bytes that a batch may take.
    NativeTracer(const native::Level& level, const CompiledScene& scene, std::uint64_t budget);

    /// The most rays of a batch: their segments fit a processor's cache.
    static constexpr std::uint32_t batch_rays = 512;

    /// Writes the rows of a batch; `frame`: the frame of a list. Any thread. Returns false if the batch does not fit
    /// the budget. Throws Error (interrupted) when `stop`, which may be null, becomes true.
    bool trace(const kernel::Frame& frame, std::span<const kernel::RayRecord> rays, Fields fields,
               const std::atomic<bool>* stop, RowMemory& rows, PipelineCounts& counts) const;

    /// Puts the rows of rays [first, end) of a list into the receiver, one batch after the other. Any thread. Throws
    /// Error (out_of_memory, interrupted).
    void trace(const kernel::Frame& frame, const RayList& rays, std::uint64_t first, std::uint64_t end,
               const std::atomic<bool>* stop, RowReceiver& receiver, PipelineCounts& counts) const;

private:
    struct Scratch;
    struct Run;
    /// Writes the first row of each ray. Returns false if a ray has more segments at a time than the kernel holds.
    bool hit(const kernel::Frame& frame, std::span<const kernel::RayRecord> rays, Fields fields,
             const std::atomic<bool>* stop, RowMemory& rows, PipelineCounts& counts) const;
    void trace_deep_rays(Run& run) const;
    void write_rows(Run& run, Fields fields, RowMemory& rows) const;

    const CompiledScene& scene_;
    const std::uint64_t budget_;
    const native::CompiledKernel *find_candidates_, *count_packet_candidates_, *list_packet_candidates_,
        *count_segments_, *count_in_faces_, *sum_segments_, *store_segments_, *store_in_faces_, *order_boundaries_,
        *weave_, *evaluate_, *sort_deep_blocks_, *merge_deep_runs_, *clear_status_, *sweep_deep_rays_, *count_rows_,
        *write_rows_, *describe_rows_, *hit_listed_rays_;
};

}  // namespace csgrt
