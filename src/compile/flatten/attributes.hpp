// Attributes: colour and finish, inherited on the way down to a region.
#pragma once

#include <cstdint>
#include <optional>

#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>

namespace csgrt {

/// The attributes that the combinations above have set. A combination sets its attributes, except those that a
/// combination above has set and wants to be inherited.
struct Attributes {
    std::optional<Vec3> color;
    const Finish* finish = nullptr;  ///< in the scene
    bool color_fixed = false, finish_fixed = false;

    void apply(const Combination& combination);
};

/// RANK_x, by which regions are numbered.
std::uint32_t rank_of(const RegionInfo& region);

/// The region's info except path and bounds. A null `region` means a solid that no region contains: then all members
/// are 0. BRL-CAD's colour table colours a region by its id, unless a combination has given it a colour.
RegionInfo describe_region(const Combination* region, const Attributes& attributes,
                           const std::vector<RegionColor>& region_colors);

}  // namespace csgrt
