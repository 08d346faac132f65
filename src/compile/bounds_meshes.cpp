// Solids that triangles make.
#include <algorithm>

#include "compile/tight_box.hpp"
#include "compile/triangles.hpp"

namespace csgrt {

namespace {

/// Around points that `each` hands over, one by one; `own` places them in the solid. None: a solid that is never hit;
/// any place will do.
template <class Each>
Box box_of(const Matrix& m, const Matrix& own, const Each& each) {
    Box box = empty_box;
    const auto add = [&](const Vec3& p) { extend(box, narrow(transform_point(m, transform_point(own, wide(p))))); };
    each(add);
    if (is_empty(box)) add({});
    return box;
}

template <class Point>
void each_corner(const Bot& s, const Point& point) {
    for (const auto& face : s.faces)
        for (const std::uint32_t corner : face) point(s.vertices[corner]);
}

}  // namespace

Box plates_box(const Bot& s) {
    Box box = empty_box;
    each_corner(s, [&](const Vec3& p) { extend(box, p); });
    const bool thick = s.mode == Bot::Mode::plate || s.mode == Bot::Mode::plate_nocos;
    const double t = thick ? *std::max_element(s.thickness.begin(), s.thickness.end()) : 0;
    return {{box.low.x - t, box.low.y - t, box.low.z - t}, {box.high.x + t, box.high.y + t, box.high.z + t}};
}

Box Tight::operator()(const Bot& s) const {
    return box_of(m, identity, [&](const auto& point) {
        if (s.mode == Bot::Mode::volume) return each_corner(s, point);
        const Box box = plates_box(s);
        for (const double x : {box.low.x, box.high.x})
            for (const double y : {box.low.y, box.high.y})
                for (const double z : {box.low.z, box.high.z}) point(Vec3{x, y, z});
    });
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

// Only the outermost solid cells of a row matter.
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
