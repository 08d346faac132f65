#include "compile/regions/claimed_by.hpp"

#include <algorithm>

#include "compile/hash.hpp"
#include "compile/linear.hpp"
#include "compile/regions/status_tree.hpp"

namespace csgrt {

CompiledScene claimed_by(const CompiledScene& scene, State state) {
    CompiledScene some = scene;
    std::vector<std::uint8_t>& claims = some.claims.own();
    claims.resize(scene.region_info.size());
    const auto has_state = [&](std::uint8_t own) { return own == static_cast<std::uint8_t>(state); };
    std::ranges::transform(scene.states.get(), claims.begin(), has_state);
    std::vector<kernel::StartRecord>& starts = some.starts.own();
    const auto claims_start = [&](const kernel::StartRecord& start) { return claims[start.region] != 0; };
    Box around = empty_box;
    std::size_t number = 0;
    for (kernel::SolidRecord& solid : some.solids.own()) {
        const Box& box = scene.solid_boxes[number++];
        const auto first = starts.begin() + solid.first_start;
        const auto end = std::stable_partition(first, first + solid.start_count, claims_start);
        const auto count = static_cast<std::uint32_t>(end - first);
        // `alone` is still known if all of the solid's terms are left, or none. `begins` may have more bits than
        // needed.
        if (count < solid.start_count) solid.alone = count == 0 ? NONE : ALONE_UNKNOWN;
        solid.start_count = count;
        if (count > 0) around = united(around, box);
    }
    some.claim_box = around;
    std::vector<std::uint8_t>& starting = some.starting.own();
    starting.resize(scene.nodes.size());
    for (std::size_t i = starting.size(); i-- > 0;) {
        const kernel::BvhNode& node = scene.nodes.get()[i];
        if (!node.leaf) starting[i] = starting[i + 1] | starting[scene.nodes.get()[i + 1].skip];
        for (std::uint32_t k = 0; k < (node.leaf & BVH_LEAF_MASK); ++k)
            starting[i] |= some.solids.get()[(node.leaf >> BVH_LEAF_SHIFT) + k].start_count > 0;
    }
    some.status_tree = std::make_shared<LateStatusTree>();
    some.hash = hash_of(some);
    return some;
}

}  // namespace csgrt
