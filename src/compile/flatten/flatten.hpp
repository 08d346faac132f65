// Flattening: makes regions of a Scene. A region has one flat tree over solids under their transforms. Combinations,
// their matrices and names are resolved.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
    RegionInfo info;         ///< all members but the bounds
    FlatTree tree;           ///< leaves are instances
    std::uint32_t term = 0;  ///< of the walk that found it
};

struct FlatWalk;

/// A scene after flattening: regions, and instances with their matrices from the root.
struct FlatScene {
    std::vector<std::vector<Matrix>> matrices;  ///< of the instances
    std::vector<Instance> instances;            ///< all instances that trees use, in the order of first use
    std::vector<FlatRegion> regions;            ///< by rank; regions of one rank in the order of the walk
    std::unordered_map<std::uint32_t, SolidParts> composites;  ///< by object: the solids that are made of other solids
    std::vector<Warning> warnings;
    bool has_numbered_paths = false;                                          ///< some regions' paths were equal
    std::shared_ptr<FlatWalk> walk;                                           ///< what place_again() needs
    std::unordered_map<std::uint32_t, std::unique_ptr<Matrix>> placed_again;  ///< by instance: matrices
};

/// The shape of an instance, and the planes that cut it.
const Shape& shape_of(const Scene& scene, const FlatScene& flat, const Instance& instance);
const std::vector<Plane>& cuts_of(const FlatScene& flat, const Instance& instance);

/// Flattens `objects`, down to solids. Names and trees of the scene must be without faults; `instances`: see Validated.
/// Throws Error (scene): too many solids, or a region that contains the empty space outside all solids; a lenient scene
/// leaves such a region out.
FlatScene flatten(const Scene& scene, const Names& names, const std::vector<std::uint64_t>& instances,
                  const std::vector<std::string>& objects, bool air, std::uint64_t max_instances = 0);

/// Members whose matrices have changed, in all instances of their combinations (sorted), or in one instance.
struct ChangedMembers {
    std::vector<Member> all;
    std::vector<MemberPath> alone;
};

/// The instances that have other matrices, and all regions that may use these instances.
struct Moved {
    std::vector<std::uint32_t> instances, regions;
};
/// Gives the instances their matrices again, when those of some members have changed in the Names. The arguments of
/// flatten() must still be there. Nothing: the scene has to be flattened anew, since other instances are equal now, or
/// much has moved; instances are as before, and a call with the earlier matrices in the Names makes all as before.
std::optional<Moved> place_again(FlatScene& flat, const ChangedMembers& changed);

/// Takes out the regions to which some members lead, which are operands of unions, and returns their numbers and those
/// of their instances, both ascending; the instances keep their places. `removed` is sorted. Nothing: as above; also if
/// other regions hang on the members.
std::optional<Moved> take_out(FlatScene& flat, const std::vector<Member>& removed);

/// Flattens a scene and ignores its findings.
FlatScene flatten(const Scene& scene, const std::vector<std::string>& objects, bool air);

}  // namespace csgrt
