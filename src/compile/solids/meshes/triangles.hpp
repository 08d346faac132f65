// Triangles: the triangles of the solids that are made of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A surface. Triangles that share an edge share its points, by number or bit by bit, so no ray passes between them. A
/// triangle without area does no harm.
struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { faces.push_back({a, b, c}); }
    /// Adds two triangles, cut from a to c.
    void quadrangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
};

/// The triangles of an ars. Between two curves, the quadrangle from points j to points j + 1 is cut from point j of the
/// first curve to point j + 1 of the second curve, as in BRL-CAD. The first and the last curve are not closed by a
/// surface, unless they are a point.
Triangles triangles_of(const Ars& ars);

/// The triangles of an nmg: every face by the triangulation of triangulate.hpp.
Triangles triangles_of(const Nmg& nmg);

/// The triangles of a dsp: the surface over the grid, walls along its border, and a floor at z = 0. The vertices' units
/// are cells and heights; Dsp::matrix transforms them.
Triangles triangles_of(const Dsp& dsp);

/// The triangles of a vol: two wherever a solid cell meets an empty cell or the border. The vertices' unit is a cell;
/// grid_matrix transforms them. Throws Error (scene) if there are more triangles than a mesh can have.
Triangles triangles_of(const Vol& vol);
Matrix grid_matrix(const Vol& vol);

/// The most triangles of a mesh; see BvhNode.
inline constexpr std::size_t most_triangles = (std::size_t{1} << 28) - 1;

}  // namespace csgrt
