// A tile of a picture, each of the ways: in place, by lines, ray by ray.
#include <algorithm>
#include <utility>

#include "pipeline/pipeline.hpp"

namespace csgrt {
namespace {

std::uint64_t pixel_bytes_of(const RenderTarget& target) { return target.planes.size() * sizeof(float); }

std::uint64_t cull_bytes(const Tile& tile) { return tile.rays * Cull::list_bytes + tile.blocks(); }

kernel::PlaneValues background_of(const RenderTarget& target) {
    kernel::PlaneValues background{};
    for (std::size_t p = 0; p < target.planes.size(); ++p) background.of[p] = target.planes[p].background;
    return background;
}

// A tile of so many rays is so small a part of the picture that memory for several is little for each of its pixels.
bool is_small(const kernel::Frame& frame, std::uint64_t rays) { return std::uint64_t{frame.width} * frame.height >= 8 * rays; }

// How many tiles have memory for their lines at a time: of first hits one that is drawn and those whose pixels are copied, for which
// kernels wait the less the more there are; of every partition, whose kernels take longer, one that is copied.
std::size_t lines_in_turn(const kernel::Frame& frame, const Tile& tile, std::uint64_t largest_tile) {
    const kernel::Window& w = frame.window;
    const std::uint64_t pixels = std::uint64_t{frame.width} * frame.height;
    const bool is_all = std::uint64_t{kernel::width_of(w)} * (w.bottom - w.top) <= tile.rays;
    if (frame.every_partition) return is_small(frame, tile.rays) ? 2 : 1;
    if (is_small(frame, largest_tile)) return std::clamp<std::uint64_t>(pixels / largest_tile / 4, 3, PictureLines::most_lines);
    return is_small(frame, tile.rays) ? 3 : is_all ? 1 : 2;
}

}  // namespace

std::uint64_t Pipeline::bytes_a_ray(const kernel::Frame& frame, const RenderTarget& target) const {
    const std::uint64_t own = frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes;
    const std::uint64_t pictures = by_lines_ ? 2 : 1;  // and what they are drawn with, at a time
    return pictures * (pixel_bytes_of(target) + sizeof(std::uint32_t) + own) + Cull::list_bytes;
}

// Makes the frame's tile one of these rays, or blocks of them.
bool Pipeline::list_rays(kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, std::uint32_t rays_each,
                         std::uint64_t pixel_bytes, std::uint64_t ray_bytes) {
    frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * rays_each;
    frame.picked = rays_each == 1;
    if (numbers.empty()) return false;
    const std::uint64_t picture = frame.ray_count * pixel_bytes, list = numbers.size() * sizeof(std::uint32_t);
    make_room(picture + list + frame.ray_count * ray_bytes,
              std::min<std::uint64_t>(picture, picture_.size()) + std::min<std::uint64_t>(list, tile_.rays.size()));
    picture_.reserve(picture);
    list_upload_.start<std::uint32_t>(tile_.rays, numbers);
    upload(frame);
    return true;
}

// What the last tiles' pixels took comes before a smaller tile.
bool Pipeline::weave(const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts) {
    if (exact().weave(buffers_, tile, rays, kind, counts, [&] { put_drawn(); })) return true;
    if (!by_lines_ || by_lines_->held() == 0) return false;
    const auto own = std::find_if(by_lines_->tiles.begin(), by_lines_->tiles.end(),
                                  [&](const QueuedTile& queued) { return &queued.buffers == &tile; });
    release_lines(own == by_lines_->tiles.end() ? nullptr : &*own);
    return exact().weave(buffers_, tile, rays, kind, counts);
}

// False: the tile does not fit the memory.
bool Pipeline::draw_in_place(kernel::Frame frame, const Tile& tile, const RenderTarget& target, PipelineCounts& counts) {
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    make_room(cull_bytes(tile), tile_.costs.size() + tile_.lists.size());
    upload(frame);
    const Event culled = cull(frame).launch(buffers_, tile_, frame);
    const std::vector<std::uint32_t> seen = Cull::seen(tile, tile_);
    counts.cull_blocks += milliseconds(culled);

    const std::uint64_t pixel_bytes = pixel_bytes_of(target);
    const bool sees =
        list_rays(frame, seen, block_rays, pixel_bytes, frame.every_partition ? Exact::ray_bytes : FirstHits::ray_bytes);
    std::vector<std::uint32_t> overflown;
    if (sees && frame.every_partition) {
        if (!weave(tile_, frame.ray_count, Rays::blocks, counts)) return false;
        exact().shade(buffers_, tile_, picture_, frame.ray_count);
        exact().settle(frame.ray_count, true, counts);
    } else if (sees) {
        tile_.tally.reserve(sizeof(kernel::TileTally));
        tile_.tally.queue_fill(0, sizeof(kernel::TileTally));
        const Event drawn = first_hits().launch(buffers_, tile_, picture_, frame.ray_count);
        const std::uint32_t overflows = tile_.tally.read<kernel::TileTally>(1).front().overflows;
        overflown = tile_.overflown.read<std::uint32_t>(overflows);
        counts.first_hits += milliseconds(drawn);
    }
    {
        const Buffer::Mapping picture = picture_.map(seen.size() * block_rays * pixel_bytes);
        put_blocks(frame, tile.first_block(), tile.end_block(), seen, static_cast<const float*>(picture.data()), target);
    }
    draw_exactly(frame, overflown, target, counts);
    return true;
}

void Pipeline::put_background(QueuedTile& queued, const RenderTarget& target) {
    queued.culled.push_back(by_lines_->list.put_background(queued.frame, queued.tile, queued.buffers.costs, background_of(target),
                                                           static_cast<std::uint32_t>(target.planes.size()), queued.lines->buffer));
}

// Has a tile's first kernels run: of first hits all. `before`: the tile that runs, if one does. False: there is no room.
bool Pipeline::queue(QueuedTile& queued, kernel::Frame frame, const Tile& tile, const RenderTarget& target,
                     const QueuedTile* before) {
    const bool every = frame.every_partition;
    const Rectangle all = lines_of(frame, tile.first_block(), tile.end_block());
    frame.first_ray = tile.first;
    frame.ray_count = tile.rays;
    frame.lines = static_cast<std::uint32_t>(all.lines());
    queued.frame = frame;
    queued.tile = tile;
    const std::vector<std::byte> uploaded = kernels_.frame(frame);
    const auto needed = [&](const Tile& t) {
        const std::uint64_t listed = t.blocks() * sizeof(std::uint32_t) + t.tally_bytes();
        return uploaded.size() + listed + cull_bytes(t) + (every ? 0 : t.rays * FirstHits::ray_bytes);
    };
    // Of first hits in many tiles, where there is plenty, room for the largest: they differ from frame to frame, and new memory takes
    // longer than a tile.
    const Tile largest{0, static_cast<std::uint32_t>(std::max<std::uint64_t>(tile.rays, largest_tile(frame)))};
    const std::size_t count = lines_in_turn(frame, tile, largest.rays), across = kernel::blocks_across(frame.window);
    const std::size_t end = std::min<std::size_t>(largest.blocks() + across, across * kernel::blocks_down(frame.window));
    const std::uint64_t most_lines = lines_of(frame, 0, static_cast<std::uint32_t>(end)).size() * pixel_bytes_of(target);
    const std::uint64_t of_all = count * most_lines + by_lines_->tiles.size() * needed(largest);
    const bool is_plenty = !every && is_small(frame, largest.rays) && most_lines <= device_.max_buffer() &&
                           2 * of_all <= device_.available() + by_lines_->held();
    const PictureLines::Lines* const held = before ? before->lines : nullptr;
    queued.lines = by_lines_->lines.next(is_plenty ? most_lines : all.size() * pixel_bytes_of(target), count, held, every);
    if (!queued.lines) return false;
    if (needed(tile) > device_.available() + queued.buffers.held()) return false;
    if (is_plenty && needed(largest) <= device_.available() + queued.buffers.held()) {
        queued.buffers.reserve(largest, FirstHits::ray_bytes);
        cull(frame).reserve(queued.buffers, frame, largest.rays);
    }

    const Device::Lane lane(device_, every ? 0 : queued.lane);
    queued.upload.start<std::byte>(queued.buffers.frame, uploaded);
    queued.culled.clear();
    queued.culled.push_back(cull(frame).launch(buffers_, queued.buffers, frame));
    const std::uint32_t most_in_parts = every ? 0 : BlockList::most_in_parts(device_);  // its kernels take whole blocks
    for (Event& event : by_lines_->list.list(tile, queued.buffers, most_in_parts)) queued.culled.push_back(std::move(event));
    queued.answer.start(queued.buffers.tally, every ? sizeof(kernel::TileTally) : tile.tally_bytes());
    if (!every) {
        PictureLines::wait(*queued.lines);
        put_background(queued, target);
        queued.drawn = first_hits().launch(buffers_, queued.buffers, queued.lines->buffer, tile.rays);
    }
    device_.flush();
    return true;
}

// Every partition of a queued tile. False: it does not fit the memory.
bool Pipeline::weave_queued(QueuedTile& queued, const RenderTarget& target, PipelineCounts& counts) {
    const std::uint32_t rays = queued.tally().entries * block_rays;
    if (rays > 0) {
        queued.frame.ray_count = rays;
        queued.upload.start<std::byte>(queued.buffers.frame, kernels_.frame(queued.frame));
        if (!weave(queued.buffers, rays, Rays::blocks, counts)) return false;
    }
    put_drawn();
    PictureLines::wait(*queued.lines);
    put_background(queued, target);
    if (rays > 0) {
        exact().shade(buffers_, queued.buffers, queued.lines->buffer, rays);
        exact().tally(rays);
    }
    queued.answer.start(queued.buffers.tally, queued.tile.tally_bytes());
    device_.flush();
    return true;
}

// False: the tile does not fit the memory. A device, and the bus, stand still whenever the host waits for an answer before it says what
// comes next: therefore this tile is queued before the host looks at what has become of the one before, whose pixels are on their way
// before the next is queued; of every partition that waits until most of this one's kernels run.
bool Pipeline::draw_by_lines(const kernel::Frame& frame, const Tile& tile, const Tile& next, const RenderTarget& target,
                             PipelineCounts& counts) {
    ByLines& by = *by_lines_;
    QueuedTile& own = by.tiles[by.next];
    const bool every = frame.every_partition;
    const std::optional<Tile> ahead = std::exchange(by.ahead, {});
    if (ahead != tile) {
        if (ahead) device_.finish();  // what was queued in vain holds lines of its own
        put_drawn();
        draw_overflown(frame, target, counts);
        if (!queue(own, frame, tile, target, nullptr)) {
            release_lines();
            if (exact_) exact_->release();
            if (!queue(own, frame, tile, target, nullptr)) return false;
        }
    }
    if (every && !weave_queued(own, target, counts)) return false;
    by.next = (by.next + 1) % by.tiles.size();
    QueuedTile& other = by.tiles[by.next];
    const bool has_next = next.rays > 0 && next.rays % block_rays == 0;
    if (!every) put_drawn();
    if (has_next && queue(other, frame, next, target, &own)) by.ahead = next;
    if (every) {
        device_.finish();
    } else {
        by.ahead ? wait_patiently(own.drawn) : wait_for(own.drawn);
    }
    if (every && by.ahead) other.answer.fetch();  // for which its kernels wait
    own.answer.fetch();
    if (every) exact().fetch();
    by.drawn = {&own, target, next.rays == 0, &counts};
    if (by.ahead) return true;  // the rest while the next one's kernels run
    put_drawn();
    draw_overflown(frame, target, counts);
    return true;
}

// Gives back what tiles by lines take, but for `but`, once what is drawn is in the picture.
void Pipeline::release_lines(const QueuedTile* but) {
    put_drawn();
    by_lines_->release(but);
}

// By the queue of the copies: a read that stands behind kernels would keep all copies waiting for them.
void Pipeline::read_overflown(QueuedTile& tile) {
    std::vector<std::uint32_t> numbers(tile.tally().overflows);
    wait_for(tile.buffers.overflown.copy_read(numbers.data(), numbers.size() * sizeof(std::uint32_t)));
    by_lines_->overflown.insert(by_lines_->overflown.end(), numbers.begin(), numbers.end());
}

// Takes the answers of a tile that is drawn, and has its pixels copied, if one waits for that.
void Pipeline::put_drawn() {
    if (!by_lines_ || !by_lines_->drawn.tile) return;
    const ByLines::Drawn drawn = std::exchange(by_lines_->drawn, {});
    QueuedTile& tile = *drawn.tile;
    PipelineCounts& counts = *drawn.counts;
    const bool every = tile.frame.every_partition;
    for (const Event& event : tile.culled) counts.cull_blocks += milliseconds(event);
    if (!every) {
        counts.first_hits += milliseconds(tile.drawn);
        read_overflown(tile);
    } else if (tile.tally().entries > 0) {
        exact().add_tallies(counts);
        exact().add_times(counts);
    }
    by_lines_->lines.put(tile.frame, tile.tile, tile.shown(), *tile.lines, drawn.is_last, drawn.target);
}

// The rays without room of tiles that are put, when no other tile runs, whose memory they may want.
void Pipeline::draw_overflown(const kernel::Frame& frame, const RenderTarget& target, PipelineCounts& counts) {
    draw_exactly(frame, std::exchange(by_lines_->overflown, {}), target, counts);
}

// Rays of a picture the exact way, one by one.
void Pipeline::draw_exactly(kernel::Frame frame, const std::vector<std::uint32_t>& numbers, const RenderTarget& target,
                            PipelineCounts& counts) {
    const std::uint64_t pixel_bytes = pixel_bytes_of(target), bytes = pixel_bytes + sizeof(std::uint32_t) + Exact::ray_bytes;
    if (!numbers.empty() && by_lines_) {  // what comes in whole blocks comes before
        put_drawn();
        by_lines_->lines.finish();
    }
    for_each_tile({0, numbers.size()}, fitting(bytes), first_rays, nullptr, [&](const Tile& tile, const Tile&) {
        const auto begin = numbers.begin() + tile.first;
        const std::vector<std::uint32_t> picked(begin, begin + tile.rays);
        list_rays(frame, picked, 1, pixel_bytes, Exact::ray_bytes);
        if (!weave(tile_, frame.ray_count, Rays::picked, counts)) return false;
        exact().shade(buffers_, tile_, picture_, frame.ray_count);
        const Buffer::Mapping picture = picture_.map(picked.size() * pixel_bytes);
        put_rays(frame, picked, static_cast<const float*>(picture.data()), target);
        exact().settle(tile.rays, frame.every_partition, counts);
        return true;
    });
}

}  // namespace csgrt
