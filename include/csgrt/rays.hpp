// Rays: lists of rays, grids of rays, which devices make themselves, and the ranges of rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include <csgrt/error.hpp>
#include <csgrt/vector.hpp>

namespace csgrt {

/// The ray origin + t x direction, t >= 0. Distances t along it are in units of the direction's length, so they are
/// millimetres if the direction is a unit vector. Limits tells which origins and directions are allowed.
struct Ray {
    Vec3 origin = {};     ///< Millimetres.
    Vec3 direction = {};  ///< Of any length but 0.
};

/// The part of a ray that an answer covers: t_near <= t <= t_far. From -infinity to infinity it is the whole line.
struct RayRange {
    double t_near = 0;                                       ///< In lengths of the ray's direction.
    double t_far = std::numeric_limits<double>::infinity();  ///< In lengths of the ray's direction.
};

/// The ranges of a list of rays.
struct RayRanges {
    RayRange all = {};
    std::span<const RayRange> each = {};  ///< one range for each ray, or empty: then `all` holds
};

/// Rays in rows and columns. Ray (column, row), counted from the top left, has the number row x columns + column, and
///     across = (column + 1/2 - columns / 2) x right + (rows / 2 - row - 1/2) x up.
/// A parallel ray starts at origin + across and runs along `direction`; a pinhole's ray starts at `origin` and runs
/// along the unit vector of direction + across.
struct CSGRT_API RayGrid {
    Vec3 origin = {};  ///< Millimetres.
    Vec3 direction = {};
    Vec3 right = {};  ///< From a ray to the next one in its row.
    Vec3 up = {};     ///< From a ray to the next one in its column.
    int columns = 1, rows = 1;
    bool is_pinhole = false;

    std::uint64_t size() const { return std::uint64_t(columns) * std::uint64_t(rows); }
    /// The ray of a column and a row. Throws Error (usage) if the grid has no such ray.
    Ray ray(int column, int row) const;
    /// All rays, by their numbers. Throws Error (usage) for an invalid grid.
    std::vector<Ray> rays() const;
};

enum class Axis { x, y, z };

/// Makes parallel rays in the positive direction of an axis, through the middles of the cells of a box's face. They
/// start 1 mm before the box. Columns are along x, or along y if the axis is x. The top row has the largest z, or the
/// largest y if the axis is z. Throws Error (usage) for an empty box and for numbers of rays below 1.
CSGRT_API RayGrid rays_parallel(const Box& box, Axis axis, int columns, int rows);

/// Makes rays from an eye through the middles of a picture's pixels, which are square. `vertical_fov`: degrees between
/// the picture's upper and lower edge; `center`: the point in the picture's middle. Throws Error (usage).
CSGRT_API RayGrid rays_pinhole(double vertical_fov, const Vec3& center, const Vec3& eye, const Vec3& up, int width,
                               int height);

/// The rays of a call: the caller's list, which must outlive the call, or a grid. If all rays of a grid have the same
/// range, the device makes the rays itself, and nothing is copied.
class Rays {
public:
    Rays() = default;
    Rays(const Ray& one) : list_(&one, 1) {}
    template <class List>
    requires std::is_convertible_v<const List&, std::span<const Ray>> Rays(const List& list) : list_(list) {}
    Rays(const RayGrid& grid) : grid_(grid) {}

    std::uint64_t size() const { return grid_ ? grid_->size() : list_.size(); }
    std::span<const Ray> list() const { return list_; }
    /// The grid, or null for a list.
    const RayGrid* grid() const { return grid_ ? &*grid_ : nullptr; }

private:
    std::span<const Ray> list_ = {};
    std::optional<RayGrid> grid_ = {};
};

/// Pixels in a plane. The middle of pixel (column, row), counted from the top left, is
///     center + (column + 1/2 - width / 2) x right + (height / 2 - row - 1/2) x up.
struct Slice {
    Vec3 center = {};           ///< Millimetres.
    Vec3 right = {};            ///< From a pixel to the next one in its row, millimetres.
    Vec3 up = {};               ///< From a pixel to the next one in its column, millimetres.
    int width = 0, height = 0;  ///< Pixels.
    bool hidden = true;         ///< False: regions that pictures do not show (State) are left out.
};

/// The slice of a box by the plane n . p = offset; n is the unit vector of `normal`. The pixels are square. They are
/// seen from the side to which the normal points, with z up, or with y up if the normal is along z. Throws Error
/// (usage).
CSGRT_API Slice slice_of(const Box& box, const Vec3& normal, double offset, int width, int height);

}  // namespace csgrt
