// Solids -> closed triangle meshes, to an error that is given: what programs without exact solids trace.
#pragma once

#include <cstddef>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/solids/meshes/triangles.hpp"

namespace csgrt::bench {

struct FacetOptions {
    double chord = 0.1;             ///< millimetres: how far a triangle may be from the surface
    Box around;                     ///< half-spaces are cut to it
    std::size_t most = 20'000'000;  ///< triangles
};

/// The surface of a solid that `matrix` places. Vertices lie on it. The mesh is closed: every edge has two triangles,
/// which run along it in opposite directions; their corners are counterclockwise when seen from outside.
/// Throws Error: usage, with words, if solids of this type, or this one, cannot be told by such a mesh; out_of_memory
/// if that takes more triangles than `most`.
Triangles facets(const Shape& shape, const Matrix& matrix, const FacetOptions& options);

/// A box, as such a mesh.
Triangles box_facets(const Box& box);

/// What a closed mesh encloses, in cubic millimetres; negative if its triangles are clockwise.
double volume(const Triangles& mesh);

/// Whether every edge has two triangles, which run along it in opposite directions.
bool is_closed(const Triangles& mesh);

}  // namespace csgrt::bench
