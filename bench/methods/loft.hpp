// Surfaces of closed sections -> closed triangle meshes.
#pragma once

#include <functional>
#include <numbers>
#include <vector>

#include "facets.hpp"

namespace csgrt::bench {

/// Of a turn, with both ends.
inline std::vector<double> quarters() {
    using std::numbers::pi;
    return {0, pi / 2, pi, 3 * pi / 2, 2 * pi};
}

/// A surface of closed sections, one behind the other.
//
//     section s0   o---o---o---o-   angles t0, t1, ..., and back to t0
//                  | / | / | / |
//     section s1   o---o---o---o-
//
struct Loft {
    enum class End { flat, point };
    std::function<Vec3(double s, double t)> at;  // in the solid's own coordinates
    std::vector<double> sections;                // where its sections have kinks, and both ends
    std::vector<double> angles = quarters();     // the same of the way around
    bool is_round = true;                        // the last angle is the first one; else an edge joins them
    bool is_ring = false;                        // the last section is the first one: there are no ends
    End first = End::flat, last = End::flat;
};

/// The mesh that facets() promises, but for the direction of its triangles. Throws Error (out_of_memory).
Triangles mesh_of(const Loft& loft, const Matrix& matrix, const FacetOptions& options);

/// Throws that.
[[noreturn]] void refuse_size();

}  // namespace csgrt::bench
