// Cells of a regular grid, and the parts of a ray in them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "analysis/estimates.hpp"
#include "analysis/vector.hpp"

namespace csgrt::analysis {

/// The volumes of one region in cells, batch by batch, by the cells' numbers. The i-th replicate is in the batch i
/// % 16. Few batches save memory: with the map they take some 170 bytes for each cell.
using CellSums = std::unordered_map<std::uint32_t, std::array<double, least_batches>>;

/// The cell i, j, k of a grid has the number i + sides[0] (j + sides[1] k).
class CellGrid {
public:
    CellGrid(const Box& box, const std::array<std::uint32_t, 3>& sides) : low_(box.low), sides_(sides) {
        for (std::size_t a = 0; a < 3; ++a)
            steps_[a] = (box.high.*axes[a] - box.low.*axes[a]) / static_cast<double>(sides[a]);
    }

    /// Calls add(cell, length) for the parts of a ray from `in` to `out`. What rounding puts outside of the grid counts
    /// for the cells at its border, and a part as short as rounding for a neighbor. So the lengths sum to the whole,
    /// and a face of a region in a plane of the grid gives the cells beyond it nothing.
    template <class Add>
    void cut(const Ray& ray, double in, double out, const Add& add) const {
        std::array<std::int64_t, 3> at;
        std::array<double, 3> ends;  // where the ray leaves the cell, across each axis
        const auto set_end = [&](std::size_t a) {
            const double origin = ray.origin.*axes[a], d = ray.direction.*axes[a];
            const bool is_last = at[a] == (d > 0 ? std::int64_t(sides_[a]) - 1 : 0);
            const double plane = low_.*axes[a] + static_cast<double>(at[a] + (d > 0)) * steps_[a];
            ends[a] = is_last || d == 0 ? std::numeric_limits<double>::infinity() : (plane - origin) / d;
        };
        for (std::size_t a = 0; a < 3; ++a) {
            const double from_low = ray.origin.*axes[a] + in * ray.direction.*axes[a] - low_.*axes[a];
            const double last = static_cast<double>(sides_[a]) - 1;
            at[a] = steps_[a] > 0 ? static_cast<std::int64_t>(std::clamp(from_low / steps_[a], 0.0, last)) : 0;
            set_end(a);
        }
        const double nothing = 1e-13 * out;
        while (in < out) {
            const auto a = static_cast<std::size_t>(std::min_element(ends.begin(), ends.end()) - ends.begin());
            double end = std::clamp(ends[a], in, out);
            if (end - in < nothing) end = in;
            if (out - end < nothing) end = out;
            if (end > in) add(static_cast<std::uint32_t>(at[0] + sides_[0] * (at[1] + sides_[1] * at[2])), end - in);
            in = end;
            at[a] += ray.direction.*axes[a] > 0 ? 1 : -1;
            set_end(a);
        }
    }

private:
    Vec3 low_;
    std::array<std::uint32_t, 3> sides_;
    std::array<double, 3> steps_ = {};
};

}  // namespace csgrt::analysis
