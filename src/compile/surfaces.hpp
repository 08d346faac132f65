// Curved surfaces that several solids share: balls, sides of cylinders and cones, tori. The first solid's numbers stand
// for all, so that a ray meets them at the very same distance, as planes.hpp does for flat faces.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/cells.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"

namespace csgrt {

class SurfaceTable {
public:
    /// One surface is another if nowhere on the smaller solid they lie farther apart than this, of its box's diagonal.
    static constexpr double gap = 1e-10;

    /// `around`: a sphere around the scene.
    SurfaceTable(const Vec3& center, double radius) : center_(center), radius_(radius) {}

    /// If the solid whose parameters end `scene.reals` has a surface that is there already, drops them and lets it have
    /// those. `axes`: the local axes in the world.
    void share(kernel::SolidRecord& record, const WideMatrix& axes, const Box& box, CompiledScene& scene);

private:
    struct Entry {
        std::uint32_t first_real;
        std::uint32_t next;  ///< in the same cell
    };
    /// Where a surface is looked up: a point that belongs to it alone, and how large it is there.
    struct Key {
        Wide point;
        long double size;
    };

    static Key key_of(std::uint32_t type, const double* reals, const WideMatrix& axes, const Vec3& center);

    Vec3 center_;
    double radius_;
    std::vector<Entry> entries_;
    CellTable cells_;  ///< the last entry of each
};

}  // namespace csgrt
