// Solids by the numbers that a person knows, as the model's general solids. The reader builds them, and the writer
// uses one where it rebuilds the very bits.
#pragma once

#include <cstddef>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

Ell sphere(const Vec3& center, double radius);

/// A circular cone, or a cylinder if the radii are equal. The axes a and b are perpendicular to the height.
Tgc cone(const Vec3& base, const Vec3& height, double radius, double top_radius);

/// A box along the axes.
Arb box(const Vec3& low, const Vec3& high);

/// arb4 to arb8 from as many vertices as the name says, in BRL-CAD's order:
///   arb8: a face 0 1 2 3 and the opposite one 4 5 6 7, vertex 4 + i above vertex i
///   arb7: arb8 with its last vertex in vertex 4
///   arb6: a face 0 1 2 3, and the edge 4 5 above it: 4 over 0 and 1, 5 over 2 and 3
///   arb5: a pyramid: a face 0 1 2 3, and the apex 4;   arb4: a face 0 1 2, and the apex 3
Arb arb(const std::vector<Vec3>& vertices);

/// The vertices from which `arb` builds this one, as few as possible.
std::vector<Vec3> arb_vertices(const Arb& solid);

}  // namespace csgrt
