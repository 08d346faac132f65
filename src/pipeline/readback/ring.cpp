#include "pipeline/readback/ring.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/thread.hpp"
#include "pipeline/readback/registered_memory.hpp"

namespace csgrt {

ReadbackRing::ReadbackRing(Device& device) : device_(device), copies_(device) {
    for (std::size_t i = 0; i < depth; ++i) pictures_.push_back({Buffer(device, "pictures of batches"), {}});
}

// One whose pixels are copied, so that a frame of one batch uses one picture; else the one that was collected first.
ReadbackRing::DevicePicture* ReadbackRing::acquire(std::size_t bytes) {
    const auto rank = [](const DevicePicture& picture) {
        const bool is_copied =
            !picture.copied.valid() || picture.copied.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        return std::tuple(picture.is_in_use, !is_copied, is_copied ? 0 : picture.used);
    };
    DevicePicture& picture = *std::ranges::min_element(pictures_, {}, rank);
    if (picture.is_in_use) return nullptr;
    if (bytes > picture.buffer.size()) {
        wait(picture);
        if (bytes > std::min(device_.available() + picture.buffer.size(), device_.max_buffer())) return nullptr;
        picture.buffer.reserve(bytes);
    }
    picture.is_in_use = true;
    return &picture;
}

void ReadbackRing::wait(DevicePicture& picture) {
    if (picture.copied.valid()) std::exchange(picture.copied, {}).get();
}

void ReadbackRing::collect(const kernel::Frame& frame, const RayBatch& batch, std::span<const std::uint8_t> shown,
                           DevicePicture& picture, bool is_last, const RenderTarget& target) {
    const std::uint32_t first = batch.first_tile(), end = batch.end_tile();
    picture.is_in_use = false;
    picture.used = ++collected_;
    if (target.channels.empty()) return;
    std::vector<Rectangle> rectangles = take_rectangles(frame, first, end, shown, target);
    if (rectangles.empty()) return;
    const Rectangle all = rows_of(frame, first, end);
    const bool is_registered = target.registered && target.registered->has(device_);
    std::vector<CopyFeed::Copy> copies;
    std::size_t floats = 0;
    for (Rectangle& r : rectangles) {
        r.begin = floats;
        floats += r.size() * target.channels.size();
        copies.push_back({.columns = r.columns(),
                          .lines = r.lines(),
                          .channels = target.channels.size(),
                          .begin = (r.top - all.top) * all.columns() + r.left - all.left,
                          .pitch = all.columns(),
                          .slice = all.size(),
                          .target = target.channels.front().pixels + r.top * frame.width + r.left,
                          .target_pitch = frame.width,
                          .target_slice = std::size_t{frame.width} * frame.height});
    }
    if (is_registered) {
        picture.copied = copies_.add(picture.buffer, std::move(copies));
        return;
    }
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    const bool has_many_batches = pixels > 2 * std::size_t{batch.rays};  // another of which may have more to copy
    Staging& staging =
        free_staging(std::max(floats, has_many_batches ? batch.rays * target.channels.size() : 0) * sizeof(float));
    for (std::size_t i = 0; i < copies.size(); ++i) {
        copies[i].target = static_cast<float*>(staging.memory->data()) + rectangles[i].begin;
        copies[i].target_pitch = rectangles[i].columns();
        copies[i].target_slice = rectangles[i].size();
    }
    if (is_last)
        copy_at_once(frame, rectangles, copies, target, staging, picture.buffer);
    else
        copy_by_thread(frame, std::move(rectangles), std::move(copies), target, staging, picture);
}

// To get such memory takes half a millisecond a megabyte.
ReadbackRing::Staging& ReadbackRing::free_staging(std::size_t bytes) {
    Staging& staging = staging_[next_];
    if (staging.done.valid()) staging.done.get();
    if (!staging.memory || staging.memory->size() < bytes) {
        staging.memory.reset();
        staging.memory.emplace(device_, "staging memory", bytes);
    }
    return staging;
}

void ReadbackRing::copy_by_thread(const kernel::Frame& frame, std::vector<Rectangle> rectangles,
                                  std::vector<CopyFeed::Copy> copies, const RenderTarget& target, Staging& staging,
                                  DevicePicture& picture) {
    const auto* const values = static_cast<const float*>(staging.memory->data());
    const auto copied = picture.copied = copies_.add(picture.buffer, std::move(copies));
    const auto put_all = [=, rectangles = std::move(rectangles)] {
        copied.get();
        put_rectangles(frame, rectangles, values, target);
    };
    try {
        staging.done = start_async(put_all, std::launch::async);
        next_ = (next_ + 1) % staging_.size();
    } catch (const std::system_error&) {  // no more threads
        put_all();
    }
}

// The host copies a channel of a rectangle as soon as it is there.
void ReadbackRing::copy_at_once(const kernel::Frame& frame, std::span<const Rectangle> rectangles,
                                std::span<const CopyFeed::Copy> copies, const RenderTarget& target,
                                const Staging& staging, const Buffer& picture) {
    const auto* const values = static_cast<const float*>(staging.memory->data());
    constexpr std::size_t piece = std::size_t{1} << 18;  // floats that are worth a copy of their own
    struct Pieces {
        std::vector<Event> events;
        std::vector<std::size_t> event_of;  ///< of each rectangle's channels
        ~Pieces() {
            for (const Event& event : events) wait_until_done(event);
        }
    } pieces;
    for (const CopyFeed::Copy& copy : copies) {
        const std::size_t channels = std::max<std::size_t>(1, piece / (copy.columns * copy.lines));
        for (std::size_t c = 0; c < copy.channels; c += channels) {
            CopyFeed::Copy part = copy;
            part.channels = std::min(channels, copy.channels - c);
            part.begin += c * copy.slice;
            part.target += c * copy.target_slice;
            for (std::size_t i = 0; i < part.channels; ++i) pieces.event_of.push_back(pieces.events.size());
            pieces.events.push_back(CopyFeed::queue(device_, picture, part));
            device_.flush_copies();
        }
    }
    put_rectangles(frame, rectangles, values, target,
                   [&](std::size_t i) { wait_for(pieces.events[pieces.event_of[i]]); });
}

void ReadbackRing::finish() {
    for (Staging& staging : staging_)
        if (staging.done.valid()) staging.done.get();
    for (DevicePicture& picture : pictures_) wait(picture);
}

void ReadbackRing::abandon() noexcept {
    for (Staging& staging : staging_) staging.done = {};
    for (DevicePicture& picture : pictures_) {
        if (picture.copied.valid()) picture.copied.wait();
        picture.copied = {};
        picture.is_in_use = false;
    }
}

std::uint64_t ReadbackRing::held() const {
    std::uint64_t sum = 0;
    for (const DevicePicture& picture : pictures_) sum += picture.buffer.size();
    return sum;
}

void ReadbackRing::release(const DevicePicture* kept) {
    finish();
    for (DevicePicture& picture : pictures_)
        if (&picture != kept) picture.buffer.release();
}

}  // namespace csgrt
