// Ray list: makes the kernels' records of a caller's rays.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <csgrt/partitions.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

/// A list of rays to trace: the caller's rays, a grid, or points. Nothing is copied; record() makes the kernels' record
/// of a ray when it is needed.
class RayList {
public:
    /// Checks and refers to the rays, which must outlive the list. Throws Error (usage) with the index of the first ray
    /// that Limits excludes, or whose range is wrong.
    explicit RayList(const Rays& rays, const RayRanges& ranges = {});
    /// Makes rays of points: along x, with a range that is the point alone.
    explicit RayList(std::span<const Vec3> points);

    std::uint64_t size() const { return numbers_.empty() ? size_ : numbers_.size(); }
    /// A list of some of the rays, by number; `numbers` must outlive the list.
    RayList some(std::span<const std::uint32_t> numbers) const {
        RayList list = *this;
        list.numbers_ = numbers;
        return list;
    }
    /// Rays [first, first + count).
    RayList part(std::uint64_t first, std::uint64_t count) const {
        RayList list = *this;
        list.first_ += first;
        list.size_ = count;
        return list;
    }
    /// The record of a ray. A direction of unusual length is divided by a power of two, and the range is multiplied by
    /// the same power.
    kernel::RayRecord record(std::uint64_t ray) const;
    /// Fills `records` with the records of the rays from `first` on.
    void fill(std::uint64_t first, std::span<kernel::RayRecord> records) const {
        for (kernel::RayRecord& record : records) record = this->record(first++);
    }

    /// Whether devices can make the rays: all rays are of a grid, and have one range.
    bool is_grid() const { return is_grid_ && numbers_.empty() && ranges_.each.empty(); }
    /// Sets the camera with which kernels make the rays; see put_grid.
    void put_camera(kernel::Frame& frame) const;
    /// Sets planes of a view. They have an effect only on a ray that runs in one of them: it is evaluated on the sides
    /// that the plane keeps.
    void cut_by(std::span<const kernel::PlaneRecord> planes) { planes_ = planes; }
    void put_planes(kernel::Frame& frame) const {
        std::ranges::copy(planes_, frame.clip);
        frame.clip_count = static_cast<std::uint32_t>(planes_.size());
    }
    RayRange range() const { return {scaled(ranges_.all.t_near), scaled(ranges_.all.t_far)}; }
    /// The number of the list's first ray among the rays of the grid.
    std::uint64_t first() const { return first_; }

    /// Converts the answer's distances back to units of the rays' original directions.
    void restore_lengths(Partitions& answer) const;
    void restore_lengths(Array<double>& of_rays) const;

private:
    double scaled(double t) const;
    Ray ray(std::uint64_t i) const;

    std::span<const Ray> rays_;
    std::span<const Vec3> points_;
    RayRanges ranges_;
    std::span<const std::uint32_t> numbers_;  ///< empty: all rays
    std::span<const kernel::PlaneRecord> planes_;
    std::uint64_t first_ = 0, size_ = 0;
    bool is_grid_ = false, is_any_scaled_ = false;
    kernel::Frame camera_{};  ///< of a grid
    int exponent_ = 0;        ///< the directions of a grid are divided by 2^exponent_, in `camera_`, too
};

}  // namespace csgrt
