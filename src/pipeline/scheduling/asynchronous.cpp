#include "pipeline/scheduling/asynchronous.hpp"

#include <algorithm>
#include <utility>

namespace csgrt {
namespace {

constexpr PartitionSizes unlimited{.candidates = COUNT_MAX, .total = {.segments = COUNT_MAX, .words = COUNT_MAX}};

kernel::ChannelValues background_of(const RenderTarget& target) {
    kernel::ChannelValues background{};
    for (std::size_t c = 0; c < target.channels.size(); ++c) background.of[c] = target.channels[c].background;
    return background;
}

}  // namespace

AsynchronousSchedule::AsynchronousSchedule(DevicePasses& passes, SynchronousSchedule& pixels)
    : passes_(passes), pixels_(pixels), batches_{Batch(passes.device), Batch(passes.device)}, ring_(passes.device) {}

std::uint64_t AsynchronousSchedule::held() const {
    std::uint64_t sum = ring_.held();
    for (const Batch& batch : batches_) sum += batch.buffers.held();
    return sum;
}

bool AsynchronousSchedule::reclaim() {
    if (!is_idle() || held() == 0) return false;
    for (Batch& batch : batches_) batch.buffers.release();
    ring_.release();
    return true;
}

void AsynchronousSchedule::abandon() noexcept {
    try {
        passes_.device.finish();  // queued kernels write into pictures that a frame may take next
    } catch (...) {
    }
    for (Batch& batch : batches_) batch.stage = Stage::free;
    overflown_.clear();
    ring_.abandon();
}

bool AsynchronousSchedule::is_idle() const {
    return std::ranges::all_of(batches_, [](const Batch& batch) { return batch.stage == Stage::free; });
}

AsynchronousSchedule::Batch* AsynchronousSchedule::with(Stage stage) {
    const auto found = std::ranges::find(batches_, stage, &Batch::stage);
    return found == batches_.end() ? nullptr : &*found;
}

// Every partition: the kernels of all batches share buffers, so they use one queue, except for culling. First hits:
// each batch has its own queue, so that the next batch's kernels begin while the longest rays of the last batch are
// drawn.
std::size_t AsynchronousSchedule::queue_of(const Batch& batch, bool every_partition) const {
    return every_partition ? 1 : static_cast<std::size_t>(&batch - batches_.data());
}

void AsynchronousSchedule::render(const FrameJob& job) {
    if (std::exchange(drew_every_partition_, job.frame.every_partition != 0) != (job.frame.every_partition != 0)) {
        reclaim();  // the memory suffices for the buffers of one mode only
        passes_.release();
    }
    is_memory_short_ = false;
    while (Batch* const batch = next(job)) {
        switch (batch->stage) {
            case Stage::free:
                is_memory_short_ = !start_next(*batch, job);
                break;
            case Stage::culled:
                trace(*batch, job);
                break;
            case Stage::traced:
                shade(*batch, job);
                break;
            case Stage::shaded:
                collect(*batch, job);
                break;
        }
    }
    if (overflown_.empty()) return;
    ring_.finish();  // whole tiles are written before their single pixels
    pixels_.draw_pixels(job, std::exchange(overflown_, {}));
}

// The batch whose next step runs: a batch that needs no wait, else the oldest batch. Null: the frame is drawn.
AsynchronousSchedule::Batch* AsynchronousSchedule::next(const FrameJob& job) {
    Batch* const free = is_memory_short_ || job.source.is_empty() ? nullptr : with(Stage::free);
    if (job.frame.every_partition) {
        if (Batch* const culled = with(Stage::culled)) return culled;
        Batch* const shaded = with(Stage::shaded);
        if (Batch* const traced = with(Stage::traced)) return shaded ? shaded : traced;
        return free ? free : shaded;
    }
    std::vector<const Event*> ends;
    for (Batch& batch : batches_) {
        if (batch.stage != Stage::shaded) continue;
        if (is_done(batch.end())) return &batch;
        ends.push_back(&batch.end());
    }
    if (free || ends.empty()) return free;
    if (ends.size() == 1)
        wait_for(*ends.front());
    else
        wait_for_one(ends);
    const auto done = std::ranges::find_if(
        batches_, [](const Batch& batch) { return batch.stage == Stage::shaded && is_done(batch.end()); });
    return done == batches_.end() ? next(job) : &*done;
}

// Starts the source's next batch. Returns false if the memory does not suffice for a second batch.
bool AsynchronousSchedule::start_next(Batch& batch, const FrameJob& job) {
    const bool is_alone = is_idle();
    const RayBatch rays = job.source.next();
    if (is_alone && !rays.is_whole_tiles()) {
        ring_.finish();
        pixels_.draw_part_of_tile(job, rays);
        job.report(rays);
        return true;
    }
    if (rays.is_whole_tiles() && start(batch, job, rays)) return true;
    if (!is_alone) {
        job.source.give_back(rays);
        return false;
    }
    reclaim();
    passes_.release();
    if (!start(batch, job, rays)) job.source.halve(rays, passes_.device.budget());
    return true;
}

// The step free -> culled or, for first hits, free -> shaded. Returns false if the batch does not fit the memory.
bool AsynchronousSchedule::start(Batch& batch, const FrameJob& job, const RayBatch& rays) {
    const bool every = job.frame.every_partition;
    batch.rays = rays;
    batch.frame = job.frame;
    batch.frame.first_ray = rays.first;
    batch.frame.ray_count = rays.rays;
    batch.frame.rows = static_cast<std::uint32_t>(rows_of(job.frame, rays.first_tile(), rays.end_tile()).lines());
    batch.picture = nullptr;
    batch.culling.clear();
    batch.drawing.clear();
    if (!every && !acquire_picture(batch, job)) return false;
    const std::vector<std::byte> frame = passes_.records().frame(batch.frame);
    if (batch_bytes(job.shape(), rays, frame.size()) > passes_.device.available() + batch.buffers.held()) {
        cancel(batch);
        return false;
    }
    const Device::OnQueue queue(passes_.device, queue_of(batch, every));
    batch.stage = Stage::culled;
    batch.frame_upload.start<std::byte>(batch.buffers.frame, frame);
    batch.culling.push_back(passes_.cull(batch.frame).launch(*passes_.tables, batch.buffers, batch.frame));
    const std::uint32_t most_in_parts = every ? 0 : TileListPass::most_in_parts(passes_.device);
    for (Event& event : passes_.tile_list().list(rays, batch.buffers, most_in_parts))
        batch.culling.push_back(std::move(event));
    batch.report_read.start(batch.buffers.report,
                            every ? sizeof(kernel::BatchReport) : BatchBuffers::report_bytes(rays));
    if (!every) {
        ReadbackRing::wait(*batch.picture);
        write_background(batch, job);
        batch.drawing = passes_.first_hits().launch(*passes_.tables, batch.buffers, batch.picture->buffer, rays.rays);
        if (job.has_edges(rays))
            batch.drawing.emplace_back(&PipelineCounts::shade,
                                       passes_.tile_list().draw_edges(rays, batch.buffers, batch.picture->buffer));
        batch.stage = Stage::shaded;
    }
    passes_.device.flush();
    return true;
}

PartitionPass::Input AsynchronousSchedule::input_of(const Batch& batch) const {
    return {*passes_.tables, batch.buffers, Work::tiles, batch.frame.ray_count};
}

void AsynchronousSchedule::upload_frame(Batch& batch, const PartitionSizes& capacity) {
    batch.capacity = capacity;
    batch.frame.candidate_capacity = capacity.candidates;
    batch.frame.segment_capacity = capacity.total.segments;
    batch.frame.word_capacity = capacity.total.words;
    batch.frame_upload.start<std::byte>(batch.buffers.frame, passes_.records().frame(batch.frame));
}

bool AsynchronousSchedule::acquire_picture(Batch& batch, const FrameJob& job) {
    const std::size_t pixels = rows_of(batch.frame, batch.rays.first_tile(), batch.rays.end_tile()).size();
    if (!batch.picture) batch.picture = ring_.acquire(pixels * job.shape().pixel_bytes);
    return batch.picture != nullptr;
}

void AsynchronousSchedule::write_background(Batch& batch, const FrameJob& job) {
    batch.culling.push_back(passes_.tile_list().write_background(
        batch.frame, batch.rays, batch.buffers.costs, background_of(job.target),
        static_cast<std::uint32_t>(job.target.channels.size()), batch.picture->buffer));
}

// The step culled -> traced: kernels 1 to 4 are queued behind the kernels of the batch before, if the existing buffers
// will probably suffice. Else the batch before is collected first, and this batch's memory is counted.
void AsynchronousSchedule::trace(Batch& batch, const FrameJob& job) {
    wait_for(batch.culling.back());
    batch.report_read.copy();
    batch.frame.ray_count = batch.report().entries * tile_rays;
    Batch& before = *other(batch);
    if (before.stage == Stage::shaded && is_done(before.end())) {  // the pixels are ready
        collect(before, job);
        if (batch.stage != Stage::culled) return;
    }
    if (batch.frame.ray_count == 0) {
        batch.stage = Stage::traced;
        return;
    }
    if (const auto capacity = passes_.partitions().capacity_for(batch.frame.ray_count)) {
        upload_frame(batch, *capacity);
        passes_.partitions().trace_queued(input_of(batch), *capacity, batch.drawing);
        batch.stage = Stage::traced;
        return;
    }
    if (before.stage == Stage::shaded) collect(before, job);
    if (batch.stage == Stage::culled) trace_alone(batch, job);
}

// The step traced -> shaded, when the batch before is collected.
void AsynchronousSchedule::shade(Batch& batch, const FrameJob& job) {
    if (!acquire_picture(batch, job)) {  // the host has to wait for memory, so it waits for all queued work
        passes_.device.finish();
        batch.stage = Stage::culled;
        trace_alone(batch, job);
        if (batch.stage != Stage::traced) return;
    }
    ReadbackRing::wait(*batch.picture);
    write_background(batch, job);
    if (batch.frame.ray_count > 0) {
        passes_.partitions().shade(input_of(batch), batch.picture->buffer, batch.drawing);
        passes_.partitions().sum_tallies(batch.frame.ray_count, batch.drawing);
    }
    batch.report_read.start(batch.buffers.report, BatchBuffers::report_bytes(batch.rays));
    passes_.device.flush();
    batch.stage = Stage::shaded;
}

// The step shaded -> free; or back to traced if the capacity was too small.
void AsynchronousSchedule::collect(Batch& batch, const FrameJob& job) {
    is_memory_short_ = false;
    job.frame.every_partition ? collect_partitions(batch, job) : collect_first_hits(batch, job);
}

void AsynchronousSchedule::collect_first_hits(Batch& batch, const FrameJob& job) {
    wait_for(batch.end());
    batch.report_read.copy();
    add_times(batch.drawing, job.counts);
    // The read uses the copy queue: a read that is queued behind kernels would delay all copies.
    const std::vector<std::uint32_t> numbers =
        batch.buffers.overflown.read_beside<std::uint32_t>(batch.report().overflows);
    overflown_.insert(overflown_.end(), numbers.begin(), numbers.end());
    job.counts.has_edges = job.has_edges(batch.rays) && numbers.empty();
    read_pixels(batch, job);
}

void AsynchronousSchedule::collect_partitions(Batch& batch, const FrameJob& job) {
    wait_patiently(batch.end());
    batch.report_read.copy();
    if (batch.frame.ray_count > 0) {
        const kernel::BatchReport& report = batch.report();
        const PartitionSizes needed{report.candidates, report.total};
        if (!needed.fit(batch.capacity)) return retry(batch, job);
        PartitionPass& pass = passes_.partitions();
        pass.copy_tallies();
        pass.add_sizes(needed, batch.frame.ray_count, job.counts);
        pass.add_tallies(job.counts);
        add_times(batch.drawing, job.counts);
    }
    read_pixels(batch, job);
}

// Nothing was written, because the rays need more than the existing buffers. The other batch is given back to the
// source, and this batch is traced again with counted memory.
void AsynchronousSchedule::retry(Batch& batch, const FrameJob& job) {
    passes_.device.finish();
    ++job.counts.retried;
    if (Batch& after = *other(batch); after.stage != Stage::free) {
        cancel(after);
        job.source.give_back(after.rays);
    }
    passes_.partitions().cancel_tallies();
    batch.stage = Stage::culled;
    trace_alone(batch, job);
}

// The step culled -> traced with counted memory, while no other batch is underway. If the memory does not suffice, the
// batch becomes free, and the source gets its rays back in halves.
void AsynchronousSchedule::trace_alone(Batch& batch, const FrameJob& job) {
    if (!try_alone(batch, job)) {  // memory that is kept for later is given up before the batch is halved
        for (Batch& one : batches_)
            if (&one != &batch) one.buffers.release();
        ring_.release(batch.picture);
        passes_.release();
        if (!try_alone(batch, job)) {
            cancel(batch);
            job.source.halve(batch.rays, passes_.device.budget());
            return;
        }
    }
    batch.stage = Stage::traced;
}

bool AsynchronousSchedule::try_alone(Batch& batch, const FrameJob& job) {
    if (!acquire_picture(batch, job)) return false;
    batch.drawing.clear();
    if (batch.frame.ray_count == 0) return true;
    upload_frame(batch, unlimited);
    return passes_.partitions().trace_counted(input_of(batch), batch.drawing).has_value();
}

// The batch is drawn: its pixels are copied, and it becomes free.
void AsynchronousSchedule::read_pixels(Batch& batch, const FrameJob& job) {
    batch.stage = Stage::free;
    for (const Event& event : batch.culling) add_time(&PipelineCounts::cull_tiles, event, job.counts);
    ring_.collect(batch.frame, batch.rays, batch.shown(), *batch.picture, job.target);
    job.report(batch.rays);
}

void AsynchronousSchedule::cancel(Batch& batch) {
    batch.stage = Stage::free;
    if (batch.picture) ReadbackRing::cancel(*std::exchange(batch.picture, nullptr));
}

}  // namespace csgrt
