// Near lookup: finds numbers that are equal except for rounding. Cells are much larger than the differences, so nearly
// always one cell has to be searched.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/prefetch.hpp"

namespace csgrt {

/// A range of cells along one dimension, both limits included.
struct CellRange {
    std::int64_t first, last;
};
/// The cell of a value, in units of cells; centres are at whole numbers.
inline std::int64_t nearest_cell(double at) {
    constexpr double most = 9e18;  // values beyond share a cell
    if (std::isnan(at)) return 0;  // 0 in cells of size 0
    return static_cast<std::int64_t>(std::clamp(at + std::copysign(0.5, at), -most, most));
}
/// The cells that the interval from value - tolerance to value + tolerance touches; centres are at multiples of `cell`.
inline CellRange cells_of(double value, double tolerance, double cell) {
    const double at = value / cell;
    if (std::fabs(at) < 0x1p30) {  // rounding moves the value by less than 1e-6
        const std::int64_t middle = nearest_cell(at);
        if (std::fabs(at - static_cast<double>(middle)) + tolerance / cell < 0.5 - 1e-6) return {middle, middle};
    }
    return {nearest_cell((value - tolerance) / cell), nearest_cell((value + tolerance) / cell)};
}

template <class Cell = std::initializer_list<std::int64_t>>
std::uint64_t cell_hash(const Cell& cell) {
    std::uint64_t hash = 14695981039346656037u;
    for (const std::int64_t value : cell) {
        hash = (hash ^ static_cast<std::uint64_t>(value)) * 1099511628211u;
        hash ^= hash >> 32;
    }
    return hash;
}

/// The hash of a cell with all bits mixed: unmixed hashes of neighbouring cells differ in few bits.
inline std::uint64_t mixed(std::uint64_t hash) { return hash * 0x9e3779b97f4a7c15u; }

/// A table from the hashes of cells to numbers, in one block of memory: a scene has millions of cells, each looked up
/// once or twice.
class CellTable {
public:
    static constexpr std::uint32_t none = 0xffffffff;

    /// The number of a cell; `none` if the cell has no number.
    std::uint32_t find(std::uint64_t hash) const {
        if (slots_.empty()) return none;
        return slots_[slot_of(hash)].number;
    }
    /// Prefetches the memory of a cell's number.
    void prefetch(std::uint64_t hash) const {
        if (!slots_.empty()) prefetch_line(&slots_[first_slot_of(hash)]);
    }
    /// Sets a cell's number and returns the previous one.
    std::uint32_t exchange(std::uint64_t hash, std::uint32_t number) {
        if (2 * count_ >= slots_.size()) grow();
        Slot& slot = slots_[slot_of(hash)];
        const std::uint32_t before = slot.number;
        if (before == none) ++count_;
        slot = {hash, number};
        return before;
    }

    /// Empties the table. The memory is kept, unless it is far larger than the contents: clearing it would waste time.
    void clear() {
        if (slots_.size() > 64 * (count_ + 1)) slots_.clear();
        std::fill(slots_.begin(), slots_.end(), Slot{0, none});
        count_ = 0;
    }

private:
    struct Slot {
        std::uint64_t hash;
        std::uint32_t number;
    };

    std::size_t first_slot_of(std::uint64_t hash) const {
        return static_cast<std::size_t>(mixed(hash)) & (slots_.size() - 1);
    }
    std::size_t slot_of(std::uint64_t hash) const {
        std::size_t i = first_slot_of(hash);
        while (slots_[i].number != none && slots_[i].hash != hash) i = (i + 1) & (slots_.size() - 1);
        return i;
    }
    void grow() {
        std::vector<Slot> old(std::max<std::size_t>(64, 4 * slots_.size()), Slot{0, none});
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.number != none) slots_[slot_of(slot.hash)] = slot;
    }

    std::vector<Slot> slots_;  // a power of two of them
    std::size_t count_ = 0;
};

}  // namespace csgrt
