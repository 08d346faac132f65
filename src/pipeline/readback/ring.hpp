// Readback ring: copies the pixels of a GPU's batches into the picture, while the GPU draws the next batches.
//
// A batch is drawn into a row-major picture on the device. The rectangles of this picture that show something, or did
// so before, are copied into the target (device/copy_feed.hpp).
#pragma once

#include <future>
#include <span>
#include <vector>

#include "device/copy_feed.hpp"
#include "pipeline/batch.hpp"
#include "pipeline/readback/picture.hpp"

namespace csgrt {

/// A ring of pictures on the device. A batch is drawn into one of them while others are copied to the host.
class ReadbackRing {
public:
    /// The rows of a batch's picture on the device, channel by channel.
    struct DevicePicture {
        Buffer buffer;
        std::shared_future<void> copied;  ///< valid while the pixels are copied
        bool is_in_use = false;           ///< by a batch that is not collected yet
        std::uint64_t used = 0;           ///< the number of batches that were collected when this picture was
    };

    explicit ReadbackRing(Device& device);

    /// Memory for a batch's picture, until collect() or cancel(). Null if all pictures are in use or the device has no
    /// more memory.
    DevicePicture* acquire(std::size_t bytes);
    static void cancel(DevicePicture& picture) noexcept { picture.is_in_use = false; }
    /// Returns when the picture's earlier pixels are copied, so that kernels may write into it. Throws if the copy
    /// failed.
    static void wait(DevicePicture& picture);

    /// Queues the copies of the batch's pixels into the target; the pixels must be drawn. `shown`: one byte a tile, not
    /// 0 if the tile shows something. May return before the copies are made: the target must live until finish() or
    /// abandon().
    void collect(const kernel::Frame& frame, const RayBatch& batch, std::span<const std::uint8_t> shown,
                 DevicePicture& picture, const RenderTarget& target);
    /// Returns when all copies are made. Throws if a copy failed.
    void finish();
    /// Returns when all copies are made or have failed, without throwing. Then no batch uses a picture any more.
    void abandon() noexcept;

    std::uint64_t held() const;  ///< bytes on the device
    /// Gives the device's memory back, except `kept`, when all copies are made.
    void release(const DevicePicture* kept = nullptr);

private:
    static constexpr std::size_t depth = Device::queues + 1;  ///< batches being drawn, and one being copied
    Device& device_;
    std::vector<DevicePicture> pictures_;
    std::uint64_t collected_ = 0;  ///< batches
    CopyFeed copies_;              ///< destroyed before the pictures
};

}  // namespace csgrt
