// Placed solids: a solid's parameters after a matrix.
#pragma once

#include <optional>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The solid that `shape` becomes by an affine matrix, in the same type's parameters. Ellipsoids, cones, polyhedra and
/// half-spaces may become any of their kind; the other solids with an axis keep their form only if the matrix moves,
/// turns, mirrors and scales them alike in all directions. None: there are no such parameters, or the type has lists of
/// points, curves or cells.
std::optional<Shape> placed(const Shape& shape, const Matrix& matrix);

}  // namespace csgrt
