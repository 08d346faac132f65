// Surface table: finds curved surfaces that several solids share: balls, sides of cylinders and cones, tori. These
// solids all use the numbers of the first solid, so that a ray meets them at the very same distance, as planes.hpp does
// for flat faces.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/solids/meshes/near_lookup.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "compile/shards.hpp"

namespace csgrt {

/// The table finds equal curved surfaces among the solids of a scene, within the rounding of the model's numbers.
class SurfaceTable {
public:
    /// The limit of distance: two surfaces are one if everywhere on the smaller solid they lie no farther apart than
    /// this, relative to the diagonal of this solid's box; far from the origin the limit is coordinate_rounding
    /// (linear.hpp).
    static constexpr double gap = 1e-10;

    /// Makes an empty table. `center`, `radius`: a sphere around the scene.
    SurfaceTable(const Vec3& center, double radius)
        : center_(center), radius_(radius), rounding_(coordinate_rounding * largest_coordinate(center, radius)) {}

    /// A surface in the form in which it is looked up. It does not depend on the table's contents, so several threads
    /// may compute surfaces ahead.
    struct Surface {
        std::uint32_t type;
        double at[4];  ///< a characteristic point, relative to the scene's centre; then the logarithm of the size
        double limit;  ///< the largest difference of an equal surface
    };
    /// The surface of a solid; none for types whose surfaces are not shared.
    std::optional<Surface> surface_of(std::uint32_t type, const double* reals, const WideMatrix& axes,
                                      const Box& box) const;
    /// Cells for the shards: surfaces that may be equal share a cell.
    std::array<Shards::Chunk::Dimension, 5> coarse_cells(const Surface& surface) const;

    /// The parameters of a solid, by its number, and its local axes in the world.
    using RealsOf = std::function<std::span<const double>(std::uint32_t)>;
    using AxesOf = std::function<WideMatrix(std::uint32_t)>;
    /// The result of a search. `solid`: the solid whose parameters solid `number` uses: an earlier solid with the same
    /// surface, or itself. `depth`: how far the surface of `number` lies inside the surface of `solid`, millimetres;
    /// negative: outside. `gives`: from now on all solids with the surface use the parameters of `number`.
    struct Found {
        std::uint32_t solid;
        double depth;
        bool gives;
    };
    Found add(const Surface& surface, std::uint32_t number, const RealsOf& reals_of, const AxesOf& axes_of);

    /// Removes the surfaces; keeps the memory.
    void clear() {
        entries_.clear();
        cells_.clear();
    }

private:
    struct Entry {
        std::uint32_t number;
        std::uint32_t next;  ///< next entry in the same cell
    };

    Vec3 center_;
    double radius_;
    double rounding_;  ///< of coordinates in the scene
    std::vector<Entry> entries_;
    CellTable cells_;  ///< the last entry of each cell
};

}  // namespace csgrt
