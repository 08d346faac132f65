#include "compile/lists/ray_list.hpp"

#include <atomic>
#include <cmath>
#include <string>

#include <csgrt/error.hpp>

#include "base/parallel.hpp"
#include "scene/range.hpp"

namespace csgrt {
namespace {

/// The power of two that a direction is divided by before it is shot, so that its squares, and floats of it, are
/// numbers. 0 for all of usual length.
int exponent_of(const Vec3& direction) {
    constexpr double usual = 0x1p32;
    const double size = largest(direction);
    if (size < usual && size >= 1 / usual) return 0;
    int exponent = 0;
    std::frexp(size, &exponent);
    return exponent;
}

double scaled(double x, int exponent) { return exponent == 0 ? x : std::ldexp(x, exponent); }

[[noreturn]] void refuse(std::size_t ray, const std::string& fault) {
    throw Error(Status::usage, "ray " + std::to_string(ray) + ": " + fault);
}

}  // namespace

RayList::RayList(std::span<const Ray> rays, const RayRanges& ranges) : rays_(rays), ranges_(ranges) {
    if (!ranges.each.empty() && ranges.each.size() != rays.size())
        throw Error(Status::usage, std::to_string(rays.size()) + " rays have " + std::to_string(ranges.each.size()) +
                                       " ranges: give one to each, or one to all");
    if (const RayRange& all = ranges.all; !(all.t_near <= all.t_far))
        throw Error(Status::usage, "the rays' range is from " + number_text(all.t_near) + " to " +
                                       number_text(all.t_far) + ", and t_near must not be above t_far");
    std::atomic<bool> any_scaled{false};
    for_chunks(rays.size(), 16'384, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        bool in_direction = false, scaled = false;
        for (std::size_t i = first; i < last; ++i) {
            const Ray& ray = rays[i];
            if (const std::string fault = ray_fault(ray.origin, ray.direction, in_direction); !fault.empty())
                refuse(i, fault);
            if (!ranges.each.empty() && !(ranges.each[i].t_near <= ranges.each[i].t_far))
                refuse(i, "its range is from " + number_text(ranges.each[i].t_near) + " to " +
                              number_text(ranges.each[i].t_far) + ", and t_near must not be above t_far");
            scaled = scaled || exponent_of(ray.direction) != 0;
        }
        if (scaled) any_scaled = true;
    });
    is_any_scaled_ = any_scaled;
}

kernel::RayRecord RayList::record(std::uint64_t i) const {
    if (!numbers_.empty()) i = numbers_[i];
    const auto& [o, d] = rays_[i];
    const RayRange& range = ranges_.each.empty() ? ranges_.all : ranges_.each[i];
    const int e = is_any_scaled_ ? exponent_of(d) : 0;
    return {o.x,
            o.y,
            o.z,
            scaled(d.x, -e),
            scaled(d.y, -e),
            scaled(d.z, -e),
            scaled(range.t_near, e),
            scaled(range.t_far, e)};
}

void RayList::restore_lengths(Partitions& answer) const {
    if (!is_any_scaled_) return;
    for (std::size_t ray = 0; ray < rays_.size(); ++ray) {
        const int e = exponent_of(rays_[ray].direction);
        if (e == 0) continue;
        const auto restore = [&](const Array<std::int64_t>& splits, Array<double>& distances) {
            for (auto row = splits[ray]; row < splits[ray + 1]; ++row) {
                double& t = distances[static_cast<std::size_t>(row)];
                t = std::ldexp(t, -e);
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
