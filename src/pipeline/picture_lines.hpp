// Pixels of a GPU's tile -> rectangles of the picture, line by line, which the GPU copies while it is at the next tile: into the
// picture's memory, if that is known to it (the host has no part in it then, whose memory is what several GPUs wait for), else
// to memory that is, from which the host copies them.
#pragma once

#include <array>
#include <future>
#include <optional>
#include <span>
#include <vector>

#include "device/copy_feed.hpp"
#include "device/queued.hpp"
#include "pipeline/rectangles.hpp"
#include "pipeline/stages.hpp"

namespace csgrt {

class PictureLines {
public:
    explicit PictureLines(Device& device);

    /// Compiles its kernels.
    void build();
    bool is_built() const { return copies_.has_value(); }

    /// Asks which of the blocks from number `first` to `end` show something, once it is built. `drawn` of them were drawn:
    /// tile.rays has their numbers, tile.picture their pixels, as put_blocks() has them. Does not wait.
    void look(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::uint32_t drawn, const TileBuffers& tile,
              const RenderTarget& target);
    /// Has the answer copied; see QueuedRead.
    void fetch() { read_.fetch(); }
    /// Puts them into the target. Unless this is the last of the device's in a frame, and the picture's memory not known to it, it
    /// may return before it is done: until then the target must last, the tile need not. False: there is no room on the device,
    /// nothing was done.
    bool put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::uint32_t drawn,
                    const TileBuffers& tile, bool is_last, const RenderTarget& target);
    /// Returns when all is done. Throws what kept it from being done.
    void finish();
    /// The same, but what was thrown is not told.
    void abandon() noexcept;

    std::uint64_t held() const;  ///< bytes on the device
    void release();              ///< gives all its memory there back

private:
    /// Memory that the device copies to at full speed.
    struct Slot {
        std::optional<PinnedMemory> memory;
        std::future<void> done;  ///< when it is destroyed, nothing works on the memory
    };
    /// Lines on the device, on their way into the picture.
    struct Lines {
        Buffer buffer;
        std::shared_future<void> copied;
    };
    bool has_room(const Buffer& buffer, std::uint64_t bytes) const;
    Slot& free_slot(std::size_t bytes, std::size_t most);
    void copy_into(const kernel::Frame& frame, const std::vector<Rectangle>& rectangles, const RenderTarget& target,
                   Lines& lines, Event put);
    void copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::size_t bytes, std::size_t most,
                      bool is_last, const RenderTarget& target, Lines& lines, Event put);
    void copy_while_waiting(const kernel::Frame& frame, std::span<const Rectangle> rectangles, float* values,
                            const RenderTarget& target, const Buffer& lines, const Event& put);

    Device& device_;
    std::optional<Program> program_;
    std::optional<Kernel> find_shown_, put_lines_;
    Buffer places_, extents_;
    QueuedRead read_;  ///< extents_
    Event shown_;      ///< find_shown's
    bool has_looked_ = false;
    std::array<Lines, 2> lines_;
    std::size_t next_lines_ = 0;
    std::optional<CopyFeed> copies_;  ///< to be gone before the lines
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;  ///< the slot that has waited longest
};

}  // namespace csgrt
