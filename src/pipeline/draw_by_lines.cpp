// A picture's batches by lines (by_lines.hpp). A device, and the bus, stand still whenever the host waits for an answer before it says
// what comes next: therefore two batches are under way, and the pixels of one that is drawn before another is queued.
#include <algorithm>
#include <utility>

#include "pipeline/pipeline.hpp"

namespace csgrt {
namespace {

kernel::ChannelValues background_of(const RenderTarget& target) {
    kernel::ChannelValues background{};
    for (std::size_t p = 0; p < target.planes.size(); ++p) background.of[p] = target.planes[p].background;
    return background;
}

// RayBatches whose lines have memory at a time: those that are drawn, and one that is copied.
constexpr std::size_t lines_in_turn = Device::lanes + 1;

bool is_of_tiles(const RayBatch& batch) { return batch.rays % tile_rays == 0; }

}  // namespace

void Pipeline::put_background(QueuedBatch& queued, const RenderTarget& target) {
    queued.culled.push_back(by_lines_->list.put_background(queued.frame, queued.batch, queued.buffers.costs, background_of(target),
                                                           static_cast<std::uint32_t>(target.planes.size()), queued.lines->buffer));
}

// Has a batch's first kernels run: of first hits all. False: there is no room.
bool Pipeline::queue(QueuedBatch& queued, const Drawing& d, const RayBatch& batch) {
    kernel::Frame frame = d.frame;
    const bool every = frame.every_partition;
    const Rectangle all = lines_of(frame, batch.first_tile(), batch.end_tile());
    frame.first_ray = batch.first;
    frame.ray_count = batch.rays;
    frame.lines = static_cast<std::uint32_t>(all.lines());
    queued.frame = frame;
    queued.batch = batch;
    queued.lines = nullptr;
    const std::vector<std::byte> uploaded = kernels_.frame(frame);
    const auto needed = [&](const RayBatch& t) {
        const std::uint64_t listed = t.tiles() * sizeof(std::uint32_t) + t.tally_bytes();
        return uploaded.size() + listed + cull_bytes(t) + (every ? 0 : t.rays * FirstHits::ray_bytes);
    };
    if (!every) {
        queued.lines = by_lines_->lines.take(all.size() * pixel_bytes_of(d.target), lines_in_turn);
        if (!queued.lines) return false;
    }
    if (needed(batch) > device_.available() + queued.buffers.held()) {
        give_up(queued);
        return false;
    }

    // Of every partition kernels of the batch before may run meanwhile.
    const Device::Lane lane(device_, every ? 1 : by_lines_->lane_of(queued));
    queued.is_under_way = true;
    queued.upload.start<std::byte>(queued.buffers.frame, uploaded);
    queued.culled.clear();
    queued.culled.push_back(cull(frame).launch(buffers_, queued.buffers, frame));
    const std::uint32_t most_in_parts = every ? 0 : TileList::most_in_parts(device_);  // its kernels take whole tiles
    for (Event& event : by_lines_->list.list(batch, queued.buffers, most_in_parts)) queued.culled.push_back(std::move(event));
    queued.answer.start(queued.buffers.tally, every ? sizeof(kernel::BatchReport) : batch.tally_bytes());
    if (!every) {
        PictureLines::wait(*queued.lines);
        put_background(queued, d.target);
        queued.kernels = first_hits().launch(buffers_, queued.buffers, queued.lines->buffer, batch.rays);
    }
    device_.flush();
    return true;
}

// Takes a batch and has its first kernels run. Null: there are no more, or none beside those that are under way.
QueuedBatch* Pipeline::queue_next(const Drawing& d) {
    QueuedBatch* const free = by_lines_->free_batch();
    const bool is_alone = std::ranges::none_of(by_lines_->batches, &QueuedBatch::is_under_way);
    while (free && !d.source.is_empty()) {
        const RayBatch batch = d.source.next();
        if (!is_of_tiles(batch)) {
            if (!is_alone) {
                d.source.give_back(batch);
                return nullptr;
            }
            draw_part_of_tile(d, batch);
            d.tell(batch.rays);
            continue;
        }
        if (queue(*free, d, batch)) return free;
        if (!is_alone) {
            d.source.give_back(batch);
            return nullptr;
        }
        by_lines_->release();
        if (exact_) exact_->release();
        if (queue(*free, d, batch)) return free;
        d.source.halve(batch, device_.budget());
    }
    return nullptr;
}

// Of a batch that is drawn, has the pixels copied.
void Pipeline::put(QueuedBatch& batch, const Drawing& d) {
    batch.is_under_way = false;
    for (const Event& event : batch.culled) d.counts.cull_tiles += milliseconds(event);
    const bool is_last = std::ranges::none_of(by_lines_->batches, &QueuedBatch::is_under_way) && d.source.is_empty();
    by_lines_->lines.put(batch.frame, batch.batch, batch.shown(), *batch.lines, is_last, d.target);
    d.tell(batch.batch.rays);
}

// By the queue of the copies: a read that stands behind kernels would keep all copies waiting for them.
void Pipeline::read_overflown(QueuedBatch& batch) {
    std::vector<std::uint32_t> numbers(batch.tally().overflows);
    wait_for(batch.buffers.overflown.copy_read(numbers.data(), numbers.size() * sizeof(std::uint32_t)));
    by_lines_->overflown.insert(by_lines_->overflown.end(), numbers.begin(), numbers.end());
}

void Pipeline::first_hits_by_lines(const Drawing& d) {
    std::vector<QueuedBatch*> running;
    for (;;) {
        const auto drawn = std::ranges::find_if(running, [](const QueuedBatch* batch) { return is_done(end_of(*batch)); });
        if (drawn != running.end()) {
            QueuedBatch& batch = **drawn;
            running.erase(drawn);
            wait_for(end_of(batch));
            batch.answer.fetch();
            add_times(batch.kernels, d.counts);
            read_overflown(batch);
            put(batch, d);
        } else if (QueuedBatch* const batch = queue_next(d)) {
            running.push_back(batch);
        } else if (running.empty()) {
            break;
        } else if (running.size() == 1 && d.source.is_empty()) {
            wait_for(end_of(*running.front()));
        } else {
            std::vector<const Event*> events;
            for (const QueuedBatch* other : running) events.push_back(&end_of(*other));
            wait_for_one(events);
        }
    }
    draw_exactly(d, std::exchange(by_lines_->overflown, {}));
}

// Has a batch's frame be one of the rays that its list of tiles holds, once that is known. How many there are.
std::uint32_t Pipeline::take_list(QueuedBatch& batch) {
    wait_for(batch.culled.back());
    batch.answer.fetch();
    batch.kernels.clear();
    batch.frame.ray_count = batch.tally().entries * tile_rays;
    return batch.frame.ray_count;
}

// All kernels but the last, when no other batch waits for its own. False: the batch does not fit the memory.
bool Pipeline::weave_alone(QueuedBatch& batch, const Drawing& d) {
    if (!batch.lines) batch.lines = take_lines(batch, d);
    if (!batch.lines) return false;
    batch.kernels.clear();
    if (batch.frame.ray_count == 0) return true;
    batch.frame.candidate_capacity = batch.frame.segment_capacity = batch.frame.word_capacity = COUNT_MAX;
    batch.upload.start<std::byte>(batch.buffers.frame, kernels_.frame(batch.frame));
    const auto needs = exact().weave(buffers_, batch.buffers, batch.frame.ray_count, Rays::tiles, batch.kernels);
    if (needs) batch.room = *needs;
    return needs.has_value();
}

// The last kernel, and what the host wants to know.
void Pipeline::shade(QueuedBatch& batch, const Drawing& d) {
    PictureLines::wait(*batch.lines);
    put_background(batch, d.target);
    if (batch.frame.ray_count > 0) {
        exact().shade(buffers_, batch.buffers, batch.lines->buffer, batch.frame.ray_count, batch.kernels);
        exact().tally(batch.frame.ray_count, batch.kernels);
    }
    batch.answer.start(batch.buffers.tally, batch.batch.tally_bytes());
    device_.flush();
}

// The last kernel of a batch that is drawn.
const Event& Pipeline::end_of(const QueuedBatch& batch) {
    return batch.kernels.empty() ? batch.culled.back() : batch.kernels.back().second;
}

// When a batch is shaded. False: there was no room for what its rays need.
bool Pipeline::settle(QueuedBatch& batch, const Drawing& d) {
    const bool sees = batch.frame.ray_count > 0;
    wait_patiently(end_of(batch));
    batch.answer.fetch();
    if (sees) {
        const kernel::BatchReport& tally = batch.tally();
        const Exact::Needs needs{tally.candidates, tally.total};
        if (!needs.have_room(batch.room)) return false;
        exact().fetch();
        exact().add_needs(needs, batch.frame.ray_count, d.counts);
        exact().add_tallies(d.counts);
        add_times(batch.kernels, d.counts);
    }
    put(batch, d);
    return true;
}

void Pipeline::give_up(QueuedBatch& batch) {
    batch.is_under_way = false;
    if (batch.lines) std::exchange(batch.lines, nullptr)->is_held = false;
}

void Pipeline::give_back(QueuedBatch& batch, const Drawing& d) {
    give_up(batch);
    d.source.give_back(batch.batch);
}

// Of every partition.
PictureLines::Lines* Pipeline::take_lines(const QueuedBatch& batch, const Drawing& d) {
    const std::size_t pixels = lines_of(batch.frame, batch.batch.first_tile(), batch.batch.end_tile()).size();
    return by_lines_->lines.take(pixels * pixel_bytes_of(d.target), lines_in_turn);
}

// Of every partition of a batch: has all kernels run, its memory counted, when no other is under way. False: the source has it in smaller
// batches.
bool Pipeline::draw_alone(QueuedBatch& batch, const Drawing& d) {
    if (!weave_alone(batch, d)) {  // what others took comes before a smaller batch
        by_lines_->release(&batch);
        exact().release();
        if (!weave_alone(batch, d)) {
            give_up(batch);
            d.source.halve(batch.batch, device_.budget());
            return false;
        }
    }
    shade(batch, d);
    return true;
}

// The kernels of a batch are queued while those of the one before run, in what memory there is. Where that does not do, the batch is drawn
// again, what it needs counted first.
void Pipeline::partitions_by_lines(const Drawing& d) {
    QueuedBatch *shaded = nullptr, *next = nullptr;
    const auto settle_last = [&](QueuedBatch* listed) {  // false: it was drawn again, and so is the other to be
        QueuedBatch* const batch = std::exchange(shaded, nullptr);
        if (!batch || settle(*batch, d)) return true;
        device_.finish();
        ++d.counts.drawn_again;
        if (listed) give_back(*listed, d);
        if (draw_alone(*batch, d)) settle(*batch, d);
        return false;
    };
    for (;;) {
        if (!next) {
            if (!settle_last(nullptr)) continue;
            next = queue_next(d);
            if (!next) return;
        }
        QueuedBatch& batch = *std::exchange(next, nullptr);
        const std::uint32_t rays = take_list(batch);
        if (shaded && is_done(end_of(*shaded)) && !settle_last(&batch)) continue;  // its pixels wait for no kernel any more
        std::optional<Exact::Needs> room;
        if (rays > 0) room = exact().capacity_for(rays);
        if (room) {
            batch.frame.candidate_capacity = room->candidates;
            batch.frame.segment_capacity = room->total.segments;
            batch.frame.word_capacity = room->total.words;
            batch.upload.start<std::byte>(batch.buffers.frame, kernels_.frame(batch.frame));
            exact().weave_ahead(buffers_, batch.buffers, rays, *room, batch.kernels);
        }
        if (!settle_last(&batch)) continue;
        if (room) batch.lines = take_lines(batch, d);
        if (room && batch.lines) {
            batch.room = *room;
            shade(batch, d);
        } else if (device_.finish(); !draw_alone(batch, d)) {
            continue;
        }
        shaded = &batch;
        next = queue_next(d);
    }
}

}  // namespace csgrt
