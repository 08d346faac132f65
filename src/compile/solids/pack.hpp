// Solids -> SolidRecord, reals and plane references, as geometry/<solid>.h reads them.
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

/// Where in Shapes::words the parts of a solid of many parts begin, by the address of its Shape (or of what it
/// holds): its other places use the same.
using SharedParts = std::unordered_map<const void*, std::uint32_t>;

/// Each instance of `order` becomes a solid, whose record begins as `terms` gives it; `common` stands for the box of
/// those that are not bounded; `clipped` says which half-spaces end, and where. The arithmetic is done by several
/// threads. Throws Error (scene) for a type that csgrt does not know, or when the tables exceed 32 bits.
Shapes pack_solids(const Scene& scene, const FlatScene& flat, const Measured& measured, const Clipped& clipped,
                   const std::vector<std::uint32_t>& order, const Space& space, const Box& common,
                   const std::vector<kernel::SolidRecord>& terms, std::vector<Warning>& warnings);

/// What is worth telling of a revolve's turn; usually nothing.
std::string note_on(const Revolve& s);

/// Throws Error (scene) if so many numbers cannot be told apart by 32 bits.
void check_numbers(std::size_t count);

}  // namespace csgrt
