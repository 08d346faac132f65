#include "compile/claims.hpp"

#include "compile/tables.hpp"

namespace csgrt {
namespace {

kernel::ray3 to_kernel(const Ray& r) {
    return {{r.origin.x, r.origin.y, r.origin.z}, {r.direction.x, r.direction.y, r.direction.z}};
}

Vec3 normal(const CompiledScene& scene, const kernel::ray3& ray, const kernel::End& end, bool flip) {
    kernel::vec3 n = kernel::normal_at(tables(scene), scene.solids[end.solid], ray, end.t, end.surface);
    if (flip) n = kernel::scale(n, -1);
    return {n.x, n.y, n.z};
}

}  // namespace

RayPartitions to_partitions(const CompiledScene& scene, const Ray& ray, const std::vector<ClaimedPartition>& claims) {
    RayPartitions result;
    const kernel::ray3 r = to_kernel(ray);
    std::size_t i = 0;
    while (i < claims.size()) {
        const ClaimedPartition& first = claims[i];
        std::size_t last = i;
        while (last + 1 < claims.size() && claims[last + 1].region == first.region &&
               claims[last + 1].in.t == claims[last].out.t)
            ++last;
        const ClaimedPartition& end = claims[last];
        Partition p;
        p.in = first.in.t;
        p.out = end.out.t;
        p.region = first.region;
        p.in_solid = first.in.solid;
        p.out_solid = end.out.solid;
        i = last + 1;
        if (p.out < 0) continue;
        p.in_normal = normal(scene, r, first.in, first.in_leaves);
        p.out_normal = normal(scene, r, end.out, end.out_enters);
        result.partitions.push_back(p);
    }
    for (const ClaimedPartition& claim : claims) {
        if (claim.claimants.size() < 2 || claim.out.t < 0) continue;
        if (!result.overlaps.empty()) {
            Overlap& before = result.overlaps.back();
            if (before.out == claim.in.t && before.regions == claim.claimants) {
                before.out = claim.out.t;
                continue;
            }
        }
        result.overlaps.push_back({claim.in.t, claim.out.t, claim.claimants});
    }
    return result;
}

}  // namespace csgrt
