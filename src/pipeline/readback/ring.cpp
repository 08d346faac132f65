#include "pipeline/readback/ring.hpp"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "pipeline/readback/registered_memory.hpp"

namespace csgrt {

ReadbackRing::ReadbackRing(Device& device) : device_(device), copies_(device) {
    for (std::size_t i = 0; i < depth; ++i) pictures_.push_back({Buffer(device, "pictures of batches"), {}});
}

// A picture whose pixels have been copied is chosen first, so that frames of one batch use a single picture. Else the
// picture that was collected first is chosen.
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
                           DevicePicture& picture, const RenderTarget& target) {
    const std::uint32_t first = batch.first_tile(), end = batch.end_tile();
    picture.is_in_use = false;
    picture.used = ++collected_;
    if (target.channels.empty()) return;
    const Rectangle all = rows_of(frame, first, end);
    std::vector<CopyFeed::Copy> copies;
    const std::size_t count = target.channels.size();
    for (const Rectangle& r : take_rectangles(frame, first, end, shown, target))
        for (std::size_t c = 0; c < count; ++c) {
            const std::size_t begin = c;
            while (c < count && target.channels[c].has_memory()) ++c;
            if (c == begin) continue;
            copies.push_back({.columns = r.columns(),
                              .lines = r.lines(),
                              .channels = c - begin,
                              .begin = begin * all.size() + (r.top - all.top) * all.columns() + r.left - all.left,
                              .pitch = all.columns(),
                              .slice = all.size(),
                              .target = target.channels[begin].pixels + r.top * frame.width + r.left,
                              .target_pitch = frame.width,
                              .target_slice = std::size_t{frame.width} * frame.height});
        }
    if (copies.empty()) return;
    const bool is_registered = target.registered && target.registered->has(device_);
    picture.copied = copies_.add(picture.buffer, std::move(copies), is_registered);
}

void ReadbackRing::finish() {
    for (DevicePicture& picture : pictures_) wait(picture);
}

void ReadbackRing::abandon() noexcept {
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
