// Solids that triangles make -> their triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A surface. Triangles that share an edge share its ends, as numbers or bit by bit, so no ray passes between them; one
/// of no area does no harm.
struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { faces.push_back({a, b, c}); }
    /// Cut from a to c.
    void quadrangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
};

/// Between two curves, the quadrangle from their points j to their points j + 1 is cut from the first curve's j to the
/// second one's j + 1, as BRL-CAD does. No surface closes a first or last curve that is not a point.
Triangles triangles_of(const Ars& ars);

/// Every face by the triangulation of triangulate.hpp.
Triangles triangles_of(const Nmg& nmg);

/// The surface over the grid, walls along its border, and a floor at z = 0. Vertices count cells and heights;
/// Dsp::matrix places them.
Triangles triangles_of(const Dsp& dsp);

/// Two triangles wherever a solid cell meets one that is not, or the border. Vertices count cells;
/// grid_matrix places them. Throws Error (scene) if that is more than a mesh can have.
Triangles triangles_of(const Vol& vol);
Matrix grid_matrix(const Vol& vol);

/// What a mesh can have; see BvhNode.
inline constexpr std::size_t most_triangles = (std::size_t{1} << 28) - 1;

}  // namespace csgrt
