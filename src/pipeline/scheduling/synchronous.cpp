#include "pipeline/scheduling/synchronous.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "device/discovery.hpp"

namespace csgrt {

/// Calls `work` with each batch of the source. If `work` returns false, the batch does not fit the memory and is
/// halved. A driver's kernels cannot be stopped on a processor, so its batches are so small that a call can end soon
/// between two batches.
template <class Work>
void SynchronousSchedule::for_each_batch(BatchSource& source, const Work& work) {
    const Device& device = passes_.device;
    const bool is_paced = device.may_end() && device.info().type == "cpu" && !is_native(device.info());
    constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
    for (;;) {
        const auto start = Clock::now();
        const RayBatch batch = source.next(is_paced ? batch_size_.rays() : any);
        if (batch.rays == 0) return;
        seen_ = batch.rays;
        if (!work(batch)) source.halve(batch, device.budget());
        batch_size_.add(seen_, milliseconds_since(start));
    }
}

SynchronousSchedule::SynchronousSchedule(DevicePasses& passes, std::function<DeviceMemory()> memory,
                                         std::function<bool()> reclaim)
    : passes_(passes),
      memory_(std::move(memory)),
      reclaim_(std::move(reclaim)),
      batch_(passes.device),
      picture_(passes.device, "picture") {}

// Frees memory that is not in use if `bytes` are not available. `reused`: how many of these bytes the schedule has
// already.
void SynchronousSchedule::make_room(std::uint64_t bytes, std::uint64_t reused) {
    if (bytes <= passes_.device.available() + reused) return;
    batch_.release_lists();
    reclaim_();
    passes_.release();
}

void SynchronousSchedule::start_work(kernel::Frame& frame, Work work, std::span<const std::uint32_t> numbers,
                                     std::uint64_t pixel_bytes, std::uint64_t ray_bytes) {
    Buffer& list = work == Work::tiles ? batch_.tiles : batch_.pixels;
    frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * (work == Work::tiles ? tile_rays : 1);
    frame.work = static_cast<std::uint32_t>(work);
    const std::uint64_t picture = frame.ray_count * pixel_bytes, list_bytes = numbers.size_bytes();
    make_room(picture + list_bytes + frame.ray_count * ray_bytes,
              std::min<std::uint64_t>(picture, picture_.size()) + std::min<std::uint64_t>(list_bytes, list.size()));
    picture_.reserve(picture);
    list_upload_.start<std::uint32_t>(list, numbers);
    upload(frame);
}

// Memory that others keep for later is given up before the batch is halved.
std::optional<PartitionSizes> SynchronousSchedule::trace(const PartitionPass::Input& input, TimedKernels& timed) {
    if (auto sizes = passes_.partitions().trace_counted(input, timed)) return sizes;
    if (!reclaim_()) return {};
    return passes_.partitions().trace_counted(input, timed);
}

void SynchronousSchedule::finish_trace(std::uint32_t rays, bool are_tallied, TimedKernels& timed,
                                       PipelineCounts& counts) {
    PartitionPass& pass = passes_.partitions();
    if (are_tallied) pass.sum_tallies(rays, timed);
    passes_.device.finish();
    pass.copy_tallies();
    if (are_tallied) pass.add_tallies(counts);
    add_times(timed, counts);
}

void SynchronousSchedule::render(const FrameJob& job) {
    for_each_batch(job.source, [&](const RayBatch& batch) {
        if (!batch.is_whole_tiles())
            draw_part_of_tile(job, batch);
        else if (!draw_tiles(job, batch))
            return false;
        job.report(batch);
        return true;
    });
}

// Draws a batch. Returns false if the batch does not fit the memory.
bool SynchronousSchedule::draw_tiles(const FrameJob& job, const RayBatch& batch) {
    kernel::Frame frame = job.frame;
    frame.first_ray = batch.first;
    frame.ray_count = batch.rays;
    make_room(CullPass::bytes(batch.rays), batch_.costs.size() + batch_.tile_nodes.size());
    upload(frame);
    const Event culled = passes_.cull(frame).launch(*passes_.tables, batch_, frame);
    const std::vector<std::uint32_t> seen = CullPass::seen(batch, batch_);
    add_time(&PipelineCounts::cull_tiles, culled, job.counts);

    const std::uint64_t pixel_bytes = job.shape().pixel_bytes;
    std::vector<std::uint32_t> overflown;
    if (!seen.empty()) {
        start_work(frame, Work::tiles, seen, pixel_bytes,
                   frame.every_partition ? PartitionMemory::ray_bytes : FirstHitPass::ray_bytes);
        if (!frame.every_partition)
            draw_first_hits(job, frame.ray_count, overflown);
        else if (!draw_partitions(job, Work::tiles, frame.ray_count, true))
            return false;
    }
    {
        const Buffer::Mapping picture = picture_.map(seen.size() * tile_rays * pixel_bytes);
        put_tiles(frame, batch.first_tile(), batch.end_tile(), seen, static_cast<const float*>(picture.data()),
                  job.target);
    }
    draw_pixels(job, overflown);
    seen_ = seen.size() * tile_rays;
    return true;
}

void SynchronousSchedule::draw_first_hits(const FrameJob& job, std::uint32_t rays,
                                          std::vector<std::uint32_t>& overflown) {
    batch_.report.reserve(sizeof(kernel::BatchReport));
    batch_.report.queue_fill(0, sizeof(kernel::BatchReport));
    const TimedKernels timed = passes_.first_hits().launch(*passes_.tables, batch_, picture_, rays);
    overflown = batch_.overflown.read<std::uint32_t>(batch_.report.read<kernel::BatchReport>(1).front().overflows);
    add_times(timed, job.counts);
}

bool SynchronousSchedule::draw_partitions(const FrameJob& job, Work work, std::uint32_t rays, bool are_tallied) {
    PartitionPass& pass = passes_.partitions();
    const PartitionPass::Input input{*passes_.tables, batch_, work, rays};
    TimedKernels timed;
    const auto sizes = trace(input, timed);
    if (!sizes) return false;
    pass.shade(input, picture_, timed);
    pass.add_sizes(*sizes, rays, job.counts);
    finish_trace(rays, are_tallied, timed, job.counts);
    return true;
}

void SynchronousSchedule::draw_pixels(const FrameJob& job, std::span<const std::uint32_t> numbers) {
    const std::uint64_t pixel_bytes = job.shape().pixel_bytes;
    const std::uint64_t ray_bytes = pixel_bytes + sizeof(std::uint32_t) + PartitionMemory::ray_bytes;
    const auto take = [left = RayNumbers{0, numbers.size()}]() mutable { return std::exchange(left, RayNumbers{}); };
    BatchSource source(
        take, [&] { return rays_fitting(memory_(), ray_bytes); }, 0);
    for_each_batch(source, [&](const RayBatch& batch) {
        const auto some = numbers.subspan(batch.first, batch.rays);
        kernel::Frame frame = job.frame;
        start_work(frame, Work::pixels, some, pixel_bytes, PartitionMemory::ray_bytes);
        if (!draw_partitions(job, Work::pixels, batch.rays, frame.every_partition)) return false;
        const Buffer::Mapping picture = picture_.map(some.size() * pixel_bytes);
        put_rays(frame, some, static_cast<const float*>(picture.data()), job.target);
        return true;
    });
}

void SynchronousSchedule::draw_part_of_tile(const FrameJob& job, const RayBatch& batch) {
    std::vector<std::uint32_t> numbers(batch.rays);
    std::iota(numbers.begin(), numbers.end(), batch.first);
    draw_pixels(job, numbers);
}

// Uploads the rays of a batch, whose frame is uploaded already.
void SynchronousSchedule::upload_rays(const RayList& rays, const RayBatch& batch) {
    const std::size_t bytes = passes_.records().ray_bytes();
    wait_until_done(rays_upload_);  // of a call that threw
    batch_.rays.reserve(batch.rays * bytes);
    if (rays.is_grid() && passes_.records().wide_bytes() == sizeof(double)) {
        rays_upload_ = passes_.partitions().make_rays(batch_, batch.rays, rays.range());
        return;
    }
    if (!staged_rays_ || staged_rays_->size() < batch.rays * bytes) {
        staged_rays_.reset();
        staged_rays_.emplace(passes_.device, "rays", batch.rays * bytes);
    }
    auto* const staged = static_cast<std::byte*>(staged_rays_->data());
    for_chunks(batch.rays, 4096, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        std::array<kernel::RayRecord, 128> records;
        for (; first < last; first += records.size()) {
            const std::span some = std::span(records).first(std::min(records.size(), last - first));
            rays.fill(batch.first + first, some);
            passes_.records().check(some, batch.first + first);
            passes_.records().write_rays(some, staged + first * bytes);
        }
    });
    rays_upload_ = batch_.rays.queue_upload(staged, batch.rays * bytes);
}

// While a batch's rows are copied, the next batch is traced.
void SynchronousSchedule::trace_list(const kernel::Frame& list, const RayList& rays, BatchSource& source,
                                     RowReceiver& receiver, const ReportDone& report_done, PipelineCounts& counts) {
    PartitionPass& pass = passes_.partitions();
    RayBatch copied;
    const auto take_copied = [&] {
        if (!pass.rows().is_underway()) return;
        receiver.put(pass.rows().wait());
        if (report_done) report_done(copied.rays);
    };
    pass.rows().cancel();  // of a call that threw
    picture_.release();
    for_each_batch(source, [&](const RayBatch& batch) {
        make_room(batch.rays * listed_ray_bytes(), batch_.rays.size());
        kernel::Frame frame = list;
        frame.ray_count = batch.rays;
        frame.first_ray = static_cast<std::uint32_t>(rays.first() + batch.first);
        upload(frame);
        upload_rays(rays, batch);
        TimedKernels timed;
        const PartitionPass::Input input{*passes_.tables, batch_, Work::rays, batch.rays};
        const auto sizes = trace(input, timed);
        take_copied();
        if (!sizes || !pass.write_rows(input, batch.first, receiver.fields(), timed)) return false;
        pass.add_sizes(*sizes, batch.rays, counts);
        finish_trace(batch.rays, true, timed, counts);
        wait_for(rays_upload_);
        pass.start_copy();
        counts.overlaps += pass.rows().overlaps();
        copied = batch;
        ++counts.batches;
        counts.done.push_back(batch);
        return true;
    });
    take_copied();
}

}  // namespace csgrt
