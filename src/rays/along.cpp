#include "rays/along.hpp"

#include "base/along.hpp"
#include "base/parallel.hpp"

namespace csgrt {

std::vector<RayPartitions> along_rays(const Partitions& all) {
    std::vector<RayPartitions> rays(all.ray_splits.size() - 1);
    for_chunks(rays.size(), 1024, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t ray = first; ray < last; ++ray) {
            rays[ray] = along_ray(all, ray);
            const auto is_behind = [](const auto& part) { return part.out < 0; };
            std::erase_if(rays[ray].partitions, is_behind);
            std::erase_if(rays[ray].overlaps, is_behind);
        }
    });
    return rays;
}

}  // namespace csgrt
