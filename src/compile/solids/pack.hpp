// Solids -> SolidRecord, reals and plane references, as geometry/<solid>.h reads them.
#pragma once

#include <string>
#include <unordered_map>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/bounds/instance_bounds.hpp"
#include "compile/solids/planes.hpp"
#include "compile/solids/surfaces.hpp"

namespace csgrt {

/// Where in CompiledScene::words the parts of a solid of many parts begin, by the address of its Shape (or of what it
/// holds): its other places use the same.
using SharedParts = std::unordered_map<const void*, std::uint32_t>;

/// Appends a solid in its place to solids, reals and words of `scene`, and its faces to `planes`. `box` is the
/// solid's own, or the scene's if it is not bounded. Its regions are not filled in.
/// Throws Error (scene) for a type that csgrt does not know, or when the tables exceed 32 bits.
void pack_solid(const Shape& shape, const std::vector<Plane>& cuts, const Matrix& matrix, const Box& box,
                CompiledScene& scene, PlaneTable& planes, SurfaceTable& surfaces, SharedParts& shared);

/// pack_solid for each instance of `order`; `common` stands for the box of those that are not bounded. The arithmetic
/// is done by several threads.
void pack_solids(const Scene& scene, const FlatScene& flat, const Measured& measured,
                 const std::vector<std::uint32_t>& order, const Box& common, CompiledScene& compiled);

/// What is worth telling of a revolve's turn; usually nothing.
std::string note_on(const Revolve& s);

/// Throws Error (scene) if so many numbers cannot be told apart by 32 bits.
void check_numbers(std::size_t count);

}  // namespace csgrt
