#include "pipeline/scheduling/native_lists.hpp"

#include <algorithm>
#include <mutex>

#include "base/clock.hpp"
#include "base/parallel.hpp"

namespace csgrt {

void NativeLists::trace(const kernel::Frame& frame, const RayList& list, const RayNumbers& range, RowReceiver& receiver,
                        const ReportDone& report_done, PipelineCounts& counts) const {
    // A short list is divided so that each thread has several batches, all of them whole packets.
    const std::size_t rays = range.end - range.first, share = rays / (8 * thread_count(0)) / 8 * 8,
                      most = std::clamp<std::size_t>(share, 8, NativeTracer::batch_rays);
    const auto start = Clock::now();
    std::mutex mutex;
    const auto trace_batch = [&](std::size_t first, std::size_t last) {
        PipelineCounts own;
        tracer_.trace(frame, list, first, last, device_.stop(), receiver, own);
        if (report_done) report_done(last - first);
        const std::lock_guard lock(mutex);
        counts += own;
    };
    for_chunks(rays, most, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        receiver.guard([&] { trace_batch(range.first + first, range.first + last); });
    });
    counts.kernels += milliseconds_since(start);
    std::ranges::sort(counts.done, {}, &RayBatch::first);
}

}  // namespace csgrt
