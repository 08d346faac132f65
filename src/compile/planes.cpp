#include "compile/planes.hpp"

#include <algorithm>
#include <cmath>

#include "compile/cells.hpp"
#include "compile/linear.hpp"

namespace csgrt {

namespace {

constexpr std::uint32_t none = 0xffffffff;

// Cells have their centres at 0 and +-1, where most normals of models lie.
constexpr double normal_cell = 1e-7;
constexpr double offset_cell = 1e-7;  // of the scene's radius

Plane flipped(const Plane& p) { return {{0.0 - p.normal.x, 0.0 - p.normal.y, 0.0 - p.normal.z}, 0.0 - p.distance}; }

/// Where a plane of normal n lies farthest apart from another over a box, given the difference of the two.
double separation(const Wide& normal, long double distance, const Box& box) {
    long double low = -distance, high = -distance;
    for (int axis = 0; axis < 3; ++axis) {
        const long double a = normal[axis] * wide(box.low)[axis], b = normal[axis] * wide(box.high)[axis];
        low += std::min(a, b);
        high += std::max(a, b);
    }
    return static_cast<double>(std::max(std::fabs(low), std::fabs(high)));
}

}  // namespace

/// Signed distance from the centre of the scene.
double PlaneTable::offset(const Plane& plane) const {
    return static_cast<double>(plane.distance - glm::dot(wide(plane.normal), wide(center_)));
}

bool PlaneTable::same(std::uint32_t record, const Plane& plane, const Box& box) const {
    const kernel::PlaneRecord& r = records_[record];
    const Wide normal = Wide(r.nx, r.ny, r.nz) - wide(plane.normal);
    if (std::fabs(normal.x) > tilt || std::fabs(normal.y) > tilt || std::fabs(normal.z) > tilt) return false;
    const long double distance = static_cast<long double>(r.d) - plane.distance;
    if (normal == Wide(0) && distance == 0) return true;
    const Box& other = entries_[record].box;
    const double limit = gap * std::min(diagonal(box), diagonal(other));
    return separation(normal, distance, box) <= limit && separation(normal, distance, other) <= limit;
}

std::uint32_t PlaneTable::find(const Plane& plane, const Box& box) const {
    // Both boxes lie in the scene, where a tilt moves a plane by tilt x radius at most.
    const double reach = (3 * tilt + gap) * radius_;
    const CellRange x = cells_of(plane.normal.x, tilt, normal_cell), y = cells_of(plane.normal.y, tilt, normal_cell);
    const CellRange z = cells_of(plane.normal.z, tilt, normal_cell);
    const CellRange d = cells_of(offset(plane), reach, offset_cell * radius_);
    std::uint32_t found = none;
    for (std::int64_t i = x.first; i <= x.last; ++i)
        for (std::int64_t j = y.first; j <= y.last; ++j)
            for (std::int64_t k = z.first; k <= z.last; ++k)
                for (std::int64_t l = d.first; l <= d.last; ++l) {
                    const auto cell = cells_.find(cell_hash({i, j, k, l}));
                    if (cell == cells_.end()) continue;
                    for (std::uint32_t record = cell->second; record != none; record = entries_[record].next)
                        if (same(record, plane, box)) found = std::min(found, record);
                }
    return found;
}

kernel::PlaneRef PlaneTable::add(const Plane& plane, const Box& box) {
    if (const std::uint32_t record = find(plane, box); record != none) return record << 1;
    if (const std::uint32_t record = find(flipped(plane), box); record != none) return record << 1 | 1u;

    const auto record = static_cast<std::uint32_t>(records_.size());
    if (record > 0x7fffffffu) throw Error(Status::scene, "the scene has more than 2147483647 different planes");
    records_.push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.distance});
    const std::uint64_t cell = cell_hash(
        {cells_of(plane.normal.x, 0, normal_cell).first, cells_of(plane.normal.y, 0, normal_cell).first,
         cells_of(plane.normal.z, 0, normal_cell).first, cells_of(offset(plane), 0, offset_cell * radius_).first});
    const auto [entry, added] = cells_.emplace(cell, record);
    entries_.push_back({box, added ? none : entry->second});
    entry->second = record;
    return record << 1;
}

}  // namespace csgrt
