// Pixels from the device's memory to the host: those of a tile are put into the image while a GPU is at the next tile.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <future>
#include <optional>

#include "device/buffer.hpp"

namespace csgrt {

class PictureReader {
public:
    explicit PictureReader(Device& device) : device_(device) {}

    using Put = std::function<void(const float*)>;
    /// Calls put() with the first `bytes` of a tile's picture, and with `beside`, on a GPU, returns before it has ended.
    void read(const Buffer& picture, std::size_t bytes, bool beside, Put put);
    /// Returns when all have. Throws what one of them threw.
    void finish();
    /// The same, but what they threw is not told.
    void abandon();

private:
    /// Memory that the device copies to at full speed, and who reads it.
    struct Slot {
        std::optional<PinnedMemory> memory;  ///< as large as any picture yet
        Put put;
        std::future<void> ended;  ///< when it is destroyed, put() has ended
    };

    Device& device_;
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;
};

}  // namespace csgrt
