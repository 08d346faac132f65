// Estimates: means and 95 % intervals of the figures of regions and of groups of them, from sums of replicates.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include <csgrt/measure.hpp>

#include "analysis/sums.hpp"

namespace csgrt::analysis {

inline constexpr std::chrono::milliseconds between_looks{200};  ///< calls of the look() of a caller

/// Replicates are independent, so their sums may be put into few batches, whose means are independent, too.
inline constexpr std::size_t least_batches = 16, most_batches = 32;

/// The sums of a region's replicates. The i-th replicate is in the batch i % (number of batches).
struct Source {
    double rays = 0;                     ///< of one grid, approximately
    std::uint32_t replicates = 0;        ///< a multiple of the number of batches
    std::span<const Sums> batches = {};  ///< 16 or 32
    Vec3 middle = {};                    ///< what the sums are relative to
    double weight = 1;                   ///< kg/mm³ if there are densities
};

/// The mean of a figure over its batches, and its interval.
Estimate estimate_of(const std::array<double, least_batches>& batches);

struct VolumeSoFar {
    Estimate volume = {};
    double rows = 0;  ///< number of intervals that were summed
};
VolumeSoFar volume_of(const Source& source);

/// Sets the estimates of a group of regions. `is_mass`: weights are densities. The sum of several regions is estimated
/// batch by batch, so it does not matter which regions were met by the same rays.
void estimate(std::span<const Source> regions, bool is_mass, Measured& measured);

}  // namespace csgrt::analysis
