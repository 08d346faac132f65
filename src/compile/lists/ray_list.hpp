// A list of rays as a call brings it -> the kernels' records.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <csgrt/partitions.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

class RayList {
public:
    /// Throws Error (usage) that has the index of the first ray that Limits or its range excludes. What it is given
    /// must outlive it.
    explicit RayList(const Rays& rays, const RayRanges& ranges = {});
    /// Points, as rays along x whose ranges are the points alone.
    explicit RayList(std::span<const Vec3> points);

    std::uint64_t size() const { return numbers_.empty() ? size_ : numbers_.size(); }
    /// The rays of these numbers, which must outlive the list.
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
    /// A direction of unusual length is divided by a power of two, and the range multiplied by it.
    kernel::RayRecord record(std::uint64_t ray) const;
    /// Those of `records.size()` rays from the first on.
    void fill(std::uint64_t first, std::span<kernel::RayRecord> records) const {
        for (kernel::RayRecord& record : records) record = this->record(first++);
    }

    /// Whether devices can make the rays: they are all of a grid, and have one range.
    bool is_grid() const { return is_grid_ && numbers_.empty() && ranges_.each.empty(); }
    /// As kernels make them; see put_grid.
    void put_camera(kernel::Frame& frame) const;
    /// A ray that runs in one of these planes is evaluated on the sides that they keep; nothing else is cut.
    void cut_by(std::span<const kernel::PlaneRecord> planes) { planes_ = planes; }
    void put_planes(kernel::Frame& frame) const {
        std::ranges::copy(planes_, frame.clip);
        frame.clip_count = static_cast<std::uint32_t>(planes_.size());
    }
    RayRange range() const { return {scaled(ranges_.all.t_near), scaled(ranges_.all.t_far)}; }
    /// Of the list's first ray, among the grid's.
    std::uint64_t first() const { return first_; }

    /// Distances in the answer become those in lengths of the rays' own directions.
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
    int exponent_ = 0;        ///< of all directions of a grid, which `camera_` has without it
};

}  // namespace csgrt
