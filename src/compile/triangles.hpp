// Solids that triangles make -> their triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// A surface. Triangles that share an edge share its vertices, so no ray passes between them; one with two equal
/// corners, or none of any area, does no harm.
struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
    Matrix matrix = identity;  ///< places the vertices in the solid's space
};

/// The faces of the mesh as they are.
Triangles triangles_of(const Bot& bot);

}  // namespace csgrt
