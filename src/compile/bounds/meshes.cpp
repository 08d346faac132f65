// Boxes of solids that triangles make.
#include <algorithm>

#include "compile/bounds/tight_box.hpp"
#include "compile/solids/meshes/triangles.hpp"

namespace csgrt {

namespace {

/// The box around the points that `each` passes to its argument. `own` transforms points to the solid's space. A solid
/// without points is never hit, so any position serves.
template <class Each>
Box box_of(const Matrix& m, const Matrix& own, const Each& each) {
    Box box = empty_box;
    const auto add = [&](const Vec3& p) { extend(box, narrow(transform_point(m, transform_point(own, wide(p))))); };
    each(add);
    if (is_empty(box)) add({});
    return box;
}

}  // namespace

Box Tight::operator()(const Bot& s) const {
    const Box box = box_of(m, identity, [&](const auto& point) {
        for (const auto& face : s.faces)
            for (const std::uint32_t corner : face) point(s.vertices[corner]);
    });
    if (s.mode == Bot::Mode::volume || s.thickness.empty()) return box;
    // A plate extends along its normals by its thickness; along a ray that grazes it, the plate extends farther.
    const long double thickest = *std::max_element(s.thickness.begin(), s.thickness.end());
    const Wide reach = thickest * half_size(linear_part(m));
    return {narrow(wide(box.low) - reach), narrow(wide(box.high) + reach)};
}

Box Tight::operator()(const Ars& s) const {
    return box_of(m, identity, [&](const auto& point) {
        for (const auto& curve : s.curves)
            for (const Vec3& p : curve) point(p);
    });
}

Box Tight::operator()(const Nmg& s) const {
    return box_of(m, identity, [&](const auto& point) {
        for (const auto& loops : s.faces)
            for (const Nmg::Loop& loop : loops)
                for (const std::uint32_t corner : loop) point(s.vertices[corner]);
    });
}

// The outermost solid cells of each row suffice.
Box Tight::operator()(const Vol& s) const {
    return box_of(m, grid_matrix(s), [&](const auto& point) {
        const auto corners = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            for (const double dy : {0, 1})
                for (const double dz : {0, 1}) point(Vec3{static_cast<double>(x), y + dy, z + dz});
        };
        const auto is_solid = [&](std::uint8_t value) { return s.low <= value && value <= s.high; };
        for (std::uint32_t z = 0; z < s.height; ++z)
            for (std::uint32_t y = 0; y < s.depth; ++y) {
                const std::uint8_t* row = s.cells.data() + (std::size_t{z} * s.depth + y) * s.width;
                const std::uint8_t* end = row + s.width;
                const std::uint8_t* first = std::find_if(row, end, is_solid);
                if (first == end) continue;
                const std::uint8_t* last = end - 1;
                while (!is_solid(*last)) --last;
                corners(static_cast<std::uint32_t>(first - row), y, z);
                corners(static_cast<std::uint32_t>(last - row) + 1, y, z);
            }
    });
}

Box Tight::operator()(const Dsp& s) const {
    return box_of(m, s.matrix, [&](const auto& point) {
        for (std::uint32_t y = 0; y < s.depth; ++y)
            for (std::uint32_t x = 0; x < s.width; ++x) {
                const double height = s.heights[std::size_t{y} * s.width + x];
                point(Vec3{static_cast<double>(x), static_cast<double>(y), height});
            }
        for (const std::uint32_t x : {0u, s.width - 1})
            for (const std::uint32_t y : {0u, s.depth - 1})
                point(Vec3{static_cast<double>(x), static_cast<double>(y), 0});
    });
}

}  // namespace csgrt
