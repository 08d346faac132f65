// Solid parts: some solids are made of other solids. A pipe is tubes and bends, a cline is a cylinder with or without a
// bore, and an arb that is not convex is the surface of its faces.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// One part: a solid of a type that the kernels have.
struct SolidPart {
    Shape shape;
    std::vector<Plane> cuts;  ///< a torus only, two at most: the part inside all of them is kept
};

/// The parts of a solid, and the tree that makes the solid of them. Flattening puts this tree in place of the solid's
/// leaf.
struct SolidParts {
    std::vector<SolidPart> parts;  ///< empty: the solid is not made of other solids
    FlatTree tree;                 ///< leaves are numbers of parts
};

/// Makes the parts of a pipe, of a cline, or of an arb that is_concave. The solid must have no faults (see
/// solid_faults).
SolidParts parts_of(const Shape& shape);

}  // namespace csgrt
