// Depths in regions, by their solids: how far a point is from the boundary, at least, and planes that touch it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "analysis/boxes.hpp"
#include "analysis/inscribed_ball.hpp"
#include "compile/bounds/distance_bounds.hpp"

namespace csgrt::analysis {

/// Distance of a point from a region's boundary, as far as it is known, in millimetres.
struct Depth {
    double in = 0, out = 0;  ///< a ball of this radius lies inside, outside; 0 or less: none is known to
};

/// Region's tree for points in a box. For one thread; its memory serves point after point.
class RegionDepth {
public:
    RegionDepth(const CompiledScene& scene, const DistanceBounds& bounds, const std::vector<FlatTree::Node>& tree,
                const Box& box);
    /// The same for a smaller box.
    RegionDepth in(const Box& box) const { return {scene_, bounds_, nodes_, box}; }

    Depth at(const Vec3& point);
    /// Appends planes that touch the region's boundary near the point, as far as it is known. `reach`: mm from the
    /// point within which is_near and is_sure hold.
    void append_planes(const Vec3& point, double reach, std::vector<TangentPlane>& planes);
    /// Appends planes with all of the region behind them: they touch convex bodies that hold it, near the point.
    void append_supports(const Vec3& point, std::vector<TangentPlane>& planes);

private:
    Depth of_solid(std::uint32_t solid, const Vec3& point) const;
    void reduce(const std::vector<FlatTree::Node>& tree, const Box& box);
    template <class Take>
    void for_operands(std::size_t node, const Take& take) const;

    const CompiledScene& scene_;
    const DistanceBounds& bounds_;
    std::vector<FlatTree::Node> nodes_;  ///< of the tree, without solids that are nowhere in the box
    std::vector<std::size_t> begins_;    ///< by node: where its operands begin
    std::vector<Depth> depths_;          ///< by node, of the last point
    std::vector<DistanceBounds::Piece> pieces_;
};

/// Overlap of two regions, in a box that holds all of it.
class OverlapDepth {
public:
    OverlapDepth(const CompiledScene& scene, const DistanceBounds& bounds, std::uint32_t first, std::uint32_t second,
                 const Box& box)
        : box_(box),
          regions_{RegionDepth(scene, bounds, scene.flat_trees[first].nodes, box),
                   RegionDepth(scene, bounds, scene.flat_trees[second].nodes, box)} {}
    /// The same for a smaller box.
    OverlapDepth in(const Box& box) const { return {box, regions_[0].in(box), regions_[1].in(box)}; }

    Depth at(const Vec3& point) {
        const Depth a = regions_[0].at(point), b = regions_[1].at(point);
        Depth both = {std::min(a.in, b.in), std::max(a.out, b.out)};
        for (double Vec3::*const axis : axes)
            both.in = std::min({both.in, point.*axis - box_.low.*axis, box_.high.*axis - point.*axis});
        return both;
    }
    void append_planes(const Vec3& point, double reach, std::vector<TangentPlane>& planes) {
        for (RegionDepth& region : regions_) region.append_planes(point, reach, planes);
        append_faces(planes);
    }
    void append_supports(const Vec3& point, std::vector<TangentPlane>& planes) {
        for (RegionDepth& region : regions_) region.append_supports(point, planes);
        append_faces(planes);
    }

private:
    void append_faces(std::vector<TangentPlane>& planes) const {
        for (double Vec3::*const axis : axes) {
            Vec3 out = {};
            out.*axis = 1;
            planes.push_back({box_.high, out, true, true});
            planes.push_back({box_.low, -1.0 * out, true, true});
        }
    }
    OverlapDepth(const Box& box, RegionDepth first, RegionDepth second)
        : box_(box), regions_{std::move(first), std::move(second)} {}

    Box box_;
    RegionDepth regions_[2];
};

/// Millimetres: no ball that lies behind all planes, and whose centre is no farther than `reach` from `near`, has a
/// larger diameter.
double diameter_behind(const std::vector<TangentPlane>& planes, const Vec3& near, double reach);

}  // namespace csgrt::analysis
