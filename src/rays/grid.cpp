#include "rays/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <csgrt/error.hpp>

#include "base/floating_point.hpp"
#include "compile/linear.hpp"
#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(Status::usage, what); }

/// Rays' numbers have 31 bits.
void check_counts(int columns, int rows, const char* what) {
    if (columns < 1 || rows < 1 || std::int64_t{columns} * rows > std::int64_t{1} << 30)
        refuse(std::string(what) + " has " + std::to_string(columns) + " x " + std::to_string(rows) +
               ", and must have 1 to 2^30");
}

const Box& filled(const Box& box) {
    if (is_empty(box) || !is_finite(box)) refuse("the box is empty, or not finite: give one that has a size");
    return box;
}

double width_of(const Box& box, const Vec3& along) {
    return dot(box.high - box.low, {std::abs(along.x), std::abs(along.y), std::abs(along.z)});
}

/// The upward direction in a plane: as far as possible along z, else y. `normal`: a unit vector.
Vec3 up_in_plane(const Vec3& normal) {
    constexpr double least_sine = 1e-9;  // below this sine rounding would decide the direction
    for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {
        const Vec3 within = up - dot(up, normal) * normal;
        if (length(within) > least_sine) return unit(within);
    }
    return {1, 0, 0};
}

void put(const Vec3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}
Vec3 vector_of(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

}  // namespace

void put_grid(const RayGrid& grid, kernel::Frame& frame) {
    put(grid.origin, frame.eye);
    put(grid.right, frame.u);
    put(grid.up, frame.v);
    put(grid.direction, frame.w);
    frame.perspective = grid.is_pinhole;
    frame.width = static_cast<std::uint32_t>(grid.columns);
    frame.height = static_cast<std::uint32_t>(grid.rows);
    frame.first_x = 0.5 - 0.5 * grid.columns;
    frame.first_y = 0.5 * grid.rows - 0.5;
}

RayGrid grid_of(const kernel::Frame& frame) {
    return {.origin = vector_of(frame.eye),
            .direction = vector_of(frame.w),
            .right = vector_of(frame.u),
            .up = vector_of(frame.v),
            .columns = static_cast<int>(frame.width),
            .rows = static_cast<int>(frame.height),
            .is_pinhole = frame.perspective != 0};
}

// All rays lie between the rays of the corners, so only these are checked. No ray of a pinhole has the direction 0 if
// each corner's ray is less than a right angle from the middle.
void check_grid(const RayGrid& grid) {
    check_counts(grid.columns, grid.rows, "the grid of rays");
    if (grid.is_pinhole && !(largest(grid.direction) <= Limits::ray_origin))
        refuse("the grid of rays: a pinhole's direction has the component " + number_text(largest(grid.direction)) +
               ", and " + number_text(Limits::ray_origin) + " mm is the most");
    kernel::Frame frame{};
    put_grid(grid, frame);
    for (const int column : {0, grid.columns - 1})
        for (const int row : {0, grid.rows - 1}) {
            const auto [origin, direction] = ray_of(kernel::view_ray(&frame, column, row));
            bool in_direction = false;
            std::string fault = ray_fault(origin, direction, in_direction);
            if (fault.empty() && grid.is_pinhole && !(dot(unit(grid.direction), direction) > 0))
                fault = "its direction is a right angle or more from the middle's";
            if (!fault.empty())
                refuse("the grid of rays: the ray in column " + std::to_string(column) + " of row " +
                       std::to_string(row) + ": " + fault);
        }
}

Ray RayGrid::ray(int column, int row) const {
    const FloatingPoint own;
    if (column < 0 || row < 0 || column >= columns || row >= rows)
        refuse("the grid has no ray in column " + std::to_string(column) + " of row " + std::to_string(row) +
               ": it has " + std::to_string(columns) + " x " + std::to_string(rows));
    kernel::Frame frame{};
    put_grid(*this, frame);
    return ray_of(kernel::view_ray(&frame, column, row));
}

std::vector<Ray> RayGrid::rays() const {
    const FloatingPoint own;
    check_grid(*this);
    kernel::Frame frame{};
    put_grid(*this, frame);
    std::vector<Ray> all;
    all.reserve(size());
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) all.push_back(ray_of(kernel::view_ray(&frame, column, row)));
    return all;
}

RayGrid rays_parallel(const Box& box, Axis axis, int columns, int rows) {
    const FloatingPoint own;
    check_counts(columns, rows, "the grid of rays");
    const auto &low = filled(box).low, &high = box.high;
    constexpr double before = 1;  // mm
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const Vec3 along = axis == Axis::x ? x : axis == Axis::y ? y : z;
    const Vec3 right = axis == Axis::x ? y : x, up = axis == Axis::z ? y : z;
    Vec3 origin = 0.5 * low + 0.5 * high;
    (axis == Axis::x ? origin.x : axis == Axis::y ? origin.y : origin.z) = dot(along, low) - before;
    return {.origin = origin,
            .direction = along,
            .right = width_of(box, right) / columns * right,
            .up = width_of(box, up) / rows * up,
            .columns = columns,
            .rows = rows};
}

RayGrid rays_pinhole(double vertical_fov, const Vec3& center, const Vec3& eye, const Vec3& up, int width, int height) {
    const FloatingPoint own;
    check_counts(width, height, "the picture");
    if (!(vertical_fov > 0 && vertical_fov < 180))
        refuse("the field of view must be more than 0 and below 180 degrees");
    constexpr double least_sine = 1e-9;
    const Vec3 forward = unit(center - eye), right = cross(forward, unit(up));
    if (!is_finite(forward) || !is_finite(right)) refuse("the eye, the centre and the direction upward must be finite");
    if (!(length(forward) > 0)) refuse("the eye stands at the point that it looks at");
    if (!(length(right) > least_sine)) refuse("the direction upward has no length, or runs along the line of sight");
    const double pixel = 2 * std::tan(vertical_fov * std::numbers::pi / 360) / height;
    return {.origin = eye,
            .direction = forward,
            .right = pixel * unit(right),
            .up = pixel * cross(unit(right), forward),
            .columns = width,
            .rows = height,
            .is_pinhole = true};
}

Slice slice_of(const Box& box, const Vec3& normal, double offset, int width, int height) {
    const FloatingPoint own;
    check_counts(width, height, "the slice");
    const Vec3 n = unit(normal);
    if (!is_finite(n) || !(length(n) > 0)) refuse("the plane's normal must be finite, and not 0");
    if (!std::isfinite(offset)) refuse("the plane's offset must be a finite number");
    const Vec3 up = up_in_plane(n), right = cross(up, n), middle = 0.5 * filled(box).low + 0.5 * box.high;
    const double pixel = std::max(width_of(box, right) / width, width_of(box, up) / height);
    if (!(pixel > 0)) refuse("the box has no width in the plane");
    return {.center = middle - dot(n, middle) * n + offset * n,
            .right = pixel * right,
            .up = pixel * up,
            .width = width,
            .height = height};
}

}  // namespace csgrt
