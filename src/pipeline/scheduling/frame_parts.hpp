// Frame parts: divides the rays of a frame or a list into parts; each device that is ready takes the next part.
#pragma once

#include <algorithm>
#include <cstdint>

namespace csgrt {

/// A range of numbers of a picture's rays, or of a list's.
struct RayNumbers {
    std::uint64_t first = 0, end = 0;
};

/// The division of a frame's rays among devices: large parts first, smaller parts near the end.
class Parts {
public:
    /// Makes parts of `least` to `most` rays, in units of `unit`, which is a row of a picture's tiles. Near the end the
    /// parts become smaller, so that no device, and not the bus, has much left to do when all other work is done.
    Parts(std::uint64_t rays, std::uint64_t unit, std::uint64_t devices, std::uint64_t least, std::uint64_t most)
        : rays_(rays), unit_(unit), devices_(devices), least_(least), most_(most) {}

    /// Returns the next part; empty: no part is left.
    RayNumbers take() {
        const std::uint64_t first = next_, left = rays_ - first;
        const std::uint64_t size = std::clamp(left / devices_ / 2, least_, most_);
        next_ += std::min((size + unit_ - 1) / unit_ * unit_, left);
        return {first, next_};
    }
    void stop() { next_ = rays_; }

private:
    std::uint64_t rays_, unit_, devices_, least_, most_, next_ = 0;
};

}  // namespace csgrt
