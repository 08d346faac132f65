// Sums along rays: what the intervals of rays inside a region add to its volume, its area and its moments.
#pragma once

#include <array>

#include "analysis/vector.hpp"

namespace csgrt::analysis {

/// The sums of one region, relative to a point of its own, so that a small region far from the origin keeps its digits.
struct Sums {
    double volume = 0;
    double others = 0;  ///< the volume of what it claims and others own
    double area = 0;
    Vec3 first = {};                    ///< the integral of the position
    std::array<double, 6> second = {};  ///< the integrals of xx, yy, zz, xy, yz, zx
    double rows = 0;                    ///< number of intervals

    /// Adds the interval of a ray around `middle`, with the direction d. The integral of x y along it is
    /// L (m_x m_y + L² d_x d_y / 12).
    void add(double length, const Vec3& m, const Vec3& d) {
        volume += length;
        first = first + length * m;
        const double spread = length * length / 12;
        const double mm[] = {m.x * m.x, m.y * m.y, m.z * m.z, m.x * m.y, m.y * m.z, m.z * m.x};
        const double dd[] = {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x};
        for (std::size_t i = 0; i < 6; ++i) second[i] += length * (mm[i] + spread * dd[i]);
        rows += 1;
    }
    /// Adds `by` times the sums, and `by_area` times the area.
    void add(const Sums& s, double by, double by_area) {
        volume += by * s.volume;
        others += by * s.others;
        area += by_area * s.area;
        first = first + by * s.first;
        for (std::size_t i = 0; i < 6; ++i) second[i] += by * s.second[i];
        rows += s.rows;
    }
    Sums scaled(double by) const {
        Sums s;
        s.add(*this, by, by);
        return s;
    }
    /// The sums relative to a point that is `to` away.
    Sums from(const Vec3& to) const {
        const Vec3 d = -1.0 * to, f = first;  // from the new point to the old one
        Sums s = *this;
        s.first = f + volume * d;
        const double a[] = {2 * f.x * d.x,         2 * f.y * d.y,         2 * f.z * d.z,
                            f.x * d.y + f.y * d.x, f.y * d.z + f.z * d.y, f.z * d.x + f.x * d.z};
        const double b[] = {d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x};
        for (std::size_t i = 0; i < 6; ++i) s.second[i] += a[i] + volume * b[i];
        return s;
    }
};

}  // namespace csgrt::analysis
