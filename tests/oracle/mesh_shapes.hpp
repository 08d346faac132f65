// Families of closed meshes: what models have, and what methods fail on.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shapes.hpp"

namespace csgrt::oracle {

namespace detail {

/// A mesh in numbers of about 1 each, before a LocalFrame gives it its place.
struct MeshBuilder {
    std::vector<QVec> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;

    std::uint32_t vertex(double x, double y, double z) {
        vertices.push_back({x, y, z});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { faces.push_back({a, b, c}); }
    void quadrangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c), triangle(a, c, d);
    }
    void box(double x0, double y0, double z0, double x1, double y1, double z1) {
        const std::uint32_t a = vertex(x0, y0, z0), b = vertex(x1, y0, z0), c = vertex(x1, y1, z0),
                            d = vertex(x0, y1, z0), e = vertex(x0, y0, z1), f = vertex(x1, y0, z1),
                            g = vertex(x1, y1, z1), h = vertex(x0, y1, z1);
        quadrangle(a, d, c, b), quadrangle(e, f, g, h), quadrangle(a, b, f, e);
        quadrangle(b, c, g, f), quadrangle(c, d, h, g), quadrangle(d, a, e, h);
    }
    /// Rings of equal size between two ends, each ring a circle of vertices; an end of one vertex is a pole.
    template <class Of>
    void tube(std::size_t rings, std::size_t around, bool closed, const Of& of) {
        std::vector<std::vector<std::uint32_t>> all(rings);
        for (std::size_t i = 0; i < rings; ++i)
            for (std::size_t j = 0; j < around; ++j) {
                const QVec p = of(i, j);
                all[i].push_back(vertex(to_double(p.x), to_double(p.y), to_double(p.z)));
            }
        for (std::size_t i = 0; i + (closed ? 0 : 1) < rings; ++i)
            for (std::size_t j = 0; j < around; ++j) {
                const auto &one = all[i], &next = all[(i + 1) % rings];
                const std::size_t k = (j + 1) % around;
                quadrangle(one[j], one[k], next[k], next[j]);
            }
        if (closed) return;
        for (const auto& end : {all.front(), all.back()})
            for (std::size_t j = 1; j + 1 < around; ++j) triangle(end[0], end[j], end[j + 1]);
    }
    void ball(std::size_t rings, std::size_t around, double radius, double wobble, Random& random) {
        const double pi = std::acos(-1.0);
        const std::uint32_t south = vertex(0, 0, -radius), north = vertex(0, 0, radius);
        std::vector<std::uint32_t> below;
        for (std::size_t i = 1; i < rings; ++i) {
            const double latitude = pi * (static_cast<double>(i) / static_cast<double>(rings) - 0.5);
            std::vector<std::uint32_t> ring;
            for (std::size_t j = 0; j < around; ++j) {
                const double turn = 2 * pi * static_cast<double>(j) / static_cast<double>(around);
                const double r = radius * (1 + wobble * random.between(-1, 1));
                ring.push_back(vertex(r * std::cos(latitude) * std::cos(turn), r * std::cos(latitude) * std::sin(turn),
                                      r * std::sin(latitude)));
            }
            for (std::size_t j = 0; j < around; ++j) {
                const std::size_t k = (j + 1) % around;
                if (i == 1)
                    triangle(south, ring[k], ring[j]);
                else
                    quadrangle(below[j], below[k], ring[k], ring[j]);
                if (i + 1 == rings) triangle(north, ring[j], ring[k]);
            }
            below = ring;
        }
    }
    void stretch(double x, double y, double z) {
        for (QVec& p : vertices) p = {quad(x) * p.x, quad(y) * p.y, quad(z) * p.z};
    }
};

inline Shape mesh_form(std::size_t form, const LocalFrame& s, Random& random) {
    MeshBuilder b;
    const double pi = std::acos(-1.0);
    const auto ring = [&](double turns, std::size_t i, std::size_t of) {
        return 2 * pi * turns * static_cast<double>(i) / static_cast<double>(of);
    };
    switch (form) {
        case 0:
            b.box(-1, -1, -1, 1, 1, 1);
            break;
        case 1:  // touch along an edge and in a corner; one in another's cavity
            b.box(-1, -1, -1, 0, 0, 0), b.box(0, 0, -1, 1, 1, 0), b.box(0, -1, 0, 1, 0, 1);
            b.box(-0.75, -0.75, -0.75, -0.25, -0.25, -0.25);
            break;
        case 2:
            b.ball(8, 12, 1, 0, random);
            break;
        case 3:  // rough, not convex
            b.ball(7, 11, 1, 0.6, random);
            break;
        case 4: {  // a torus
            b.tube(9, 7, true, [&](std::size_t i, std::size_t j) {
                const double u = ring(1, i, 9), v = ring(1, j, 7), r = 1 + 0.3 * std::cos(v);
                return QVec{r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v)};
            });
            break;
        }
        case 5:  // needle
            b.ball(5, 7, 1, 0, random);
            b.stretch(1e-4, 1e-4, 1);
            break;
        case 6:  // wafer
            b.box(-1, -1, -1, 1, 1, 1);
            b.stretch(1, 1, 1e-6);
            break;
        case 7: {  // one triangle each for most of the surface, slivers for the rest
            b.tube(3, 40, false, [&](std::size_t i, std::size_t j) {
                const double u = ring(1, j, 40), r = i == 1 ? 1 : 1 - 1e-5;
                return QVec{r * std::cos(u), r * std::sin(u), static_cast<double>(i) - 1};
            });
            break;
        }
        case 8: {  // a spiral plate
            b.tube(24, 4, false, [&](std::size_t i, std::size_t j) {
                const double u = ring(2, i, 24),
                             r = 0.3 + 0.03 * static_cast<double>(i) + (j == 1 || j == 2 ? 0.02 : 0);
                return QVec{r * std::cos(u), r * std::sin(u), j < 2 ? -0.5 : 0.5};
            });
            break;
        }
        default: {  // repeated and flat triangles beside good ones
            b.ball(4, 6, 1, 0.2, random);
            const auto count = static_cast<std::uint32_t>(b.vertices.size());
            const std::uint32_t again = b.vertex(0, 0, 1);
            b.triangle(0, 0, 1), b.triangle(2, 2, 2), b.triangle(1, again, 3);
            b.triangle(again, 1, 3);
            b.triangle(4, 5, count / 2), b.triangle(5, 4, count / 2);
        }
    }
    Bot bot;
    for (const QVec& p : b.vertices) bot.vertices.push_back(v(s.point(p.x, p.y, p.z)));
    bot.faces = b.faces;
    // Which way a triangle faces, and where it begins, says nothing.
    for (auto& face : bot.faces) {
        if (random.coin()) std::swap(face[0], face[1]);
        if (random.coin()) std::swap(face[1], face[2]);
    }
    return bot;
}
inline constexpr const char* mesh_forms[] = {"box",    "boxes", "ball",     "rough ball", "torus",
                                             "needle", "wafer", "cylinder", "spiral",     "repeated"};

}  // namespace detail

/// Case number `index`: cycles through the forms as make_case does.
inline Case make_mesh_case(std::size_t index, Random& random) {
    const std::size_t forms = std::size(detail::mesh_forms), form = index % forms, round = index / forms;
    const std::size_t place = round % std::size(detail::placements), turn = index / 7 % 4;
    const double size = turn == 2 ? 1e-3 : turn == 3 ? 1e6 : 1.0;
    const LocalFrame local = form < 2 || place == 1 ? aligned_local_frame(random) : random_local_frame(random, size);
    Shape shape = detail::mesh_form(form, local, random);
    return {std::string(detail::mesh_forms[form]) + ", " + detail::placements[place], std::move(shape),
            detail::placement(place, local.size, random)};
}

}  // namespace csgrt::oracle
