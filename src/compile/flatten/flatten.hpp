// Flattening: makes regions of a Scene. A region has one flat tree over solids under their transforms. Combinations,
// their matrices and names are resolved.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/flatten/solid_parts.hpp"
#include "scene/names.hpp"

namespace csgrt {

/// An instance: a solid under one transform. Equal solids with bit-equal matrices are one instance.
struct Instance {
    std::uint32_t object = 0;        ///< into Scene::objects
    std::uint32_t piece = 0;         ///< number of a part, if the solid is made of other solids
    const Matrix* matrix = nullptr;  ///< from the root: M_top ... M_member; most instances of a region share one matrix
};

/// A region after flattening: one Boolean tree over instances, without combinations.
struct FlatRegion {
    RegionInfo info;  ///< all members but the bounds
    FlatTree tree;    ///< leaves are instances
};

/// A scene after flattening: regions, and instances with their matrices from the root.
struct FlatScene {
    std::vector<std::vector<Matrix>> matrices;  ///< of the instances
    std::vector<Instance> instances;            ///< all instances that trees use, in the order of first use
    std::vector<FlatRegion> regions;            ///< by rank; regions of one rank in the order of the walk
    std::unordered_map<std::uint32_t, SolidParts> composites;  ///< by object: the solids that are made of other solids
    std::vector<Warning> warnings;
};

/// The shape of an instance, and the planes that cut it.
const Shape& shape_of(const Scene& scene, const FlatScene& flat, const Instance& instance);
const std::vector<Plane>& cuts_of(const FlatScene& flat, const Instance& instance);

/// Flattens `objects`, down to solids. Names and trees of the scene must be without faults; `instances`: see Validated.
/// Throws Error (scene): too many solids, or a region that contains the empty space outside all solids; a lenient scene
/// leaves such a region out.
FlatScene flatten(const Scene& scene, const Names& names, const std::vector<std::uint64_t>& instances,
                  const std::vector<std::string>& objects, bool air, std::uint64_t max_instances = 0);

/// Flattens a scene and ignores its findings.
FlatScene flatten(const Scene& scene, const std::vector<std::string>& objects, bool air);

}  // namespace csgrt
