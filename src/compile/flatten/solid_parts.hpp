// Parts of solids that are made of others. A pipe is tubes and bends, a cline a cylinder with or without a bore, and an
// arb that is not convex the surface of its faces.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// One solid in a form that the kernels know.
struct SolidPart {
    Shape shape;
    std::vector<Plane> cuts;  ///< a torus only, two at most: the part inside all of them is kept
};

/// The parts of a solid, and the tree that makes the solid of them. Flattening puts this tree in place of the solid's
/// leaf.
struct SolidParts {
    std::vector<SolidPart> parts;  ///< empty: the solid is not made of others
    FlatTree tree;                 ///< leaves are numbers of parts
};

/// Takes a pipe or a cline apart, or an arb that is_concave. The solid must be sound (see solid_faults).
SolidParts parts_of(const Shape& shape);

}  // namespace csgrt
