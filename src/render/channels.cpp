#include <algorithm>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <csgrt/image.hpp>

#include "base/parallel.hpp"
#include "base/watch.hpp"

namespace csgrt {

void Channels::allocate(std::size_t count, std::size_t size) {
    count_ = count;
    size_ = count == 0 ? 0 : size;
    const std::size_t bytes = count * size_ * sizeof(float);
    values_.reset(static_cast<float*>(::operator new(bytes, alignment)));
#ifdef __linux__
    // Large pages for large memory: with small pages it takes half a second to get a gigabyte, and a fifth of a second
    // to give it back.
    constexpr std::size_t page = 4096, many = 1 << 22;
    void* begin = values_.get();
    std::size_t room = bytes;
    if (bytes >= many && std::align(page, bytes - page, begin, room)) madvise(begin, room, MADV_HUGEPAGE);
#endif
}

Channels::Channels(std::size_t size, std::span<const float> values) : Channels(size, values, nullptr) {}

Channels::Channels(std::size_t size, std::span<const float> values, const Watch* watch) {
    constexpr std::size_t piece = 1 << 18;  // floats that are worth a thread
    allocate(values.size(), size);
    for_chunks(count_ * size_, piece, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        if (watch) watch->check();
        for (std::size_t c = first / size_; first < last; ++c) {
            const std::size_t end = std::min(last, (c + 1) * size_);
            std::fill(values_.get() + first, values_.get() + end, values[c]);
            first = end;
        }
    });
}

Channels::Channels(const std::vector<std::vector<float>>& channels) {
    if (channels.empty()) return;
    for (std::size_t c = 1; c < channels.size(); ++c)
        if (channels[c].size() != channels[0].size())
            throw Error(Status::usage, "channel " + std::to_string(c) + " has " + std::to_string(channels[c].size()) +
                                           " values, channel 0 has " + std::to_string(channels[0].size()));
    allocate(channels.size(), channels[0].size());
    for (std::size_t c = 0; c < count_; ++c) std::ranges::copy(channels[c], (*this)[c].begin());
}

Channels::Channels(const Channels& other) {
    allocate(other.count_, other.size_);
    std::copy_n(other.values_.get(), count_ * size_, values_.get());
}

Channels& Channels::operator=(Channels&& other) noexcept {
    count_ = std::exchange(other.count_, 0);
    size_ = std::exchange(other.size_, 0);
    values_ = std::move(other.values_);
    return *this;
}

bool operator==(const Channels& a, const Channels& b) noexcept {
    const FloatingPoint own;
    return a.count_ == b.count_ && a.size_ == b.size_ &&
           std::equal(a.values_.get(), a.values_.get() + a.count_ * a.size_, b.values_.get());
}

}  // namespace csgrt
