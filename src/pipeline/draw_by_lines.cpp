// A picture's tiles by lines (by_lines.hpp). A device, and the bus, stand still whenever the host waits for an answer before it says
// what comes next: therefore two tiles are under way, and the pixels of one that is drawn before another is queued.
#include <algorithm>
#include <utility>

#include "pipeline/pipeline.hpp"

namespace csgrt {
namespace {

kernel::PlaneValues background_of(const RenderTarget& target) {
    kernel::PlaneValues background{};
    for (std::size_t p = 0; p < target.planes.size(); ++p) background.of[p] = target.planes[p].background;
    return background;
}

// Tiles whose lines have memory at a time: those that are drawn, and one that is copied.
constexpr std::size_t lines_in_turn = Device::lanes + 1;

bool is_of_blocks(const Tile& tile) { return tile.rays % block_rays == 0; }

}  // namespace

void Pipeline::put_background(QueuedTile& queued, const RenderTarget& target) {
    queued.culled.push_back(by_lines_->list.put_background(queued.frame, queued.tile, queued.buffers.costs, background_of(target),
                                                           static_cast<std::uint32_t>(target.planes.size()), queued.lines->buffer));
}

// Has a tile's first kernels run: of first hits all. False: there is no room.
bool Pipeline::queue(QueuedTile& queued, const Drawing& d, const Tile& tile) {
    kernel::Frame frame = d.frame;
    const bool every = frame.every_partition;
    const Rectangle all = lines_of(frame, tile.first_block(), tile.end_block());
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    frame.lines = static_cast<std::uint32_t>(all.lines());
    queued.frame = frame;
    queued.tile = tile;
    queued.lines = nullptr;
    const std::vector<std::byte> uploaded = kernels_.frame(frame);
    const auto needed = [&](const Tile& t) {
        const std::uint64_t listed = t.blocks() * sizeof(std::uint32_t) + t.tally_bytes();
        return uploaded.size() + listed + cull_bytes(t) + (every ? 0 : t.rays * FirstHits::ray_bytes);
    };
    if (!every) {
        queued.lines = by_lines_->lines.take(all.size() * pixel_bytes_of(d.target), lines_in_turn);
        if (!queued.lines) return false;
    }
    if (needed(tile) > device_.available() + queued.buffers.held()) {
        give_up(queued);
        return false;
    }

    // Of every partition kernels of the tile before may run meanwhile.
    const Device::Lane lane(device_, every ? 1 : by_lines_->lane_of(queued));
    queued.is_under_way = true;
    queued.upload.start<std::byte>(queued.buffers.frame, uploaded);
    queued.culled.clear();
    queued.culled.push_back(cull(frame).launch(buffers_, queued.buffers, frame));
    const std::uint32_t most_in_parts = every ? 0 : BlockList::most_in_parts(device_);  // its kernels take whole blocks
    for (Event& event : by_lines_->list.list(tile, queued.buffers, most_in_parts)) queued.culled.push_back(std::move(event));
    queued.answer.start(queued.buffers.tally, every ? sizeof(kernel::TileTally) : tile.tally_bytes());
    if (!every) {
        PictureLines::wait(*queued.lines);
        put_background(queued, d.target);
        queued.kernels = first_hits().launch(buffers_, queued.buffers, queued.lines->buffer, tile.rays);
    }
    device_.flush();
    return true;
}

// Takes a tile and has its first kernels run. Null: there are no more, or none beside those that are under way.
QueuedTile* Pipeline::queue_next(const Drawing& d) {
    QueuedTile* const free = by_lines_->free_tile();
    const bool is_alone = std::ranges::none_of(by_lines_->tiles, &QueuedTile::is_under_way);
    while (free && !d.source.is_empty()) {
        const Tile tile = d.source.next();
        if (!is_of_blocks(tile)) {
            if (!is_alone) {
                d.source.give_back(tile);
                return nullptr;
            }
            draw_part_of_block(d, tile);
            d.tell(tile.rays);
            continue;
        }
        if (queue(*free, d, tile)) return free;
        if (!is_alone) {
            d.source.give_back(tile);
            return nullptr;
        }
        by_lines_->release();
        if (exact_) exact_->release();
        if (queue(*free, d, tile)) return free;
        d.source.halve(tile, device_.budget());
    }
    return nullptr;
}

// Of a tile that is drawn, has the pixels copied.
void Pipeline::put(QueuedTile& tile, const Drawing& d) {
    tile.is_under_way = false;
    for (const Event& event : tile.culled) d.counts.cull_blocks += milliseconds(event);
    const bool is_last = std::ranges::none_of(by_lines_->tiles, &QueuedTile::is_under_way) && d.source.is_empty();
    by_lines_->lines.put(tile.frame, tile.tile, tile.shown(), *tile.lines, is_last, d.target);
    d.tell(tile.tile.rays);
}

// By the queue of the copies: a read that stands behind kernels would keep all copies waiting for them.
void Pipeline::read_overflown(QueuedTile& tile) {
    std::vector<std::uint32_t> numbers(tile.tally().overflows);
    wait_for(tile.buffers.overflown.copy_read(numbers.data(), numbers.size() * sizeof(std::uint32_t)));
    by_lines_->overflown.insert(by_lines_->overflown.end(), numbers.begin(), numbers.end());
}

void Pipeline::first_hits_by_lines(const Drawing& d) {
    std::vector<QueuedTile*> running;
    for (;;) {
        const auto drawn = std::ranges::find_if(running, [](const QueuedTile* tile) { return is_done(end_of(*tile)); });
        if (drawn != running.end()) {
            QueuedTile& tile = **drawn;
            running.erase(drawn);
            wait_for(end_of(tile));
            tile.answer.fetch();
            add_times(tile.kernels, d.counts);
            read_overflown(tile);
            put(tile, d);
        } else if (QueuedTile* const tile = queue_next(d)) {
            running.push_back(tile);
        } else if (running.empty()) {
            break;
        } else if (running.size() == 1 && d.source.is_empty()) {
            wait_for(end_of(*running.front()));
        } else {
            std::vector<const Event*> events;
            for (const QueuedTile* other : running) events.push_back(&end_of(*other));
            wait_for_one(events);
        }
    }
    draw_exactly(d, std::exchange(by_lines_->overflown, {}));
}

// Has a tile's frame be one of the rays that its list of blocks holds, once that is known. How many there are.
std::uint32_t Pipeline::take_list(QueuedTile& tile) {
    wait_for(tile.culled.back());
    tile.answer.fetch();
    tile.kernels.clear();
    tile.frame.ray_count = tile.tally().entries * block_rays;
    return tile.frame.ray_count;
}

// All kernels but the last, when no other tile waits for its own. False: the tile does not fit the memory.
bool Pipeline::weave_alone(QueuedTile& tile, const Drawing& d) {
    if (!tile.lines) tile.lines = take_lines(tile, d);
    if (!tile.lines) return false;
    tile.kernels.clear();
    if (tile.frame.ray_count == 0) return true;
    tile.frame.candidate_capacity = tile.frame.segment_capacity = tile.frame.word_capacity = COUNT_MAX;
    tile.upload.start<std::byte>(tile.buffers.frame, kernels_.frame(tile.frame));
    const auto needs = exact().weave(buffers_, tile.buffers, tile.frame.ray_count, Rays::blocks, tile.kernels);
    if (needs) tile.room = *needs;
    return needs.has_value();
}

// The last kernel, and what the host wants to know.
void Pipeline::shade(QueuedTile& tile, const Drawing& d) {
    PictureLines::wait(*tile.lines);
    put_background(tile, d.target);
    if (tile.frame.ray_count > 0) {
        exact().shade(buffers_, tile.buffers, tile.lines->buffer, tile.frame.ray_count, tile.kernels);
        exact().tally(tile.frame.ray_count, tile.kernels);
    }
    tile.answer.start(tile.buffers.tally, tile.tile.tally_bytes());
    device_.flush();
}

// The last kernel of a tile that is drawn.
const Event& Pipeline::end_of(const QueuedTile& tile) {
    return tile.kernels.empty() ? tile.culled.back() : tile.kernels.back().second;
}

// When a tile is shaded. False: there was no room for what its rays need.
bool Pipeline::settle(QueuedTile& tile, const Drawing& d) {
    const bool sees = tile.frame.ray_count > 0;
    wait_patiently(end_of(tile));
    tile.answer.fetch();
    if (sees) {
        const kernel::TileTally& tally = tile.tally();
        const Exact::Needs needs{tally.candidates, tally.total};
        if (!needs.have_room(tile.room)) return false;
        exact().fetch();
        exact().add_needs(needs, tile.frame.ray_count, d.counts);
        exact().add_tallies(d.counts);
        add_times(tile.kernels, d.counts);
    }
    put(tile, d);
    return true;
}

void Pipeline::give_up(QueuedTile& tile) {
    tile.is_under_way = false;
    if (tile.lines) std::exchange(tile.lines, nullptr)->is_held = false;
}

void Pipeline::give_back(QueuedTile& tile, const Drawing& d) {
    give_up(tile);
    d.source.give_back(tile.tile);
}

// Of every partition.
PictureLines::Lines* Pipeline::take_lines(const QueuedTile& tile, const Drawing& d) {
    const std::size_t pixels = lines_of(tile.frame, tile.tile.first_block(), tile.tile.end_block()).size();
    return by_lines_->lines.take(pixels * pixel_bytes_of(d.target), lines_in_turn);
}

// Of every partition of a tile: has all kernels run, its memory counted, when no other is under way. False: the source has it in smaller
// tiles.
bool Pipeline::draw_alone(QueuedTile& tile, const Drawing& d) {
    if (!weave_alone(tile, d)) {  // what others took comes before a smaller tile
        by_lines_->release(&tile);
        exact().release();
        if (!weave_alone(tile, d)) {
            give_up(tile);
            d.source.halve(tile.tile, device_.budget());
            return false;
        }
    }
    shade(tile, d);
    return true;
}

// The kernels of a tile are queued while those of the one before run, in what memory there is. Where that does not do, the tile is drawn
// again, what it needs counted first.
void Pipeline::partitions_by_lines(const Drawing& d) {
    QueuedTile *shaded = nullptr, *next = nullptr;
    const auto settle_last = [&](QueuedTile* listed) {  // false: it was drawn again, and so is the other to be
        QueuedTile* const tile = std::exchange(shaded, nullptr);
        if (!tile || settle(*tile, d)) return true;
        device_.finish();
        ++d.counts.drawn_again;
        if (listed) give_back(*listed, d);
        if (draw_alone(*tile, d)) settle(*tile, d);
        return false;
    };
    for (;;) {
        if (!next) {
            if (!settle_last(nullptr)) continue;
            next = queue_next(d);
            if (!next) return;
        }
        QueuedTile& tile = *std::exchange(next, nullptr);
        const std::uint32_t rays = take_list(tile);
        if (shaded && is_done(end_of(*shaded)) && !settle_last(&tile)) continue;  // its pixels wait for no kernel any more
        std::optional<Exact::Needs> room;
        if (rays > 0) room = exact().capacity_for(rays);
        if (room) {
            tile.frame.candidate_capacity = room->candidates;
            tile.frame.segment_capacity = room->total.segments;
            tile.frame.word_capacity = room->total.words;
            tile.upload.start<std::byte>(tile.buffers.frame, kernels_.frame(tile.frame));
            exact().weave_ahead(buffers_, tile.buffers, rays, *room, tile.kernels);
        }
        if (!settle_last(&tile)) continue;
        if (room) tile.lines = take_lines(tile, d);
        if (room && tile.lines) {
            tile.room = *room;
            shade(tile, d);
        } else if (device_.finish(); !draw_alone(tile, d)) {
            continue;
        }
        shaded = &tile;
        next = queue_next(d);
    }
}

}  // namespace csgrt
