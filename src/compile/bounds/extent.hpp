// Extent of a scene's placed solids: limits on their distance and size, within which the arithmetic keeps its meaning.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/flatten/flatten.hpp"
#include "compile/bounds/instance_bounds.hpp"

namespace csgrt {

/// A solid, and its fault under one of its transforms.
struct ExtentFault {
    std::uint32_t object;
    std::string text;
};

/// The fault of an instance; empty: none.
std::string extent_fault(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured, std::size_t number);

/// The solids that are larger, smaller or farther away than Limits allows.
std::vector<ExtentFault> extent_faults(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured);

}  // namespace csgrt
