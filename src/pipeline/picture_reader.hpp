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
    /// Calls put() with the first `bytes` of a tile's picture.
    void read(const Buffer& picture, std::size_t bytes, Put put);
    /// The same; on a GPU it returns before put() has ended. `most`: bytes that another tile's may have.
    void read_beside(const Buffer& picture, std::size_t bytes, std::size_t most, Put put);
    /// Returns when all have. Throws what one of them threw.
    void finish();
    /// The same, but what they threw is not told.
    void abandon();

private:
    /// Memory that the device copies to at full speed, and who reads it.
    struct Slot {
        std::optional<PinnedMemory> memory;  ///< as large as any picture yet
        Put put;
        const float* values() const { return static_cast<const float*>(memory->data()); }
        std::future<void> ended;  ///< when it is destroyed, put() has ended
    };

    bool in_place() const;
    void copy(const Buffer& picture, std::size_t bytes, std::size_t most, Put put);

    Device& device_;
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;  ///< the slot that has waited longest
};

}  // namespace csgrt
