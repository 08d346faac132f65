#include "compile/regions/claimed_by.hpp"

#include <utility>

#include "compile/hash.hpp"
#include "compile/regions/status_tree.hpp"

namespace csgrt {

CompiledScene claimed_by(const CompiledScene& scene, std::vector<std::uint8_t> claims) {
    std::vector<kernel::SolidRecord> solids = scene.solids;
    std::vector<kernel::StartRecord> starts;
    starts.reserve(scene.starts.size());
    for (kernel::SolidRecord& solid : solids) {
        const auto first = static_cast<std::uint32_t>(starts.size());
        for (std::uint32_t i = solid.first_start; i < solid.first_start + solid.start_count; ++i)
            if (claims[scene.starts[i].region]) starts.push_back(scene.starts[i]);
        const auto count = static_cast<std::uint32_t>(starts.size()) - first;
        // `alone` is still known if all of the solid's terms are left, or none. `begins` may have more bits than
        // needed.
        if (count < solid.start_count) solid.alone = count == 0 ? NONE : ALONE_UNKNOWN;
        solid.first_start = first;
        solid.start_count = count;
    }
    CompiledScene some = scene;
    some.solids = std::move(solids);
    some.starts = std::move(starts);
    some.claims = std::move(claims);
    some.status_tree = std::make_shared<LateStatusTree>();
    some.hash = hash_of(some);
    return some;
}

}  // namespace csgrt
