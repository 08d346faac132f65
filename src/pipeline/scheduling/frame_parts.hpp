// A frame's rays, or a list's -> parts that cost about as much, one after another for each device that is ready.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/readback/picture.hpp"

namespace csgrt {

/// Of a picture's rays, or of a list's.
struct RayRange {
    std::uint64_t first = 0, end = 0;
};

/// What rays may cost, of which a ray that sees nothing costs 1. Where this is wrong it costs time and nothing else.
class RayCosts {
public:
    static constexpr std::uint64_t of_shown =
        16;  ///< of a ray whose tile shows something (measured: docs/experiments/gpu-frames.md)
    static constexpr std::uint32_t most_bands = 128;  ///< of rows of a frame's tiles, at most twice as many

    /// Of a list: each the same.
    explicit RayCosts(std::uint64_t rays);
    /// Of a frame: those of tiles in which the target holds something now show something again; a row stands for a band
    /// of them. If it holds nothing, each the same.
    RayCosts(const kernel::Frame& frame, const RenderTarget& target);

    std::uint64_t rays() const { return rays_; }
    std::uint64_t total() const { return sums_.back(); }
    /// Of the first `rays`.
    std::uint64_t before(std::uint64_t rays) const;
    /// Where rays from `first` on end that cost that much, or little more: a tile at least, and whole rows of the
    /// screen's if they are many, for what is copied of them is in few pieces then.
    std::uint64_t end(std::uint64_t first, std::uint64_t cost) const;

private:
    std::uint64_t rays_of(std::size_t band) const { return std::min(band_, rays_ - band * band_); }

    std::uint64_t rays_, row_,
        band_;  ///< all, and those of a row and of a band of the screen's tiles, or of so many of a list
    std::vector<std::uint64_t> sums_;  ///< of each band what those before cost, and all
};

class Parts {
public:
    /// `parts`: of each device's share. Near the end they become smaller, so that little is left for one device, or for
    /// the bus, when all else is done; and the first ones are if they `begin_small`, so that their pixels are soon on
    /// their way. One device's that do not are all alike. They come from the rays' two halves in turn: where pixels
    /// take longer to copy than to compute, others are computed meanwhile.
    Parts(RayCosts costs, std::size_t devices, std::uint64_t parts, bool begin_small);

    /// The next one: begins with a tile. Empty if there is none.
    RayRange take();
    void stop() { left_.clear(); }

private:
    RayCosts costs_;
    std::uint64_t devices_, least_, most_, taken_ = 0;
    bool begin_small_, shrinks_;
    std::vector<RayRange> left_;  ///< of each half
};

}  // namespace csgrt
