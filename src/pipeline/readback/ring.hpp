// Pixels of a GPU's batch, whole lines of the picture -> rectangles of it, which the GPU copies while it is at the next batches: into
// the memory of those planes of the picture that is known to it (the host has no part in it then, whose memory is what several GPUs
// wait for), else to memory that is, from which the host copies them.
#pragma once

#include <array>
#include <future>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "device/copy_feed.hpp"
#include "pipeline/readback/rectangles.hpp"
#include "pipeline/passes/stages.hpp"

namespace csgrt {

class PictureLines {
public:
    /// Lines on the device: each plane's of a batch, and until when they are on their way into the picture.
    struct Lines {
        Buffer buffer;
        std::shared_future<void> copied;
        bool is_held = false;    ///< by a batch that is not put yet
        std::uint64_t put = 0;   ///< the batch that was put last, by its number; 0: none
    };

    static constexpr std::size_t most_lines = 8;  ///< Lines

    explicit PictureLines(Device& device);

    /// Memory for a batch's lines, which holds it until it is put: of `count` the one whose batch was put first. Null: batches hold all of
    /// them, or there is no room on the device.
    Lines* take(std::size_t bytes, std::size_t count);
    /// Returns when the lines that were there are in the picture.
    static void wait(Lines& lines) {
        if (lines.copied.valid()) std::exchange(lines.copied, {}).get();
    }

    /// Puts the batch's tiles, which are drawn, into the target: what is `shown` (a byte a tile) and background. It may
    /// return before all that is done, which the target must outlast; of the last batch of the device's in a frame only what it copies
    /// into memory that it knows may come later.
    void put(const kernel::Frame& frame, const RayBatch& batch, std::span<const std::uint8_t> shown, Lines& lines, bool is_last,
             const RenderTarget& target);
    /// Returns when all is done. Throws what kept it from being done.
    void finish();
    /// The same, but what was thrown is not told.
    void abandon() noexcept;

    std::uint64_t held() const;  ///< bytes on the device
    void release(const Lines* but = nullptr);  ///< gives its memory there back, once all is done; no batch but that of `but` has any

private:
    /// Memory that the device copies to at full speed.
    struct Slot {
        std::optional<PinnedMemory> memory;
        std::future<void> done;  ///< when it is destroyed, nothing works on the memory
    };
    Slot& free_slot(std::size_t bytes);
    void copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::vector<CopyFeed::Copy> copies,
                      const RenderTarget& target, Slot& slot, Lines& lines);
    void copy_while_waiting(const kernel::Frame& frame, std::span<const Rectangle> rectangles,
                            std::span<const CopyFeed::Copy> copies, const RenderTarget& target, const Slot& slot,
                            const Buffer& lines);

    Device& device_;
    std::vector<Lines> lines_;
    std::uint64_t batches_put_ = 0;
    CopyFeed copies_;  ///< to be gone before the lines
    std::array<Slot, 2> slots_;
    std::size_t next_ = 0;  ///< the slot that has waited longest
};

}  // namespace csgrt
