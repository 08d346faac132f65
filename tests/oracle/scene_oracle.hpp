// Whole scenes by point membership: which regions hold which stretches of a ray, and how sure that is.
//
// Regions by BRL-CAD's rules: a combination with the region flag is one, with all that stands below it; a solid in no
// region is one of its own. Above regions unions only collect; A - B and A + B apply to every region of A, the latter
// once for every region of B; xor and complement make one region of all they hold. Such a region is called by the path
// of its leftmost start.
//
// The matrices on the way down are multiplied in 113 bits; only their product reaches a solid.
//
// A region holds only where at least one of its solids does: the complement of nothing is no material.
//
// A ray's bounds in all solids are merged; between two neighbouring ones no membership changes, so each region's tree
// is evaluated once there, by plain recursion, in three values: inside, outside, or within the solids' doubt (see
// intersect.hpp), widened by `slack` for a weaver that takes ends so close to each other for one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sphere_tree.hpp"
#include "scene_solid.hpp"
#include "scene_weave.hpp"
#include "solids/pipe.hpp"

namespace csgrt::oracle {

class SceneOracle {
public:
    /// `objects` of the scene, empty: its top objects. `skip_unsupported`: solids of unknown types are empty sets.
    /// `air`: air regions are kept.
    explicit SceneOracle(const Scene& scene, const std::vector<std::string>& objects = {},
                         bool skip_unsupported = false, bool filtered = false, bool air = false);

    // Keeps the scene by reference; so a temporary will not do.
    explicit SceneOracle(Scene&&, const std::vector<std::string>& = {}, bool = false) = delete;

    const std::vector<OracleRegion>& regions() const { return regions_; }

    /// `slack` in millimetres.
    SceneAnswer shoot(const Ray& ray, double slack) const;

    /// Is it the normal, to either side, of some surface of the solid that runs within `reach` millimetres of the
    /// point? On an edge that of either face will do.
    bool has_normal(std::size_t solid, const QVec& point, const QVec& normal, quad reach) const;

private:
    // ---- From the scene to expressions ----

    const Object& object(const std::string& name) const;

    /// What is in one of the outer parts and in none of the bores.
    Expression composite(std::vector<PipePart> parts);

    Expression leaf(const Solid& solid, const QAffine& place);

    /// Everything below an object, as one expression.
    Expression expression(const std::string& name, const QAffine& m);

    using Starts = std::vector<OracleRegion>;

    static Expression all_of(const Starts& starts);
    static Expression apply(Operator op, const Expression& a, const Expression& b) { return {op, {a, b}, 0}; }
    static Starts combine(Operator op, const Starts& left, const Starts& right);

    /// The regions below an object that stands in none.
    Starts starts(const std::string& name, const QAffine& m, const std::string& above);

    const Scene& scene_;
    const bool skip_unsupported_, filtered_, air_;
    std::vector<SceneSolid> solids_;
    std::vector<OracleRegion> regions_;
    std::vector<std::vector<std::uint32_t>> regions_of_;  ///< by solid
    std::vector<std::size_t> everywhere_, somewhere_;     ///< solids without bounds; those that the tree has
    SphereTree tree_;
};

}  // namespace csgrt::oracle
