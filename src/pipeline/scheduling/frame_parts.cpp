#include "pipeline/scheduling/frame_parts.hpp"

#include <algorithm>

#include "pipeline/readback/tile_rows.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

RayCosts::RayCosts(std::uint64_t rays) : rays_(rays), row_(1 << 16), band_(row_) {
    for (std::uint64_t first = 0; first < rays; first += band_) sums_.push_back(first * of_shown);
    sums_.push_back(rays * of_shown);
}

// To look at all tiles of 8192 x 8192 pixels took up to 0.4 ms, before any device has work.
RayCosts::RayCosts(const kernel::Frame& frame, const RenderTarget& target) {
    const std::uint32_t across = kernel::tiles_across(frame.screen), down = kernel::tiles_down(frame.screen);
    const std::size_t rows_a_band = std::max(1u, down / most_bands);
    row_ = std::uint64_t{across} * tile_rays;
    band_ = rows_a_band * row_;
    rays_ = down * row_;
    sums_.push_back(0);
    if (rays_ == 0) return;
    const TileRows rows(frame, 0, across * down);
    std::vector<std::uint64_t> covered;  // of a band's middle row
    std::uint64_t all = 0;
    for (std::size_t first = 0; first < down; first += rows_a_band) {
        covered.push_back(
            count_covered(rows.covered((first + std::min<std::size_t>(first + rows_a_band, down)) / 2, target)));
        all += covered.back();
    }
    for (std::size_t band = 0; band < covered.size(); ++band) {
        const std::uint64_t shown = all == 0 ? across : covered[band];
        sums_.push_back(sums_.back() + rays_of(band) / row_ * (row_ + (of_shown - 1) * tile_rays * shown));
    }
}

std::uint64_t RayCosts::before(std::uint64_t rays) const {
    if (rays >= rays_) return total();
    const std::size_t band = rays / band_;
    return sums_[band] + (sums_[band + 1] - sums_[band]) * (rays % band_) / rays_of(band);
}

std::uint64_t RayCosts::end(std::uint64_t first, std::uint64_t cost) const {
    constexpr std::uint64_t many = 4;
    const std::uint64_t sum = before(first) + cost;
    if (sum >= total()) return rays_;
    const auto band = static_cast<std::size_t>(std::ranges::upper_bound(sums_, sum) - sums_.begin()) - 1;
    std::uint64_t end = band * band_ + (sum - sums_[band]) * rays_of(band) / (sums_[band + 1] - sums_[band]);
    const std::uint64_t unit = end >= first + many * row_ ? row_ : tile_rays;
    end = std::max((end + unit - 1) / unit * unit, first + tile_rays);
    return std::min(end, rays_);
}

Parts::Parts(RayCosts costs, std::size_t devices, std::uint64_t parts, bool begin_small)
    : costs_(std::move(costs)), devices_(devices), begin_small_(begin_small) {
    least_ = (devices > 1 ? 1 << 16 : 1 << 20) * RayCosts::of_shown;  // that is worth launches of its own
    const std::uint64_t share = costs_.total() / devices;
    most_ = devices > 1 ? share / parts : std::max(std::min(share, least_), share / parts);
    shrinks_ = devices > 1 || begin_small;
    const std::uint64_t first = shrinks_ ? costs_.total() / 2 : (parts + 1) / 2 * most_;
    const std::uint64_t half = costs_.total() < 4 * most_ ? costs_.rays() : costs_.end(0, first);
    left_ = {{0, half}, {half, costs_.rays()}};
}

RayRange Parts::take() {
    std::erase_if(left_, [](const RayRange& half) { return half.first == half.end; });
    if (left_.empty()) return {};
    std::uint64_t rest = 0;
    for (const RayRange& half : left_) rest += costs_.before(half.end) - costs_.before(half.first);
    const std::uint64_t begin = begin_small_ ? most_ >> (taken_ < devices_ ? 2 : taken_ < 2 * devices_ ? 1 : 0) : most_;
    const std::uint64_t end = shrinks_ ? rest / devices_ / 2 : most_;
    const std::uint64_t smallest = begin_small_ ? most_ / 4 : most_ / 2;
    const std::uint64_t size = std::clamp(std::min(begin, end), std::max(smallest, std::min(most_, least_)), most_);
    RayRange& half = left_[taken_++ % left_.size()];
    RayRange part{half.first, std::min(costs_.end(half.first, size), half.end)};
    if (costs_.before(half.end) - costs_.before(part.end) < size / 4)
        part.end = half.end;  // which would be left for another
    half.first = part.end;
    return part;
}

}  // namespace csgrt
