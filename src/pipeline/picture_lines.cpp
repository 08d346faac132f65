#include "pipeline/picture_lines.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "pipeline/known_picture.hpp"

namespace csgrt {

PictureLines::PictureLines(Device& device)
    : device_(device),
      lines_{Lines{Buffer(device, "lines"), {}}, Lines{Buffer(device, "lines"), {}}, Lines{Buffer(device, "lines"), {}}},
      copies_(device) {}

PictureLines::Lines* PictureLines::next(std::size_t bytes, std::size_t most, const Lines* held, bool is_drawn_later) {
    most = std::min(most, lines_.size());
    if (most > 1 && &lines_[next_lines_ % most] == held) ++next_lines_;
    Lines& lines = lines_[next_lines_ % most];
    const bool grows = bytes > lines.buffer.size();
    if (&lines == held && (grows || !is_drawn_later)) return nullptr;
    if (grows) {
        wait(lines);
        if (bytes > std::min(device_.available() + lines.buffer.size(), device_.max_buffer())) return nullptr;
        lines.buffer.reserve(bytes);
    }
    ++next_lines_;
    return &lines;
}

void PictureLines::put(const kernel::Frame& frame, const Tile& tile, std::span<const std::uint8_t> shown, Lines& lines, bool is_last,
                       const RenderTarget& target) {
    const std::uint32_t first = tile.first_block(), end = tile.end_block();
    const std::size_t planes = target.planes.size();
    if (planes == 0) return;
    std::vector<Rectangle> rectangles = find_rectangles(frame, first, end, shown, target);
    hold_shown(frame, first, end, shown, target);
    if (rectangles.empty()) return;
    const Rectangle all = lines_of(frame, first, end);
    std::vector<CopyFeed::Copy> copies;
    std::size_t floats = 0;
    for (Rectangle& r : rectangles) {
        r.begin = floats;
        floats += r.size() * planes;
        copies.push_back({.columns = r.columns(), .lines = r.lines(), .planes = planes,
                          .begin = (r.top - all.top) * all.columns() + r.left - all.left, .pitch = all.columns(), .slice = all.size()});
    }
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    const bool are_many = pixels > 2 * std::size_t{tile.rays};  // tiles: others may have more to copy
    const std::size_t most = are_many ? tile.rays * planes * sizeof(float) : 0;
    if (!target.known || !target.known->is_known_to(device_))
        return copy_by_host(frame, std::move(rectangles), std::move(copies), most, is_last, target, lines);
    std::vector<CopyFeed::Copy> of_planes;
    for (std::size_t i = 0; i < copies.size(); ++i)
        for (std::size_t p = 0; p < planes; ++p) {
            CopyFeed::Copy copy = copies[i];
            copy.planes = 1;
            copy.begin += p * copy.slice;
            copy.target = target.planes[p].pixels + rectangles[i].top * frame.width + rectangles[i].left;
            copy.target_pitch = frame.width;
            of_planes.push_back(copy);
        }
    lines.copied = copies_.add(lines.buffer, std::move(of_planes));
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

void PictureLines::copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::vector<CopyFeed::Copy> copies,
                                std::size_t most, bool is_last, const RenderTarget& target, Lines& lines) {
    const std::size_t floats = rectangles.back().begin + rectangles.back().size() * target.planes.size();
    Slot& slot = free_slot(floats * sizeof(float), most);
    auto* const values = static_cast<float*>(slot.memory->data());
    for (std::size_t i = 0; i < copies.size(); ++i) {
        copies[i].target = values + rectangles[i].begin;
        copies[i].target_pitch = rectangles[i].columns();
        copies[i].target_slice = rectangles[i].size();
    }
    if (is_last) return copy_while_waiting(frame, rectangles, copies, values, target, lines.buffer);
    const auto copied = lines.copied = copies_.add(lines.buffer, std::move(copies));
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

// Planes are put as soon as they are there.
void PictureLines::copy_while_waiting(const kernel::Frame& frame, std::span<const Rectangle> rectangles,
                                      std::span<const CopyFeed::Copy> copies, const float* values, const RenderTarget& target,
                                      const Buffer& lines) {
    constexpr std::size_t piece = std::size_t{1} << 18;  // floats that are worth a copy of their own
    struct Pieces {
        std::vector<Event> events;
        std::vector<std::size_t> of;  ///< of each rectangle, of each plane
        ~Pieces() {
            for (const Event& event : events) wait_until_done(event);
        }
    } pieces;
    for (const CopyFeed::Copy& copy : copies) {
        const std::size_t planes = std::max<std::size_t>(1, piece / (copy.columns * copy.lines));
        for (std::size_t p = 0; p < copy.planes; p += planes) {
            CopyFeed::Copy part = copy;
            part.planes = std::min(planes, copy.planes - p);
            part.begin += p * copy.slice;
            part.target += p * copy.target_slice;
            for (std::size_t i = 0; i < part.planes; ++i) pieces.of.push_back(pieces.events.size());
            pieces.events.push_back(CopyFeed::queue(device_, lines, part));
            device_.flush_copies();
        }
    }
    put_rectangles(frame, rectangles, values, target, [&](std::size_t i) { wait_for(pieces.events[pieces.of[i]]); });
}

void PictureLines::finish() {
    for (Slot& slot : slots_)
        if (slot.done.valid()) slot.done.get();
    for (Lines& lines : lines_) wait(lines);
}

void PictureLines::abandon() noexcept {
    for (Slot& slot : slots_) slot.done = {};
    for (Lines& lines : lines_) {
        if (lines.copied.valid()) lines.copied.wait();
        lines.copied = {};
    }
}

std::uint64_t PictureLines::held() const {
    std::uint64_t sum = 0;
    for (const Lines& lines : lines_) sum += lines.buffer.size();
    return sum;
}

void PictureLines::release(const Lines* but) {
    finish();
    for (Lines& lines : lines_)
        if (&lines != but) lines.buffer.release();
}

}  // namespace csgrt
