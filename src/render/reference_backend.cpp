#include "render/reference_backend.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace csgrt {

void ReferenceBackend::render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) {
    std::ranges::fill(memory.covered, std::uint8_t{1});
    memory.drawn_by = 0;
    memory.registered = nullptr;
    counts_ = {};
    const kernel::DisplayBytes& display = model_->scene.display[0];
    const std::vector<kernel::Pixel> seen = reference_->render(frame, &watch, counts_);
    for_chunks(seen.size(), 16'384, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t c = 0; c < memory.sources.size(); ++c)
            for (std::size_t i = first; i < last; ++i)
                memory.channels[c].pixels[i] = memory.sources[c]->value(seen[i], display);
    });
}

void ReferenceBackend::trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch& watch) {
    counts_ = {};
    reference_->trace(frame, rays, receiver, &watch, counts_);
}

void ReferenceBackend::report(Statistics& statistics) const {
    statistics.ends = counts_.ends;
    statistics.segments = counts_.segments;
    statistics.partitions_used = statistics.partitions_allocated = counts_.partitions;
    statistics.overlaps = counts_.overlaps;
    statistics.batches = 1;
}

}  // namespace csgrt
