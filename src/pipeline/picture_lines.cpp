#include "pipeline/picture_lines.hpp"

#include <algorithm>
#include <span>
#include <system_error>
#include <utility>

#include "kernel_geometry.hpp"
#include "pipeline/known_picture.hpp"

namespace csgrt {

namespace {

kernel::PlaneValues background_of(const RenderTarget& target) {
    kernel::PlaneValues background{};
    for (std::size_t p = 0; p < target.planes.size(); ++p) background.of[p] = target.planes[p].background;
    return background;
}

}  // namespace

PictureLines::PictureLines(Device& device)
    : device_(device), places_(device, "places of blocks"), extents_(device, "extents of rows"), read_(device, "extents of rows"),
      lines_{Lines{Buffer(device, "lines"), {}}, Lines{Buffer(device, "lines"), {}}} {}

void PictureLines::build() {
    program_.emplace(device_, assemble_program({"picture_lines.cl"}));
    find_shown_.emplace(program_->kernel("find_shown"));
    put_lines_.emplace(program_->kernel("put_lines"));
    copies_.emplace(device_);
}

bool PictureLines::has_room(const Buffer& buffer, std::uint64_t bytes) const {
    return bytes <= buffer.size() || bytes <= std::min(device_.available() + buffer.size(), device_.max_buffer());
}

void PictureLines::look(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::uint32_t drawn,
                        const TileBuffers& tile, const RenderTarget& target) {
    has_looked_ = false;
    read_.forget();
    const std::size_t extents_bytes = 2 * rows_of(frame, first, end) * sizeof(cl_uint);
    const std::size_t places_bytes = (end - first) * sizeof(cl_uint);
    if (target.planes.empty() || !has_room(places_, places_bytes)) return;
    places_.reserve(places_bytes);
    if (!has_room(extents_, extents_bytes)) return;
    extents_.reserve(extents_bytes);
    places_.queue_fill(NONE, places_bytes);
    has_looked_ = true;
    if (drawn == 0) return;
    extents_.queue_fill(0, extents_bytes);
    shown_ = find_shown_->launch(std::size_t{drawn} * block_rays, block_rays, cl_uint{frame.width}, cl_uint{frame.height},
                                  static_cast<cl_uint>(target.planes.size()), background_of(target), cl_uint{first}, tile.rays,
                                  tile.picture, places_, extents_);
    read_.start(extents_, extents_bytes);
    device_.flush();
}

bool PictureLines::put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::uint32_t drawn,
                              const TileBuffers& tile, bool is_last, const RenderTarget& target) {
    if (target.planes.empty()) return true;
    if (!std::exchange(has_looked_, false)) return false;
    const auto planes = static_cast<cl_uint>(target.planes.size());
    std::vector<std::uint32_t> extents(2 * rows_of(frame, first, end), 0);
    if (drawn > 0) {
        std::ranges::copy(read_.wait<std::uint32_t>(extents.size()), extents.begin());
        wait_for(shown_);  // the read does not tell if it failed
    }
    std::vector<Rectangle> rectangles = find_rectangles(frame, first, end, extents, target);
    std::size_t floats = 0;
    for (Rectangle& r : rectangles) {  // a copy by lines begins with one
        r.begin = (floats + r.columns() - 1) / r.columns() * r.columns();
        floats = r.begin + r.size() * planes;
    }
    if (floats > 0) {
        const std::size_t bytes = floats * sizeof(float), rays = std::size_t{end - first} * block_rays;
        const std::size_t pixels = std::size_t{frame.width} * frame.height;
        const bool are_many = pixels > 2 * rays;  // tiles: others may have more to copy
        const bool are_small = pixels >= 8 * rays;  // of the picture: memory for two is little of what it takes
        Lines& lines = lines_[are_small ? next_lines_++ % lines_.size() : 0];
        if (lines.copied.valid()) std::exchange(lines.copied, {}).get();  // before they change
        if (!has_room(lines.buffer, bytes)) return false;
        lines.buffer.reserve(bytes);
        const kernel::PlaneValues background = background_of(target);
        Event put;
        for (const Rectangle& r : rectangles)
            put = put_lines_->launch(r.size(), work_group, cl_uint{frame.width}, planes, background, cl_uint{first},
                                     static_cast<cl_uint>(end - first), static_cast<cl_uint>(drawn * block_rays),
                                     static_cast<cl_uint>(r.left), static_cast<cl_uint>(r.top),
                                     static_cast<cl_uint>(r.columns()), static_cast<cl_uint>(r.lines()),
                                     static_cast<cl_uint>(r.begin), places_, tile.picture, lines.buffer);
        device_.flush();  // another queue waits for it
        const std::size_t most = are_many ? rays * planes * sizeof(float) : 0;
        if (target.known && target.known->is_known_to(device_))
            copy_into(frame, rectangles, target, lines, std::move(put));
        else
            copy_by_host(frame, std::move(rectangles), bytes, most, is_last, target, lines, std::move(put));
    }
    mark_shown(frame, first, end, extents, target);
    return true;
}

void PictureLines::copy_into(const kernel::Frame& frame, const std::vector<Rectangle>& rectangles, const RenderTarget& target,
                             Lines& lines, Event put) {
    std::vector<CopyFeed::Copy> copies;
    for (const Rectangle& r : rectangles)
        for (std::size_t p = 0; p < target.planes.size(); ++p)
            copies.push_back({r.begin + p * r.size(), target.planes[p].pixels + r.top * frame.width + r.left, frame.width,
                              r.columns(), r.lines()});
    lines.copied = copies_->add(lines.buffer, std::move(copies), std::move(put));
}

/// Memory that a GPU copies to at full speed takes half a millisecond a megabyte to get.
PictureLines::Slot& PictureLines::free_slot(std::size_t bytes, std::size_t most) {
    Slot& slot = slots_[next_];
    if (slot.done.valid()) slot.done.get();
    if (!slot.memory || slot.memory->size() < bytes) {
        slot.memory.reset();
        slot.memory.emplace(device_, "picture", std::max(bytes, most));
    }
    return slot;
}

void PictureLines::copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::size_t bytes,
                                std::size_t most, bool is_last, const RenderTarget& target, Lines& lines, Event put) {
    Slot& slot = free_slot(bytes, most);
    auto* const values = static_cast<float*>(slot.memory->data());
    if (is_last) return copy_while_waiting(frame, rectangles, values, target, lines.buffer, put);
    const std::size_t floats = bytes / sizeof(float);
    const auto copied = lines.copied = copies_->add(lines.buffer, {{0, values, floats, floats, 1}}, std::move(put));
    const auto put_all = [=, rectangles = std::move(rectangles)] {
        copied.get();
        put_rectangles(frame, rectangles, values, target);
    };
    try {
        slot.done = std::async(std::launch::async, put_all);
        next_ = (next_ + 1) % slots_.size();
    } catch (const std::system_error&) {  // no more threads
        put_all();
    }
}

// Each plane is put as soon as it is there.
void PictureLines::copy_while_waiting(const kernel::Frame& frame, std::span<const Rectangle> rectangles, float* values,
                                      const RenderTarget& target, const Buffer& lines, const Event& put) {
    constexpr std::size_t piece = std::size_t{1} << 18;  // floats that are worth a copy of their own
    struct Pieces {
        std::vector<Event> events;
        std::vector<std::size_t> of;  ///< of each rectangle, of each plane
        ~Pieces() {
            for (const Event& event : events) wait_until_done(event);
        }
    } pieces;
    std::size_t begin = rectangles.front().begin, end = begin;
    const auto copy = [&] {
        pieces.events.push_back(lines.copy_read(values + begin, (end - begin) * sizeof(float), begin * sizeof(float), put));
        begin = end;
        device_.flush_copies();
    };
    for (const Rectangle& r : rectangles)
        for (std::size_t p = 0; p < target.planes.size(); ++p) {
            pieces.of.push_back(pieces.events.size());
            end = r.begin + (p + 1) * r.size();
            if (end - begin >= piece) copy();
        }
    if (end > begin) copy();
    put_rectangles(frame, rectangles, values, target, [&](std::size_t i) { wait_for(pieces.events[pieces.of[i]]); });
}

void PictureLines::finish() {
    for (Slot& slot : slots_)
        if (slot.done.valid()) slot.done.get();
    for (Lines& lines : lines_)
        if (lines.copied.valid()) std::exchange(lines.copied, {}).get();
}

void PictureLines::abandon() noexcept {
    for (Slot& slot : slots_) slot.done = {};
    for (Lines& lines : lines_) {
        if (lines.copied.valid()) lines.copied.wait();
        lines.copied = {};
    }
}

std::uint64_t PictureLines::held() const {
    return places_.size() + extents_.size() + lines_[0].buffer.size() + lines_[1].buffer.size();
}

void PictureLines::release() {
    finish();
    for (Buffer* buffer : {&places_, &extents_, &lines_[0].buffer, &lines_[1].buffer}) *buffer = Buffer(device_, buffer->name());
}

}  // namespace csgrt
