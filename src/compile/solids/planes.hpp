// Plane table: the one table of planes in the world. Faces, end caps and half-spaces that lie in one plane share its
// record, so that a ray meets them at the very same distance.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/solids/meshes/near_lookup.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "compile/shards.hpp"

namespace csgrt {

/// The table finds the record of a plane among the records of the scene, within the rounding of the model's numbers. A
/// plane and its reverse share one record; the flip of a reference tells which of the two is meant.
class PlaneTable {
public:
    /// The limit of distance: two planes are one if over the boxes of their two solids they lie no farther apart than
    /// this, relative to the smaller box's diagonal. Rounding of a model's own numbers and matrices is below the limit;
    /// a modelled gap is far above it. Far from the origin rounding is larger, and coordinate_rounding (linear.hpp) is
    /// the limit.
    static constexpr double gap = 1e-10;
    /// The limit of tilt: unit normals of equal planes differ by no more than this in any component, which keeps the
    /// search local.
    static constexpr double tilt = 1e-9;

    /// Makes an empty table. `center`, `radius`: a sphere around the scene; distances are looked up relative to it.
    PlaneTable(const Vec3& center, double radius)
        : center_(center),
          radius_(radius),
          rounding_(coordinate_rounding * largest_coordinate(center, radius)),
          offset_reach_(offset_reach * radius + rounding_),
          offset_cell_(offset_cell * radius + 4 * rounding_) {}

    /// The key under which a plane is looked up. It depends only on the plane, so several threads may compute keys
    /// ahead.
    struct Key {
        Plane one;          ///< the plane or its reverse: see facing()
        double offset = 0;  ///< of `one` from the scene's centre
        std::uint64_t cell = 0;
        bool flipped = false;   ///< `one` is the reverse of the plane
        bool alone = false;     ///< no equal plane lies in another cell
        std::uint8_t axis = 0;  ///< 1, 2, 3: the normal of `one` is x, y or z, within rounding
    };
    Key key_of(const Plane& plane) const;
    static kernel::PlaneRecord record_of(const Key& key);
    /// Adds to a chunk the position at which the plane of a solid in `box` is looked up: planes that may be equal share
    /// a shard. `planes`: the approximate number of planes in all.
    void add_to(Shards::Chunk& chunk, const Key& key, const Box& box, std::size_t planes) const;

    /// The record of a face of the solid in `box`: an earlier record if it has this plane or its reverse.
    kernel::PlaneRef add_keyed(const Key& key, const Box& box);
    kernel::PlaneRef add(const Plane& plane, const Box& box) { return add_keyed(key_of(plane), box); }

    /// Throws Error (scene) if there are more records than references can number.
    static void check_count(std::size_t records);
    std::size_t size() const { return entries_.size(); }
    /// Reserves memory for so many planes, so that the vectors need not grow and be copied.
    void reserve(std::size_t planes) {
        entries_.reserve(planes);
        links_.reserve(planes);
    }
    /// Removes the planes; keeps the memory.
    void clear() {
        entries_.clear();
        links_.clear();
        cells_.clear();
    }
    std::vector<kernel::PlaneRecord> records() const;
    /// Prefetches the memory where the search for a plane begins.
    void prefetch(const Key& key) const { cells_.prefetch(key.cell); }

private:
    /// A record as it is looked up: on one side of space, see facing().
    struct Entry {
        Vec3 normal;
        double distance;  ///< from the origin
        bool flipped;     ///< relative to the record
        Box box;          ///< of the first solid with the plane
    };
    /// The data that the search reads first, apart from the rest, because a cell may have many parallel planes.
    struct Link {
        double offset;       ///< from the scene's centre
        std::uint32_t next;  ///< next entry in the same cell
        std::uint8_t axis;   ///< as in Key
    };

    std::uint32_t find(const Key& key, const Box& box) const;
    std::uint32_t find_in_cell(std::uint64_t cell, const Key& key, const Box& box) const;
    bool same(const Entry& entry, const Plane& plane, const Box& box) const;
    double offset(const Plane& plane) const;
    double limit(const Box& a, const Box& b) const;
    double parallel_reach(const Key& key, const Box& box) const;

    // The cell's size for offsets, in parts of the scene's radius. The boxes of solids lie in the scene, where a tilt
    // moves a plane by tilt x radius at most.
    static constexpr double offset_cell = 1.5e-8, offset_reach = 3 * tilt + gap;

    Vec3 center_;
    double radius_;
    double rounding_;  ///< of coordinates in the scene
    double offset_reach_, offset_cell_;
    std::vector<Entry> entries_;
    std::vector<Link> links_;  ///< one an entry
    CellTable cells_;          ///< the last record of each cell
};

/// A plane of a view. If a half-space in the model would share a record with this plane, the plane gets the numbers of
/// the half-space's record. So a ray meets the two at the very same distance.
kernel::PlaneRecord shared_plane(const CompiledScene& scene, const Plane& plane);

}  // namespace csgrt
