#include "compile/regions/claims.hpp"

namespace csgrt {
namespace {

Vec3 flipped(Vec3 n, bool flip) { return flip ? Vec3{-n.x, -n.y, -n.z} : n; }

}  // namespace

RayPartitions to_partitions(const HostKernels& kernels, const kernel::Frame& frame, const Ray& ray,
                            const std::vector<ClaimedPartition>& claims) {
    RayPartitions result;
    const auto distance = [&](const kernel::End& end) { return kernels.distance(frame, ray, end.t); };
    std::size_t i = 0;
    while (i < claims.size()) {
        const ClaimedPartition& first = claims[i];
        std::size_t last = i;
        while (last + 1 < claims.size() && claims[last + 1].region == first.region &&
               claims[last + 1].in.t == claims[last].out.t)
            ++last;
        const ClaimedPartition& end = claims[last];
        Partition p;
        p.in = distance(first.in);
        p.out = distance(end.out);
        p.region = first.region;
        p.in_solid = first.in.solid;
        p.out_solid = end.out.solid;
        i = last + 1;
        if (p.out < 0) continue;
        p.in_normal = flipped(kernels.normal(frame, ray, first.in), first.in_leaves);
        p.out_normal = flipped(kernels.normal(frame, ray, end.out), end.out_enters);
        result.partitions.push_back(p);
    }
    for (const ClaimedPartition& claim : claims) {
        if (claim.claimants.size() < 2) continue;
        const double in = distance(claim.in), out = distance(claim.out);
        if (!result.overlaps.empty()) {
            Overlap& before = result.overlaps.back();
            if (before.out == in && before.regions == claim.claimants) {
                before.out = out;
                continue;
            }
        }
        result.overlaps.push_back({in, out, claim.claimants});
    }
    std::erase_if(result.overlaps, [](const Overlap& overlap) { return overlap.out < 0; });
    return result;
}

}  // namespace csgrt
