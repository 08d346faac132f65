#include "compile/planes.hpp"

#include <algorithm>
#include <cmath>

#include "compile/linear.hpp"

namespace csgrt {

namespace {

constexpr std::uint32_t none = CellTable::none;

// Cells have their centres at 0 and +-1, where most normals of models lie.
constexpr double normal_cell = 1e-7;
constexpr double offset_cell = 1.5e-8;  // of the scene's radius

Plane flipped(const Plane& p) { return {{0.0 - p.normal.x, 0.0 - p.normal.y, 0.0 - p.normal.z}, 0.0 - p.distance}; }

/// Positive or negative: on which side of space a normal lies, so that a plane and the one that looks the other way are
/// looked up once.
double facing(const Vec3& n) { return n.x + 0.61 * n.y + 0.37 * n.z; }

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

bool PlaneTable::same(const Entry& entry, const Plane& plane, const Box& box) const {
    const Vec3 &a = entry.normal, &b = plane.normal;
    if (std::fabs(a.x - b.x) > tilt || std::fabs(a.y - b.y) > tilt || std::fabs(a.z - b.z) > tilt) return false;
    const Wide normal = wide(a) - wide(b);
    const long double distance = static_cast<long double>(entry.distance) - plane.distance;
    if (normal == Wide(0) && distance == 0) return true;
    const double limit = gap * std::min(diagonal(box), diagonal(entry.box));
    return separation(normal, distance, box) <= limit && separation(normal, distance, entry.box) <= limit;
}

/// The first record of that plane, which looks the same way.
std::uint32_t PlaneTable::find(const Plane& plane, const Box& box) const {
    // Both boxes lie in the scene, where a tilt moves a plane by tilt x radius at most.
    const double reach = (3 * tilt + gap) * radius_, at = offset(plane);
    const CellRange x = cells_of(plane.normal.x, tilt, normal_cell), y = cells_of(plane.normal.y, tilt, normal_cell);
    const CellRange z = cells_of(plane.normal.z, tilt, normal_cell);
    const CellRange d = cells_of(at, reach, offset_cell * radius_);
    std::uint32_t found = none;
    for (std::int64_t i = x.first; i <= x.last; ++i)
        for (std::int64_t j = y.first; j <= y.last; ++j)
            for (std::int64_t k = z.first; k <= z.last; ++k)
                for (std::int64_t l = d.first; l <= d.last; ++l) {
                    std::uint32_t record = cells_.find(cell_hash({i, j, k, l}));
                    for (; record != none; record = entries_[record].next) {
                        const Entry& entry = entries_[record];
                        if (std::fabs(entry.offset - at) <= reach && record < found && same(entry, plane, box))
                            found = record;
                    }
                }
    return found;
}

kernel::PlaneRef PlaneTable::add(const Plane& plane, const Box& box) {
    const double side = facing(plane.normal);
    const bool is_flipped = side < 0;
    const Plane one = is_flipped ? flipped(plane) : plane;
    std::uint32_t found = find(one, box);
    bool opposite = false;
    if (std::fabs(side) <= 4 * tilt) {
        // Another may have been taken for one on the other side.
        const std::uint32_t other = find(flipped(one), box);
        opposite = other < found;
        found = std::min(found, other);
    }
    if (found != none) return found << 1 | static_cast<std::uint32_t>(is_flipped ^ entries_[found].flipped ^ opposite);

    const auto record = static_cast<std::uint32_t>(records_.size());
    if (record > 0x7fffffffu) throw Error(Status::scene, "the scene has more than 2147483647 different planes");
    records_.push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.distance});
    const double at = offset(one);
    const std::uint64_t cell =
        cell_hash({cells_of(one.normal.x, 0, normal_cell).first, cells_of(one.normal.y, 0, normal_cell).first,
                   cells_of(one.normal.z, 0, normal_cell).first, cells_of(at, 0, offset_cell * radius_).first});
    entries_.push_back({one.normal, one.distance, at, cells_.exchange(cell, record), is_flipped, box});
    return record << 1;
}

}  // namespace csgrt
