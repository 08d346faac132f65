// Frames of rays: replicates of shifted grids in turned frames, whose random numbers are functions of a seed and of the
// numbers of what they are for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <csgrt/rays.hpp>

#include "analysis/vector.hpp"

namespace csgrt::analysis {

/// Random numbers by counting: the n-th one is a hash of n and the key (SplitMix64).
class Random {
public:
    explicit Random(std::initializer_list<std::uint64_t> key) {
        for (const std::uint64_t word : key) state_ = mixed(state_ ^ word);
    }
    /// In [0, 1).
    double next() { return static_cast<double>(mixed(state_ += step) >> 11) * 0x1p-53; }

private:
    static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;
    static std::uint64_t mixed(std::uint64_t z) {
        z += step;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    std::uint64_t state_ = 0;
};

/// Three perpendicular unit vectors, uniform among all rotations: the columns of a random unit quaternion's matrix. The
/// quaternion is Marsaglia's, of two points in the unit circle, without functions that libraries round differently.
inline std::array<Vec3, 3> random_frame(Random& random) {
    double a[2], b[2], s[2];
    for (int i = 0; i < 2; ++i) do {
            a[i] = 2 * random.next() - 1;
            b[i] = 2 * random.next() - 1;
            s[i] = a[i] * a[i] + b[i] * b[i];
        } while (s[i] >= 1 || s[i] == 0);
    const double root = std::sqrt((1 - s[0]) / s[1]), x = a[0], y = b[0], z = a[1] * root, w = b[1] * root;
    return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

/// A grid of rays along one direction of a frame, which covers a box. Ray i has the column i % columns and the row
/// i / columns.
struct Grid {
    Vec3 corner = {};          ///< the origin of ray 0
    Vec3 direction = {};       ///< a unit vector
    Vec3 right = {}, up = {};  ///< from a ray to the next one
    std::uint32_t columns = 0, rows = 0;
    double cell = 0;    ///< mm²: the area that each ray stands for
    double length = 0;  ///< mm: beyond it is no more of the box

    Box box = {};  ///< a little larger than what the grid covers

    std::uint64_t size() const { return std::uint64_t(columns) * rows; }
    double diagonal() const { return dot(right, right) + dot(up, up); }  ///< mm²: of a cell, squared
    /// Whether a ray of the grid meets the box.
    bool meets(const Ray& ray) const {
        double in = 0, out = length;
        for (double Vec3::*const axis : axes) {
            const double by = 1 / direction.*axis;
            const double a = (box.low.*axis - ray.origin.*axis) * by, b = (box.high.*axis - ray.origin.*axis) * by;
            in = std::max(in, std::min(a, b));
            out = std::min(out, std::max(a, b));
        }
        return in <= out;
    }
    Ray ray(std::uint64_t i) const {
        return {corner + double(i % columns) * right + double(i / columns) * up, direction};
    }
};

/// The three grids of a replicate. `rays`: how many of each meet the box, about. A grid is one period of an endless
/// lattice whose cells tile the box's shadow, so the shift by less than a cell leaves no part of the shadow out.
inline std::array<Grid, 3> grids_of(const Box& box, double rays, Random& random) {
    constexpr double most_of_shadow = 64;  // a long box has a small shadow across its window
    const Vec3 half = 0.5 * (box.high - box.low), center = box.low + half;
    const double margin = 1e-3 * length(half);
    const std::array<Vec3, 3> frame = random_frame(random);
    std::array<Grid, 3> grids;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = frame[k], u = frame[(k + 1) % 3], v = frame[(k + 2) % 3];
        const auto reach = [&half](const Vec3& a) {
            return std::abs(a.x) * half.x + std::abs(a.y) * half.y + std::abs(a.z) * half.z;
        };
        const double width = 2 * reach(u), height = 2 * reach(v), depth = reach(d) + margin;
        Grid& g = grids[k];
        const double shadow =
            4 * (std::abs(d.x) * half.y * half.z + std::abs(d.y) * half.z * half.x + std::abs(d.z) * half.x * half.y);
        const double all = rays * std::min(width * height / shadow, most_of_shadow);
        const double columns = std::clamp(std::round(std::sqrt(all * width / height)), 1.0, std::min(all, 0x1p31));
        g.columns = static_cast<std::uint32_t>(columns);
        g.rows = static_cast<std::uint32_t>(std::clamp(std::round(all / columns), 1.0, 0x1p31));
        g.direction = d;
        g.right = width / g.columns * u;
        g.up = height / g.rows * v;
        g.cell = width / g.columns * (height / g.rows);
        g.length = 2 * depth;
        const Vec3 more = {1e-6 * margin, 1e-6 * margin, 1e-6 * margin};
        g.box = {box.low - more, box.high + more};
        const double shift_right = random.next() * width / g.columns, shift_up = random.next() * height / g.rows;
        g.corner = center - depth * d + (shift_right - width / 2) * u + (shift_up - height / 2) * v;
    }
    return grids;
}

}  // namespace csgrt::analysis
