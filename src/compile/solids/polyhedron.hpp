// Polyhedra: convex solids as intersections of half-spaces. The file has their faces, and the box around them.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

#include "compile/linear.hpp"

namespace csgrt {

/// The plane through p with an outward normal of any length but 0.
Plane plane_through(const Wide& p, const Wide& normal);

/// A plane of the model, transformed to the world.
Plane transform_plane(const Matrix& matrix, const Plane& plane);

/// The faces of an arb in the world; outward is away from the mean of the corners. If faces are flat except for
/// rounding, however thin the arb, they go through their widest triangles of corners. Else a face is the plane through
/// its first three corners that are neither nearly equal nor in line, in BRL-CAD's order. A face with fewer such
/// corners is left out. Where corners lie outside, the sides of the corners' box are added.
struct ArbFaces {
    std::vector<Plane> planes;
    bool is_hull = false;  ///< the planes bound the corners' hull: faces are flat, no corner lies outside
};
ArbFaces arb_faces(const Arb& arb, const Matrix& matrix);

/// The faces of an arbn in the world.
std::vector<Plane> arbn_faces(const Arbn& arbn, const Matrix& matrix);

/// The box around the intersection of half-spaces: the whole space if the intersection is not bounded, empty if the
/// intersection is empty. Expected time is linear in the number of planes. `near`: a point near the solid, which
/// improves precision.
Box polyhedron_box(const std::vector<Plane>& planes, const Vec3& near = {});

}  // namespace csgrt
