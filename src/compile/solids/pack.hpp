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

/// A note on a revolve's turn; usually empty.
std::string note_on(const Revolve& s);

/// Throws Error (scene) if 32 bits cannot count so many numbers.
void check_numbers(std::size_t count);

}  // namespace csgrt
