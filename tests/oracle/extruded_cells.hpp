// The cells of a picture, extruded (ebm). Between two neighbouring grid planes that the ray crosses it is in one cell.
#pragma once

#include <memory>

#include "extruded.hpp"

namespace csgrt::oracle {

inline ExactSolid extruded_cells(const Ebm& shape, const QAffine& place) {
    const QAffine own = to_affine(shape.matrix);
    ImplicitSolid frame;
    add_frame(frame, place, own);
    const QAffine to_world = frame.to_world, to_local = frame.to_local;
    ExactSolid solid;
    solid.frame = to_world;
    solid.condition = frame.condition;
    const QVec size{static_cast<double>(shape.width), static_cast<double>(shape.depth), shape.height};
    solid.center = to_world.point(quad(0.5) * size);
    solid.radius =
        to_double(length(size.x * to_world.x) + length(size.y * to_world.y) + length(size.z * to_world.z)) / 2;
    solid.placement = to_double(length((componentwise_absolute(place) * componentwise_absolute(own)).point(size)));
    const auto cell = [](quad x) {
        const double whole = std::floor(to_double(x));  // rounded up, perhaps
        return static_cast<std::int64_t>(quad(whole) > x ? whole - 1 : whole);
    };
    solid.along = [=, picture = std::make_shared<Ebm>(shape)](const QVec& world_o,
                                                              const QVec& world_d) -> ExactIntervals {
        const QVec o = to_local.point(world_o), d = to_local.direction(world_d);
        std::vector<ExactEnd> planes;
        const auto cross_planes = [&](quad at, quad rate, quad step, std::uint32_t count, const QVec& normal) {
            if (rate == 0) return;
            const QVec n = unit(to_local.transposed(normal));
            for (std::uint32_t i = 0; i <= count; ++i)
                planes.push_back({(step * static_cast<double>(i) - at) / rate, n});
        };
        cross_planes(o.x, d.x, 1, picture->width, {1, 0, 0});
        cross_planes(o.y, d.y, 1, picture->depth, {0, 1, 0});
        cross_planes(o.z, d.z, picture->height, 1, {0, 0, 1});
        std::sort(planes.begin(), planes.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        ExactIntervals intervals;
        bool inside = false;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            bool now = false;
            if (i + 1 < planes.size() && planes[i].t < planes[i + 1].t) {
                const QVec p = o + (planes[i].t + planes[i + 1].t) / 2 * d;
                const std::int64_t x = cell(p.x), y = cell(p.y);
                now = p.z >= 0 && p.z <= picture->height && x >= 0 && y >= 0 && x < picture->width &&
                      y < picture->depth &&
                      picture->cells[static_cast<std::size_t>(y) * picture->width + static_cast<std::size_t>(x)] != 0;
            } else if (i + 1 < planes.size()) {
                continue;  // two planes at one t: what matters is what comes after them
            }
            if (now && !inside) intervals.push_back({planes[i], {}});
            if (!now && inside) intervals.back().out = planes[i];
            inside = now;
        }
        return detail::outward(intervals, world_d);
    };
    return solid;
}

}  // namespace csgrt::oracle
