#include "pipeline/readback/ring.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "pipeline/readback/registered_memory.hpp"

namespace csgrt {

PictureLines::PictureLines(Device& device) : device_(device), copies_(device) {
    for (std::size_t i = 0; i < most_lines; ++i) lines_.push_back({Buffer(device, "lines"), {}});
}

PictureLines::Lines* PictureLines::take(std::size_t bytes, std::size_t count) {
    const auto last = lines_.begin() + static_cast<std::ptrdiff_t>(count);
    const auto rank = [](const Lines& lines) { return std::pair(lines.is_held, lines.put); };
    Lines& lines = *std::min_element(lines_.begin(), last, [&](const Lines& a, const Lines& b) { return rank(a) < rank(b); });
    if (lines.is_held) return nullptr;
    if (bytes > lines.buffer.size()) {
        wait(lines);
        if (bytes > std::min(device_.available() + lines.buffer.size(), device_.max_buffer())) return nullptr;
        lines.buffer.reserve(bytes);
    }
    lines.is_held = true;
    return &lines;
}

void PictureLines::put(const kernel::Frame& frame, const RayBatch& batch, std::span<const std::uint8_t> shown, Lines& lines, bool is_last,
                       const RenderTarget& target) {
    const std::uint32_t first = batch.first_tile(), end = batch.end_tile();
    lines.is_held = false;
    lines.put = ++batches_put_;
    if (target.planes.empty()) return;
    std::vector<Rectangle> rectangles = find_rectangles(frame, first, end, shown, target);
    hold_shown(frame, first, end, shown, target);
    if (rectangles.empty()) return;
    const Rectangle all = lines_of(frame, first, end);
    const bool is_known = target.known && target.known->is_known_to(device_);
    std::vector<CopyFeed::Copy> copies;
    std::size_t floats = 0;
    for (Rectangle& r : rectangles) {
        r.begin = floats;
        floats += r.size() * target.planes.size();
        copies.push_back({.columns = r.columns(), .lines = r.lines(), .planes = target.planes.size(),
                          .begin = (r.top - all.top) * all.columns() + r.left - all.left, .pitch = all.columns(), .slice = all.size(),
                          .target = target.planes.front().pixels + r.top * frame.width + r.left, .target_pitch = frame.width,
                          .target_slice = std::size_t{frame.width} * frame.height});
    }
    if (is_known) {
        lines.copied = copies_.add(lines.buffer, std::move(copies));
        return;
    }
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    const bool are_many = pixels > 2 * std::size_t{batch.rays};  // batches: others may have more to copy
    Slot& slot = free_slot(std::max(floats, are_many ? batch.rays * target.planes.size() : 0) * sizeof(float));
    for (std::size_t i = 0; i < copies.size(); ++i) {
        copies[i].target = static_cast<float*>(slot.memory->data()) + rectangles[i].begin;
        copies[i].target_pitch = rectangles[i].columns();
        copies[i].target_slice = rectangles[i].size();
    }
    if (is_last)
        copy_while_waiting(frame, rectangles, copies, target, slot, lines.buffer);
    else
        copy_by_host(frame, std::move(rectangles), std::move(copies), target, slot, lines);
}

/// Memory that a GPU copies to at full speed takes half a millisecond a megabyte to get.
PictureLines::Slot& PictureLines::free_slot(std::size_t bytes) {
    Slot& slot = slots_[next_];
    if (slot.done.valid()) slot.done.get();
    if (!slot.memory || slot.memory->size() < bytes) {
        slot.memory.reset();
        slot.memory.emplace(device_, "picture", bytes);
    }
    return slot;
}

void PictureLines::copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::vector<CopyFeed::Copy> copies,
                                const RenderTarget& target, Slot& slot, Lines& lines) {
    const auto* const values = static_cast<const float*>(slot.memory->data());
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
                                      std::span<const CopyFeed::Copy> copies, const RenderTarget& target, const Slot& slot,
                                      const Buffer& lines) {
    const auto* const values = static_cast<const float*>(slot.memory->data());
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
        lines.is_held = false;
    }
}

std::uint64_t PictureLines::held() const {
    std::uint64_t sum = 0;
    for (const Lines& lines : lines_) sum += lines.buffer.size();
    return sum;
}

void PictureLines::release(const Lines* but) {
    finish();
    for (Lines& lines : lines_) {
        if (&lines == but) continue;
        lines.is_held = false;
        lines.buffer.release();
    }
}

}  // namespace csgrt
