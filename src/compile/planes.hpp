// The one table of planes in the world. Faces, end caps and half-spaces that lie in one plane share its record, so that
// a ray meets them at the very same distance.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/cells.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt {

class PlaneTable {
public:
    /// Two planes are one when over the boxes of both their solids they lie no farther apart than this, relative to the
    /// smaller box's diagonal. Rounding of a model's own numbers and matrices stays below; a modelled gap is far above.
    static constexpr double gap = 1e-10;
    /// ... and when their unit normals differ by no more than this in any component, which keeps the search local.
    static constexpr double tilt = 1e-9;

    /// `around`: a sphere around the scene; distances are looked up relative to it.
    PlaneTable(const Vec3& center, double radius) : center_(center), radius_(radius) {}

    /// Where a plane is looked up; depends on nothing else, so several threads may find it ahead.
    struct Key {
        Plane one;          ///< the plane, or the one that looks the other way: see facing()
        double offset = 0;  ///< of `one` from the scene's centre
        std::uint64_t cell = 0;
        bool flipped = false;  ///< `one` looks the other way
        bool alone = false;    ///< no plane that is the same lies in another cell
    };
    Key key_of(const Plane& plane) const;
    /// Brings what add() will read nearer to the processor: of a plane that comes a little later, then soon.
    void fetch_cell(const Key& key) const { cells_.fetch(key.cell); }
    void fetch_record(const Key& key) const;

    /// The record of a face of the solid in `box`: an earlier one if there is one for that plane, in either direction.
    kernel::PlaneRef add(const Plane& plane, const Key& key, const Box& box);
    kernel::PlaneRef add(const Plane& plane, const Box& box) { return add(plane, key_of(plane), box); }

    void reserve(std::size_t planes) {
        records_.reserve(planes);
        entries_.reserve(planes);
    }
    std::vector<kernel::PlaneRecord> take() { return std::move(records_); }

private:
    /// A record as it is looked up: on one side of space, see facing().
    struct Entry {
        Vec3 normal;
        double distance, offset;  ///< from the origin and from the scene's centre
        std::uint32_t next;       ///< in the same cell
        bool flipped;             ///< against the record
        Box box;                  ///< of the solid that brought the plane
    };

    std::uint32_t find(const Key& key, const Box& box) const;
    std::uint32_t find_in_cell(std::uint64_t cell, const Key& key, const Box& box) const;
    bool same(const Entry& entry, const Plane& plane, const Box& box) const;
    double offset(const Plane& plane) const;

    Vec3 center_;
    double radius_;
    std::vector<kernel::PlaneRecord> records_;
    std::vector<Entry> entries_;
    CellTable cells_;  ///< the last record of each
};

}  // namespace csgrt
