#include "pipeline/scheduling/native_lists.hpp"

#include <algorithm>
#include <array>
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
        std::array<kernel::RayRecord, most> memory;
        PipelineCounts own;
        RowMemory rows;
        std::size_t size = last - first;
        while (first < last) {
            const std::span records = std::span(memory).first(std::min(size, last - first));
            rays.fill(first, records);
            if (!tracer_.trace(frame, records, sink.fields(), device_.stop(), rows, own)) {
                if (records.size() == 1) throw_too_long_ray(tracer_.budget());
                size = records.size() / 2;
                continue;
            }
            sink.put(rows.view(first, records.size(), sink.fields()));
            own.done.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(records.size())});
            first += records.size();
            if (told) told(records.size());
        }
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
