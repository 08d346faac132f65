// Parts that touch others: each has flat faces, or is made of plates that end, in z = 0.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stress/build.hpp"

namespace csgrt::stress {

inline constexpr std::size_t flat_parts = 24;
inline const double pi = std::acos(-1);
inline constexpr Matrix mirror = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};  ///< in z = 0

/// A closed line through points.
inline Sketch polygon(const std::vector<Sketch::Point>& points) {
    Sketch sketch{.vertices = points};
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < count; ++i) sketch.curves.emplace_back(Sketch::Line{i, (i + 1) % count});
    sketch.reversed.assign(count, 0);
    return sketch;
}

/// A block below z = 0 as triangles: its top is a fan around a point.
inline Bot block_of_triangles(const Vec3& top) {
    Bot bot;
    bot.vertices = {{-3, -3, -4}, {3, -3, -4}, {3, 3, -4}, {-3, 3, -4}, {-3, -3, 0},
                    {3, -3, 0},   {3, 3, 0},   {-3, 3, 0}, top};
    bot.faces = {{0, 2, 1}, {0, 3, 2}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        bot.faces.push_back({i, next, next + 4});
        bot.faces.push_back({i, next + 4, i + 4});
        bot.faces.push_back({i + 4, next + 4, 8});
    }
    return bot;
}

/// A part with a flat top in z = 0 that holds all points closer to the z axis than 2; nothing of it is above.
inline Tree flat_part(Builder& to, std::size_t kind, const Matrix& place) {
    const auto solid = [&](Shape shape) { return leaf(to.solid(std::move(shape)), place); };
    const Vec3 down{0, 0, -4}, x{1, 0, 0};
    const std::vector<Sketch::Point> square = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
    // Extruded along y: the sketch's v is z, and its walls over v = 0 are the top.
    const auto wall = [&](Sketch sketch) {
        return solid(Extrude{{0, 3, 0}, {0, -6, 0}, {1, 0, 0}, {0, 0, 1}, std::move(sketch)});
    };
    const auto turned = [&](double angle, std::vector<Sketch::Point> points) {
        return Revolve{{-3, 0, 0}, x, {0, 1, 0}, angle, polygon(points)};
    };
    switch (kind) {
        case 0:
            return solid(box({-3, -3, -4}, {3, 3, 0}));
        case 1:
            return solid(cylinder(down, {0, 0, 4}, 3));
        case 2:
            return solid(cone({}, down, 3, 1));
        case 3: {
            Arbn hexagon;
            for (int i = 0; i < 6; ++i)
                hexagon.planes.push_back({{std::cos(i * pi / 3), std::sin(i * pi / 3), 0}, 2.5});
            hexagon.planes.push_back({{0, 0, 1}, 0});
            hexagon.planes.push_back({{0, 0, -1}, 4});
            return solid(hexagon);
        }
        case 4:
            return solid(Ehy{{}, down, x, 3, 3, 1});
        case 5:
            return solid(Epa{{}, down, x, 3, 3});
        case 6:
            return solid(Rpc{{-3, 0, 0}, {6, 0, 0}, down, 3});
        case 7:
            return solid(Rhc{{-3, 0, 0}, {6, 0, 0}, down, 3, 1});
        case 8:
            return solid(Hyp{down, {0, 0, 4}, {3, 0, 0}, 3, 0.5});
        case 9:
            return solid(Extrude{down, {0, 0, 4}, x, {0, 1, 0}, polygon(square)});
        case 10:
            return operate(Operator::difference, {solid(ball({}, 4)), solid(box({-5, -5, 0}, {5, 5, 5}))});
        case 11:
            return operate(Operator::intersection, {solid(ball({}, 4)), solid(Half{{{0, 0, 1}, 0}})});
        case 12: {
            return solid(Revolve{{}, {0, 0, 1}, x, 2 * pi, polygon({{0, -4}, {3, -4}, {3, 0}, {0, 0}})});
        }
        case 13: {
            // Turned by half about the x axis: its two end faces are one.
            Revolve half = turned(pi, {{0, 0}, {3, 0}, {3, 6}, {0, 6}});
            half.r = {0, -1, 0};
            return solid(half);
        }
        case 14:
            return solid(block_of_triangles({0.5, 0.25, 0}));
        case 15:
            return solid(
                Nmg{block_of_triangles({}).vertices,
                    {{{3, 2, 1, 0}}, {{4, 5, 6, 7}}, {{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}, {{3, 0, 4, 7}}}});
        case 16:
            return solid(Ars{{{{0, 0, -4}, {0, 0, -4}, {0, 0, -4}, {0, 0, -4}},
                              {{-3, -3, -4}, {3, -3, -4}, {3, 3, -4}, {-3, 3, -4}},
                              {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}},
                              {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}});
        case 17: {
            Vol vol;
            vol.width = vol.depth = 3;
            vol.height = 2;
            vol.low = 1;
            vol.cell = {2, 2, 2};
            vol.matrix = translation({-3, -3, -4});
            vol.cells.assign(18, 200);
            return solid(vol);
        }
        case 18: {  // cells in x and z
            Ebm ebm;
            ebm.width = 3;
            ebm.depth = 2;
            ebm.height = 6;
            ebm.matrix = translation({-3, 3, -4}) * Matrix{2, 0, 0, 0, 0, 0, -1, 0, 0, 2, 0, 0, 0, 0, 0, 1};
            ebm.cells = {1, 0, 1, 1, 1, 1};
            return solid(ebm);
        }
        case 19: {
            Dsp dsp;
            dsp.width = dsp.depth = 4;
            dsp.matrix = translation({-3, -3, -4}) * Matrix{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
            dsp.heights.assign(16, 4);
            return solid(dsp);
        }
        case 20:  // no outline of one convex piece: an arch
            return wall(polygon({{-3, 0}, {3, 0}, {3, -4}, {2, -4}, {2, -1}, {-2, -1}, {-2, -4}, {-3, -4}}));
        case 21: {  // straight above, round below
            Sketch sketch{.vertices = {{-3, 0}, {3, 0}}};
            sketch.curves.emplace_back(Sketch::Line{0, 1});
            sketch.curves.emplace_back(Sketch::Arc{1, 0, 3, false, true});
            sketch.reversed.assign(2, 0);
            return wall(std::move(sketch));
        }
        case 22: {  // many short pieces
            std::vector<Sketch::Point> points;
            for (int i = 0; i <= 12; ++i) points.push_back({-3 + 0.5 * i, 0});
            points.push_back({1, -3});
            points.push_back({0.5, -1});
            points.push_back({-1, -4});
            return wall(polygon(points));
        }
        default: {  // a ridge
            Arb wedge = box({-3, -3, 0}, {3, 3, 0});
            for (std::size_t i = 4; i < 8; ++i) wedge.vertices[i] = {i == 4 || i == 7 ? -3.0 : 3.0, 0, -4};
            return solid(wedge);
        }
    }
}

/// Where a pair stands: on a grid far apart, straight or turned.
inline Matrix place_of(Random& random, std::size_t number, bool turned) {
    const Vec3 at = 40.0 * Vec3{double(number % 4), double(number / 4), 0} + (turned ? random.in_cube() : Vec3{});
    return turned ? translation(at) * rotation(random) : translation(at);
}

/// Plates below z = 0 that end there: a wall, a tent's sides, the wall of a block with its top.
inline Bot plates(std::size_t kind, Random& random) {
    Bot bot;
    const double lean = kind == 1 ? 1 : 0, top = random.between(-1, 1);
    if (kind == 2) {
        bot = block_of_triangles({top, 0, 0});
    } else {
        bot.vertices = {{-3, 0, 0}, {top, 0, 0}, {3, 0, 0}, {-3, lean, -4}, {3, lean, -4}};
        bot.faces = {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}};
    }
    if (kind == 1) {
        for (const double x : {-3.0, 3.0}) bot.vertices.push_back({x, -lean, -4});
        bot.faces.insert(bot.faces.end(), {{0, 1, 5}, {1, 5, 6}, {1, 2, 6}});
    }
    bot.mode = random.coin() ? Bot::Mode::plate : Bot::Mode::plate_nocos;
    bot.thickness.assign(bot.faces.size(), 2);
    return bot;
}

/// What a line through points encloses, from z = -2 to 2, as triangles.
inline Bot prism(const std::vector<Sketch::Point>& outline) {
    Bot bot;
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (const double z : {-2.0, 2.0})
        for (const Sketch::Point& point : outline) bot.vertices.push_back({point.u, point.v, z});
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        bot.faces.push_back({i, next, next + count});
        bot.faces.push_back({i, next + count, i + count});
        if (i == 0 || next == 0) continue;
        bot.faces.push_back({0, next, i});
        bot.faces.push_back({count, i + count, next + count});
    }
    return bot;
}

}  // namespace csgrt::stress
