// Boxes around solids and regions.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/solids/polyhedron.hpp"

namespace csgrt {

struct SolidBoxes {
    /// Around everything that a ray can hit of the solid: tight, and rounded outward. Infinite if it is not bounded.
    Box tight;
    /// The box that BRL-CAD gives the solid, which is wider for some (cones, hyperboloids), and not rounded. The boxes
    /// of regions and with them its view of a model come from these.
    Box brlcad;
};
/// `cuts` (a torus only; see Piece) leave what is inside them. `faces`: an arb's, if they are known.
SolidBoxes solid_boxes(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {},
                       const ArbFaces* faces = nullptr);

inline Box solid_box(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {}) {
    return solid_boxes(shape, matrix, cuts).tight;
}
inline Box brlcad_box(const Shape& shape, const Matrix& matrix, const std::vector<Plane>& cuts = {}) {
    return solid_boxes(shape, matrix, cuts).brlcad;
}

/// BRL-CAD's rules for a tree: union and xor hold both, intersection what is common, difference the left side;
/// `boxes` is one a solid. A complement is the whole space.
Box tree_box(const FlatTree& tree, const std::vector<Box>& boxes);
/// The same of the subtree of each node.
std::vector<Box> subtree_boxes(const FlatTree& tree, const std::vector<Box>& boxes);

}  // namespace csgrt
