#include "pipeline/scheduling/native_lists.hpp"

#include <algorithm>
#include <mutex>

#include "base/clock.hpp"
#include "base/parallel.hpp"

namespace csgrt {

void NativeLists::trace(const kernel::Frame& frame, const RayList& rays, const RayNumbers& range, RowSink& sink,
                        const Told& told, PipelineCounts& counts) const {
    constexpr std::size_t most = NativeTracer::batch_rays;
    const auto start = Clock::now();
    std::mutex mutex;
    const auto trace_batch = [&](std::size_t first, std::size_t last) {
        PipelineCounts own;
        tracer_.trace(frame, rays, first, last, device_.stop(), sink, own);
        if (told) told(last - first);
        const std::lock_guard lock(mutex);
        counts += own;
    };
    for_chunks(range.end - range.first, most, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        sink.guard([&] { trace_batch(range.first + first, range.first + last); });
    });
    counts.kernels += milliseconds_since(start);
    std::ranges::sort(counts.done, {}, &RayBatch::first);
}

}  // namespace csgrt
