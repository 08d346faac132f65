#include "compile/solids/planes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

constexpr std::uint32_t none = CellTable::none;

// The cell's size for normals. Cells have their centres at 0 and +-1, where most normals of models lie.
constexpr double normal_cell = 1e-7;

Plane flipped(const Plane& p) { return {{0.0 - p.normal.x, 0.0 - p.normal.y, 0.0 - p.normal.z}, 0.0 - p.distance}; }

/// The side of space on which a normal lies, positive or negative. With it a plane and its reverse are looked up as one
/// plane.
double facing(const Vec3& n) { return n.x + 0.61 * n.y + 0.37 * n.z; }

/// Could rounding decide the side?
bool faces_both(const Plane& plane) { return std::fabs(facing(plane.normal)) <= 4 * PlaneTable::tilt; }

constexpr double axis_tilt = 1e-15;

/// 1, 2 or 3 if the normal is that axis, with no component farther off than axis_tilt; else 0.
std::uint8_t axis_of(const Vec3& n) {
    const bool x0 = std::fabs(n.x) <= axis_tilt, y0 = std::fabs(n.y) <= axis_tilt, z0 = std::fabs(n.z) <= axis_tilt;
    if (y0 && z0 && std::fabs(n.x - 1) <= axis_tilt) return 1;
    if (x0 && z0 && std::fabs(n.y - 1) <= axis_tilt) return 2;
    if (x0 && y0 && std::fabs(n.z - 1) <= axis_tilt) return 3;
    return 0;
}

/// The largest distance of two planes over a box. `normal`, `distance`: the difference of the two planes.
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

/// The limit on the difference of offsets of two equal planes that are perpendicular to the same axis, over `box`. Only
/// the distance of such planes is compared. It has a margin for the difference of the normals, anywhere in the scene,
/// and for rounding.
double PlaneTable::parallel_reach(const Key& key, const Box& box) const {
    return 2 * gap * diagonal(box) + 2 * rounding_ + 10 * axis_tilt * radius_ + 1e-15 * std::fabs(key.offset);
}

double PlaneTable::limit(const Box& a, const Box& b) const {
    const double farthest = std::max(largest_coordinate(a), largest_coordinate(b));
    return std::max(gap * std::min(diagonal(a), diagonal(b)), coordinate_rounding * farthest);
}

bool PlaneTable::same(const Entry& entry, const Plane& plane, const Box& box) const {
    const Vec3 &a = entry.normal, &b = plane.normal;
    if (std::fabs(a.x - b.x) > tilt || std::fabs(a.y - b.y) > tilt || std::fabs(a.z - b.z) > tilt) return false;
    const Wide normal = wide(a) - wide(b);
    const long double distance = static_cast<long double>(entry.distance) - plane.distance;
    if (normal == Wide(0) && distance == 0) return true;
    const double most = limit(box, entry.box);
    return separation(normal, distance, box) <= most && separation(normal, distance, entry.box) <= most;
}

PlaneTable::Key PlaneTable::key_of(const Plane& plane) const {
    Key key;
    key.flipped = facing(plane.normal) < 0;
    key.one = key.flipped ? flipped(plane) : plane;
    key.offset = offset(key.one);
    key.axis = axis_of(key.one.normal);
    const Vec3& n = key.one.normal;
    const CellRange ranges[] = {cells_of(n.x, tilt, normal_cell), cells_of(n.y, tilt, normal_cell),
                                cells_of(n.z, tilt, normal_cell), cells_of(key.offset, offset_reach_, offset_cell_)};
    key.alone = std::all_of(std::begin(ranges), std::end(ranges), [](const CellRange& r) { return r.first == r.last; });
    key.cell = cell_hash({cells_of(n.x, 0, normal_cell).first, cells_of(n.y, 0, normal_cell).first,
                          cells_of(n.z, 0, normal_cell).first, cells_of(key.offset, 0, offset_cell_).first});
    return key;
}

void PlaneTable::add_to(Shards::Chunk& chunk, const Key& key, const Box& box, std::size_t planes) const {
    // The cells are small, since many normals are equal; but they are so large that few planes lie near a border, so
    // that most shards are not joined.
    const double part_of_radius =
        std::max(1.0 / 8192, 4 * offset_reach_ / radius_ * static_cast<double>(planes) / (Shards::count / 16));
    // It is enough if one of two equal planes is looked up in the cell of the other. So planes perpendicular to an
    // axis, which are many where solids stand on one plate, need only the limit for each other. The other planes use a
    // limit that also finds those.
    const double reach = key.axis ? parallel_reach(key, box) : 2 * offset_reach_;
    const auto cells = [&](const Vec3& n, double offset) {
        constexpr double normal = 0.25;
        return std::array<Shards::Chunk::Dimension, 4>{{{n.x, 2 * tilt, normal},
                                                        {n.y, 2 * tilt, normal},
                                                        {n.z, 2 * tilt, normal},
                                                        {offset, reach, part_of_radius * radius_}}};
    };
    chunk.add(cells(key.one.normal, key.offset));
    if (faces_both(key.one)) chunk.look_also(cells(flipped(key.one).normal, -key.offset));
}

std::uint32_t PlaneTable::find_in_cell(std::uint64_t cell, const Key& key, const Box& box) const {
    const double reach_across = key.axis ? parallel_reach(key, box) : offset_reach_;
    std::uint32_t found = none;
    for (std::uint32_t record = cells_.find(cell); record != none; record = links_[record].next) {
        const Link& link = links_[record];
        const bool is_near =
            std::fabs(link.offset - key.offset) <= (link.axis && link.axis == key.axis ? reach_across : offset_reach_);
        if (is_near && record < found && same(entries_[record], key.one, box)) found = record;
    }
    return found;
}

/// The first record of an equal plane that faces the same way.
std::uint32_t PlaneTable::find(const Key& key, const Box& box) const {
    if (key.alone) return find_in_cell(key.cell, key, box);
    const Vec3& n = key.one.normal;
    const CellRange x = cells_of(n.x, tilt, normal_cell), y = cells_of(n.y, tilt, normal_cell);
    const CellRange z = cells_of(n.z, tilt, normal_cell);
    const CellRange d = cells_of(key.offset, offset_reach_, offset_cell_);
    std::uint32_t found = none;
    for (std::int64_t i = x.first; i <= x.last; ++i)
        for (std::int64_t j = y.first; j <= y.last; ++j)
            for (std::int64_t k = z.first; k <= z.last; ++k)
                for (std::int64_t l = d.first; l <= d.last; ++l)
                    found = std::min(found, find_in_cell(cell_hash({i, j, k, l}), key, box));
    return found;
}

kernel::PlaneRecord PlaneTable::record_of(const Key& key) {
    const Plane plane = key.flipped ? flipped(key.one) : key.one;
    return {plane.normal.x, plane.normal.y, plane.normal.z, plane.distance};
}

std::vector<kernel::PlaneRecord> PlaneTable::records() const {
    std::vector<kernel::PlaneRecord> all;
    all.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        Key key;
        key.one = {entry.normal, entry.distance};
        key.flipped = entry.flipped;
        all.push_back(record_of(key));
    }
    return all;
}

void PlaneTable::check_count(std::size_t records) {
    if (records > 0x7fffffffu) throw Error(Status::scene, "the scene has more than 2147483647 different planes");
}

kernel::PlaneRef PlaneTable::add_keyed(const Key& key, const Box& box) {
    std::uint32_t found = find(key, box);
    bool opposite = false;
    if (faces_both(key.one)) {
        // The equal plane may have been stored as a plane on the other side.
        Key other = key;
        other.one = flipped(key.one);
        other.offset = -key.offset;
        other.axis = 0;
        other.alone = false;
        const std::uint32_t there = find(other, box);
        opposite = there < found;
        found = std::min(found, there);
    }
    if (found != none) return found << 1 | static_cast<std::uint32_t>(key.flipped ^ entries_[found].flipped ^ opposite);

    const auto record = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({key.one.normal, key.one.distance, key.flipped, box});
    links_.push_back({key.offset, cells_.exchange(key.cell, record), key.axis});
    return record << 1;
}

kernel::PlaneRecord shared_plane(const CompiledScene& scene, const Plane& plane) {
    const double reach = scene.radius > 0 ? scene.radius : 1;
    const Vec3 to_corner{reach, reach, reach};
    const Box box{scene.center - to_corner, scene.center + to_corner};
    const double farthest = std::max(PlaneTable::gap * diagonal(box), coordinate_rounding * largest_coordinate(box));
    const auto is_near = [&](const kernel::PlaneRecord& p) {
        const double side = p.nx * plane.normal.x + p.ny * plane.normal.y + p.nz * plane.normal.z < 0 ? -1 : 1;
        const Vec3 off = side * Vec3{p.nx, p.ny, p.nz} - plane.normal;
        return std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)}) <= PlaneTable::tilt &&
               separation(wide(off), static_cast<long double>(side * p.d) - plane.distance, box) <= farthest;
    };
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < scene.planes.size(); ++i)
        if (is_near(scene.planes[i])) near.push_back(i);
    PlaneTable table(scene.center, scene.radius);
    if (!near.empty()) {
        for (std::size_t solid = 0; solid < scene.solids.size(); ++solid) {
            const kernel::SolidRecord& record = scene.solids[solid];
            const Box& own = scene.solid_boxes[solid];
            for (std::uint32_t i = 0; i < record.plane_count; ++i) {
                const std::uint32_t ref = scene.words[record.first_plane + i] >> 1;
                if (!std::binary_search(near.begin(), near.end(), ref)) continue;
                const kernel::PlaneRecord& p = scene.planes[ref];
                table.add({{p.nx, p.ny, p.nz}, p.d}, is_finite(own) ? own : box);
            }
        }
    }
    const std::size_t known = table.size();
    const kernel::PlaneRef found = table.add(plane, box);
    if (found >> 1 >= known) return {plane.normal.x, plane.normal.y, plane.normal.z, plane.distance};
    const kernel::PlaneRecord p = table.records()[found >> 1];
    return found & 1u ? kernel::PlaneRecord{-p.nx, -p.ny, -p.nz, -p.d} : p;
}

}  // namespace csgrt
