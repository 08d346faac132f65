// Looking numbers up that may differ by rounding: cells much larger than what is looked for, so that one cell is
// enough, nearly always.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace csgrt {

struct CellRange {
    std::int64_t first, last;
};
/// The cells that value - tolerance to value + tolerance touches; centres are at multiples of `cell`.
inline CellRange cells_of(double value, double tolerance, double cell) {
    constexpr double most = 9e18;  // those beyond share a cell
    return {std::llround(std::clamp((value - tolerance) / cell, -most, most)),
            std::llround(std::clamp((value + tolerance) / cell, -most, most))};
}

inline std::uint64_t cell_hash(std::initializer_list<std::int64_t> cell) {
    std::uint64_t hash = 14695981039346656037u;
    for (const std::int64_t value : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(value)) * 1099511628211u;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace csgrt
