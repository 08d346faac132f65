// A picture's batches on a GPU, two under way: while one's kernels run, the other's are queued, or run beside them, and pixels of those
// before are copied. Each has memory of its own for all but pixels, segments and partitions.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "device/queued.hpp"
#include "pipeline/passes/tile_list.hpp"
#include "pipeline/passes/partitions.hpp"
#include "pipeline/readback/ring.hpp"

namespace csgrt {

/// A batch that a GPU was given.
struct QueuedBatch {
    explicit QueuedBatch(Device& device) : buffers(device), answer(device, "tally") {}

    bool is_under_way = false;  ///< given, and not put or given up yet
    kernel::Frame frame{};
    RayBatch batch;
    BatchBuffers buffers;
    PictureLines::Lines* lines = nullptr;  ///< where it is drawn; of every partition only when it is shaded
    QueuedUpload upload;                   ///< of its frame
    QueuedRead answer;                     ///< its tally, and its tiles' bytes if they are drawn
    std::vector<Event> culled;             ///< kernel 0, the tiles' list, the background
    TimedKernels kernels;                  ///< that draw
    Exact::Needs room;                     ///< of those, of every partition

    const kernel::BatchReport& tally() { return answer.wait<kernel::BatchReport>(1).front(); }
    /// Of each tile, not 0 if it shows something.
    std::span<const std::uint8_t> shown() {
        return answer.wait<std::uint8_t>(sizeof(kernel::BatchReport) + batch.tiles()).subspan(sizeof(kernel::BatchReport));
    }
};

/// What a pipeline has for them.
struct ByLines {
    explicit ByLines(Device& device) : list(device), batches{QueuedBatch(device), QueuedBatch(device)}, lines(device) {}

    TileList list;
    /// As many as the device has lanes: of first hits each has its own, so that while a batch's longest rays are drawn the next ones'
    /// kernels begin.
    std::array<QueuedBatch, Device::lanes> batches;
    std::vector<std::uint32_t> overflown;  ///< of first hits: rays without room of batches that are put
    PictureLines lines;

    /// The first that is not under way: a frame of a single batch always takes the same memory. Null: all are.
    QueuedBatch* free_batch() {
        const auto free = std::ranges::find(batches, false, &QueuedBatch::is_under_way);
        return free == batches.end() ? nullptr : &*free;
    }
    std::size_t lane_of(const QueuedBatch& batch) const { return static_cast<std::size_t>(&batch - batches.data()); }

    std::uint64_t held() const {
        std::uint64_t sum = lines.held();
        for (const QueuedBatch& batch : batches) sum += batch.buffers.held();
        return sum;
    }
    /// No batch is under way any more.
    void give_up() {
        for (QueuedBatch& batch : batches) batch.is_under_way = false;
        overflown.clear();
    }
    /// Gives that back but for what a batch has, once the pixels of others are in the picture.
    void release(const QueuedBatch* but = nullptr) {
        for (QueuedBatch& batch : batches)
            if (&batch != but) batch.buffers.release();
        lines.release(but ? but->lines : nullptr);
    }
};

}  // namespace csgrt
