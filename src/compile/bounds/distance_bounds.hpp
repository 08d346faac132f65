// A bound of the distance to a solid's surface: less than 0 inside, and it changes by no more than the distance moved.
// So the surface is no nearer than the bound says.
//
// A solid is what a body and planes have in common; many have only the one or the other. Each body has a function g in
// its own coordinates, which are L (p - center). With s, the steepest slope of g in millimetres, the body's bound is
// g / s. The solid's bound is the greatest of its body's and its planes'.
#pragma once

#include <vector>

#include <csgrt/vector.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {

class DistanceBounds {
public:
    explicit DistanceBounds(const CompiledScene& scene);
    /// Whether the solid has a bound. Solids of triangles and curves, and some others, have none.
    bool has(std::uint32_t solid) const { return scales_[solid] > 0; }
    /// Millimetres, for a solid that has a bound.
    double at(std::uint32_t solid, const Vec3& point) const;

    /// A part of a solid's boundary: its body's or a plane's.
    struct Piece {
        double distance = 0;  ///< mm: the bound
        /// How much the bound changes with the point: outwards, a unit vector, or shorter. Of a convex piece it is
        /// exact but for rounding; else it may be a difference.
        Vec3 slope = {};
        bool is_convex = false, is_plane = false;
    };
    /// Appends the pieces of a solid that has a bound, but for those with the point deeper than `reach` behind them.
    void append_pieces(std::uint32_t solid, const Vec3& point, double reach, std::vector<Piece>& pieces) const;

private:
    double body(std::uint32_t solid, const Vec3& point, Vec3* slope = nullptr) const;
    template <class Take>
    void for_planes(std::uint32_t solid, const Take& take) const;

    const CompiledScene& scene_;
    std::vector<double> scales_;  ///< by solid: 1 / s; 1 without a body; 0: it has no bound
};

}  // namespace csgrt
