// Rows: the answer of a batch of a list's rays, ray by ray. Kernel 6 and the reference write rows; RowCollector copies
// batches into the caller's arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <csgrt/partitions.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

/// A part of a ray that several regions claim. Their numbers are stored from `first_region` on, up to the next row's.
struct OverlapRow {
    double in, out;
    std::uint32_t ray;  ///< number within the batch
    std::size_t first_region;
};

/// Pointers to a batch's rows. Arrays that the caller does not want are null.
struct RowView {
    std::uint64_t first = 0;                   ///< number of the batch's first ray in the list
    std::span<const kernel::RayCount> places;  ///< one a ray, and one more: the number of rows before it, in `segments`
    const std::int32_t* regions = nullptr;
    const double *in = nullptr, *out = nullptr;
    const std::int32_t *in_solids = nullptr, *out_solids = nullptr;
    const Vec3 *in_normals = nullptr, *out_normals = nullptr;
    std::span<const OverlapRow> overlaps;
    std::span<const std::int32_t> overlap_regions;

    std::size_t rays() const { return places.size() - 1; }
    std::size_t rows() const { return places.back().segments; }
};

/// Memory for rows, which is used for one batch after another.
struct RowMemory {
    std::vector<kernel::RayCount> places;
    std::vector<std::int32_t> regions, in_solids, out_solids;
    std::vector<double> in, out;
    std::vector<Vec3> in_normals, out_normals;
    std::vector<OverlapRow> overlaps;
    std::vector<std::int32_t> overlap_regions;

    RowMemory() = default;
    explicit RowMemory(const RowView& rows);
    void reserve(std::size_t rows, Fields fields);
    RowView view(std::uint64_t first, std::size_t rays, Fields fields) const;
    std::size_t bytes() const;
};

/// Grows `memory` to at least `size` elements; keeps the contents.
template <class T>
T* room_for(std::vector<T>& memory, std::size_t size) {
    if (memory.size() < size) memory.resize(size + size / 4);
    return memory.data();
}

}  // namespace csgrt
