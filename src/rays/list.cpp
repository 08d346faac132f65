#include "rays/list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <csgrt/error.hpp>

#include "base/parallel.hpp"
#include "rays/grid.hpp"
#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {
namespace {

/// The power of two by which a direction is divided before it is traced, so that its squares, also in float, do not
/// overflow or vanish. 0 for directions of usual length.
int exponent_of(const Vec3& direction) {
    constexpr double usual = 0x1p32;
    const double size = largest(direction);
    if (size < usual && size >= 1 / usual) return 0;
    int exponent = 0;
    std::frexp(size, &exponent);
    return exponent;
}

double times(double x, int exponent) { return exponent == 0 ? x : std::ldexp(x, exponent); }
Vec3 without(const Vec3& d, int exponent) {
    return {times(d.x, -exponent), times(d.y, -exponent), times(d.z, -exponent)};
}

[[noreturn]] void refuse(std::size_t ray, const std::string& fault) {
    throw Error(Status::usage, "ray " + std::to_string(ray) + ": " + fault);
}

std::string range_fault(const RayRange& range) {
    if (range.t_near <= range.t_far) return {};
    return "range is from " + number_text(range.t_near) + " to " + number_text(range.t_far) +
           ", and t_near must not be above t_far";
}

}  // namespace

RayList::RayList(const Rays& rays, const RayRanges& ranges)
    : rays_(rays.list()), ranges_(ranges), size_(rays.size()), is_grid_(rays.grid() != nullptr) {
    if (is_grid_) {
        check_grid(*rays.grid());
        RayGrid grid = *rays.grid();
        if (!grid.is_pinhole) exponent_ = exponent_of(grid.direction);
        grid.direction = without(grid.direction, exponent_);
        put_grid(grid, camera_);
    }
    if (size_ > std::numeric_limits<std::uint32_t>::max() / 2)
        throw Error(Status::usage, "too many rays in one call: shoot them in parts of less than 2^31");
    if (!ranges.each.empty() && ranges.each.size() != size_)
        throw Error(Status::usage, std::to_string(size_) + " rays have " + std::to_string(ranges.each.size()) +
                                       " ranges: give one to each, or one to all");
    if (const std::string fault = range_fault(ranges.all); !fault.empty())
        throw Error(Status::usage, "the rays' " + fault);
    std::atomic<bool> any_scaled{exponent_ != 0};
    for_chunks(std::max(rays_.size(), ranges.each.size()), 16'384, 0,
               [&](std::size_t first, std::size_t last, std::size_t) {
                   bool in_direction = false, scaled = false;
                   for (std::size_t i = first; i < last; ++i) {
                       if (!is_grid_) {
                           const auto& [origin, direction] = rays_[i];
                           if (const std::string fault = ray_fault(origin, direction, in_direction); !fault.empty())
                               refuse(i, fault);
                           scaled = scaled || exponent_of(direction) != 0;
                       }
                       if (ranges.each.empty()) continue;
                       if (const std::string fault = range_fault(ranges.each[i]); !fault.empty())
                           refuse(i, "its " + fault);
                   }
                   if (scaled) any_scaled = true;
               });
    is_any_scaled_ = any_scaled;
}

RayList::RayList(std::span<const Vec3> points)
    : points_(points), ranges_{.all = {0, 0}, .each = {}}, size_(points.size()) {
    for_chunks(size_, 16'384, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            if (!is_finite(points[i]) || largest(points[i]) > Limits::ray_origin)
                throw Error(Status::usage, "point " + std::to_string(i) + ": needs three finite numbers of at most " +
                                               number_text(Limits::ray_origin) + " mm");
    });
}

/// A ray of the list. For a grid its direction is already divided by 2^exponent_.
Ray RayList::ray(std::uint64_t i) const {
    if (is_grid_)
        return ray_of(
            kernel::view_ray(&camera_, static_cast<double>(i % camera_.width), static_cast<double>(i / camera_.width)));
    return points_.empty() ? rays_[i] : Ray{points_[i], {1, 0, 0}};
}

double RayList::scaled(double t) const { return times(t, exponent_); }

void RayList::put_camera(kernel::Frame& frame) const { put_grid(grid_of(camera_), frame); }

kernel::RayRecord RayList::record(std::uint64_t i) const {
    if (!numbers_.empty()) i = numbers_[i];
    i += first_;
    auto [o, d] = ray(i);
    const RayRange& range = ranges_.each.empty() ? ranges_.all : ranges_.each[i];
    int e = exponent_;
    if (is_any_scaled_ && !is_grid_) d = without(d, e = exponent_of(d));
    return {o.x, o.y, o.z, d.x, d.y, d.z, times(range.t_near, e), times(range.t_far, e)};
}

void RayList::restore_lengths(Array<double>& of_rays) const {
    if (!is_any_scaled_) return;
    for (std::size_t i = 0; i < size_; ++i)
        of_rays[i] = times(of_rays[i], is_grid_ ? -exponent_ : -exponent_of(rays_[first_ + i].direction));
}

void RayList::restore_lengths(Partitions& answer) const {
    if (!is_any_scaled_) return;
    for (std::size_t ray = 0; ray < size_; ++ray) {
        const int e = is_grid_ ? exponent_ : exponent_of(rays_[first_ + ray].direction);
        if (e == 0) continue;
        const auto restore = [&](const Array<std::int64_t>& splits, Array<double>& distances) {
            for (auto row = splits[ray]; row < splits[ray + 1]; ++row) {
                double& t = distances[static_cast<std::size_t>(row)];
                t = times(t, -e);
            }
        };
        restore(answer.ray_splits, answer.t_in);
        restore(answer.ray_splits, answer.t_out);
        if (answer.overlap_splits.empty()) continue;
        restore(answer.overlap_splits, answer.overlap_t_in);
        restore(answer.overlap_splits, answer.overlap_t_out);
    }
}

}  // namespace csgrt
