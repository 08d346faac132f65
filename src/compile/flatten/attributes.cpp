#include "compile/flatten/attributes.hpp"

#include "kernel_host/kernels.hpp"

namespace csgrt {

std::uint32_t rank_of(const RegionInfo& region) {
    if (region.finish.light && !region.finish.light->visible) return RANK_HIDDEN;
    if (region.air != 0) return RANK_AIR;
    return region.fastgen == Fastgen::none ? RANK_SOLID : region.fastgen == Fastgen::plate ? RANK_PLATE : RANK_VOLUME;
}

void Attributes::apply(const Combination& combination) {
    if (combination.color && !color_fixed) {
        color = combination.color;
        color_fixed = combination.color_inherits;
    }
    if (combination.finish && !finish_fixed) {
        finish = &*combination.finish;
        finish_fixed = combination.finish_inherits;
    }
}

RegionInfo describe_region(const Combination* region, const Attributes& attributes,
                           const std::vector<RegionColor>& region_colors) {
    RegionInfo info;
    if (region != nullptr) {
        info.region_id = region->region_id;
        info.air = region->air;
        info.fastgen = region->fastgen;
        info.material_id = region->material_id;
        info.los = region->los;
    }
    if (attributes.finish != nullptr) info.finish = *attributes.finish;
    if (attributes.color) {
        info.color = *attributes.color;
        return info;
    }
    for (const RegionColor& entry : region_colors) {
        if (entry.low <= info.region_id && info.region_id <= entry.high) {
            info.color = entry.color;
            break;
        }
    }
    return info;
}

}  // namespace csgrt
