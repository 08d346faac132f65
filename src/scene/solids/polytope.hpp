// Polytope: computes the corners of an intersection of half-spaces.
#pragma once

#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// An intersection of half-spaces, described by its corners.
struct Polytope {
    enum class Kind {
        empty,  ///< no point is strictly inside all half-spaces
        bounded,
        unbounded,  ///< extends farther than a million times the farthest plane's distance
    };
    Kind kind = Kind::empty;
    std::vector<Vec3> vertices;  ///< corners of a bounded polytope; a corner may be repeated
};

/// Clips a large cube by one half-space after the other. Normals are unit vectors. Time grows with planes x faces: a
/// thousand planes take hundredths of a second, Limits::faces a second or two. The vertices' errors are about 1e-10 of
/// the farthest plane's distance after a first pass, and 1e-15 of the polytope's size after a second.
Polytope intersect_half_spaces(const std::vector<Plane>& planes);

}  // namespace csgrt
