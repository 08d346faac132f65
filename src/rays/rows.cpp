#include "rays/rows.hpp"

namespace csgrt {

RowMemory::RowMemory(const RowView& rows) : places(rows.places.begin(), rows.places.end()) {
    const auto copy = [&](auto& to, const auto* from) {
        if (from) to.assign(from, from + rows.rows());
    };
    copy(regions, rows.regions);
    copy(in, rows.in);
    copy(out, rows.out);
    copy(in_solids, rows.in_solids);
    copy(out_solids, rows.out_solids);
    copy(in_normals, rows.in_normals);
    copy(out_normals, rows.out_normals);
    overlaps.assign(rows.overlaps.begin(), rows.overlaps.end());
    overlap_regions.assign(rows.overlap_regions.begin(), rows.overlap_regions.end());
}

void RowMemory::reserve(std::size_t rows, Fields fields) {
    room_for(regions, rows);
    room_for(in, rows);
    room_for(out, rows);
    if (fields.solids) {
        room_for(in_solids, rows);
        room_for(out_solids, rows);
    }
    if (fields.normals) {
        room_for(in_normals, rows);
        room_for(out_normals, rows);
    }
    overlaps.clear();
    overlap_regions.clear();
}

RowView RowMemory::view(std::uint64_t first, std::size_t rays, Fields fields) const {
    return {.first = first,
            .places = std::span(places).first(rays + 1),
            .regions = regions.data(),
            .in = in.data(),
            .out = out.data(),
            .in_solids = fields.solids ? in_solids.data() : nullptr,
            .out_solids = fields.solids ? out_solids.data() : nullptr,
            .in_normals = fields.normals ? in_normals.data() : nullptr,
            .out_normals = fields.normals ? out_normals.data() : nullptr,
            .overlaps = overlaps,
            .overlap_regions = overlap_regions};
}

std::size_t RowMemory::bytes() const {
    return places.size() * sizeof(kernel::RayCount) + regions.size() * (sizeof(std::int32_t) + 2 * sizeof(double)) +
           2 * in_solids.size() * sizeof(std::int32_t) + 2 * in_normals.size() * sizeof(Vec3) +
           overlaps.size() * sizeof(OverlapRow) + overlap_regions.size() * sizeof(std::int32_t);
}

}  // namespace csgrt
