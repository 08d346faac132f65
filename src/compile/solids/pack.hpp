// Packing solids: makes the SolidRecord, the reals and the plane references that geometry/<solid>.h reads.
#pragma once

#include <string>
#include <unordered_map>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/half_spaces.hpp"
#include "compile/bounds/instance_bounds.hpp"
#include "compile/solids/planes.hpp"
#include "compile/solids/surfaces.hpp"

namespace csgrt {

/// The positions in Shapes::words of the elements of solids without a fixed size. The key is the address of the Shape,
/// or of one of its members. All instances of the solid share the elements.
using SharedParts = std::unordered_map<const void*, std::uint32_t>;

/// Packs each instance of `order` as a solid; `terms` has the first version of its record. `common`: the box that is
/// used for unbounded solids. `clipped` tells which half-spaces are bounded, and by which box. Several threads do the
/// arithmetic. Throws Error (scene) for a type that csgrt does not know, or when the tables exceed 32 bits.
Shapes pack_solids(const Scene& scene, const FlatScene& flat, const Measured& measured, const Clipped& clipped,
                   const std::vector<std::uint32_t>& order, const Space& space, const Box& common,
                   const std::vector<kernel::SolidRecord>& terms, std::vector<Warning>& warnings);

/// A note on a revolve's turn; usually empty.
std::string note_on(const Revolve& s);

/// Throws Error (scene) if 32 bits cannot count so many numbers.
void check_numbers(std::size_t count);

}  // namespace csgrt
