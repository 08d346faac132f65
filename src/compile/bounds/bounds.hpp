// Bounds: the boxes around solids and regions.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/solids/polyhedron.hpp"

namespace csgrt {

/// The two boxes of a solid: the tight box is for tracing, BRL-CAD's box is for views and reports.
struct SolidBoxes {
    /// The box around everything that a ray can hit of the solid: tight, and rounded outward. Infinite if the solid is
    /// not bounded.
    Box tight;
    /// The box that BRL-CAD gives the solid: wider for some types (cones, hyperboloids), and not rounded. BRL-CAD's
    /// boxes of regions and its view of a model are made from these boxes.
    Box brlcad;
};
/// The two boxes of a solid. `cuts`: planes that keep the part inside them (of a torus only; see SolidPart). `faces`:
/// the faces of an arb, if they are known.
SolidBoxes solid_boxes(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {},
                       const ArbFaces* faces = nullptr);

inline Box solid_box(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {}) {
    return solid_boxes(shape, matrix, cuts).tight;
}
inline Box brlcad_box(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {}) {
    return solid_boxes(shape, matrix, cuts).brlcad;
}

/// The box of a tree by BRL-CAD's rules: a union or xor has the box around the two operands, an intersection their
/// common part, a difference the left operand's box, and a complement the whole space. `boxes`: one a solid.
Box tree_box(const FlatTree& tree, const std::vector<Box>& boxes);
/// The boxes of the subtrees of all nodes, by the same rules.
std::vector<Box> subtree_boxes(const FlatTree& tree, const std::vector<Box>& boxes);

}  // namespace csgrt
