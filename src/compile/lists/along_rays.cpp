#include "compile/lists/along_rays.hpp"

#include "base/parallel.hpp"

namespace csgrt {
namespace {

RayPartitions along(const Partitions& all, std::size_t ray) {
    RayPartitions one;
    for (auto i = static_cast<std::size_t>(all.ray_splits[ray]); i < static_cast<std::size_t>(all.ray_splits[ray + 1]);
         ++i)
        one.partitions.push_back({.in = all.t_in[i],
                                  .out = all.t_out[i],
                                  .in_normal = all.in_normals[i],
                                  .out_normal = all.out_normals[i],
                                  .region = static_cast<std::uint32_t>(all.region_ids[i]),
                                  .in_solid = static_cast<std::uint32_t>(all.in_solids[i]),
                                  .out_solid = static_cast<std::uint32_t>(all.out_solids[i])});
    for (auto i = static_cast<std::size_t>(all.overlap_splits[ray]);
         i < static_cast<std::size_t>(all.overlap_splits[ray + 1]); ++i) {
        if (all.overlap_t_out[i] < 0) continue;
        one.overlaps.push_back({.in = all.overlap_t_in[i],
                                .out = all.overlap_t_out[i],
                                .regions = {all.overlap_region_ids.begin() + all.overlap_region_splits[i],
                                            all.overlap_region_ids.begin() + all.overlap_region_splits[i + 1]}});
    }
    return one;
}

}  // namespace

std::vector<RayPartitions> along_rays(const Partitions& all) {
    std::vector<RayPartitions> rays(all.ray_splits.size() - 1);
    for_chunks(rays.size(), 1024, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t ray = first; ray < last; ++ray) rays[ray] = along(all, ray);
    });
    return rays;
}

}  // namespace csgrt
