#include "check_kernels.hpp"

#include <sstream>

#include "catch.hpp"

#include "kernels/geometry/kernel_answer.hpp"

namespace csgrt {

void check_kernels(oracle::Kind kind, std::size_t rays, std::uint64_t seed, std::size_t known) {
    using oracle::RayFamily;
    const oracle::Campaign campaign = oracle::run_campaign(kind, rays, seed, kernel_answer);
    const bool has_more = campaign.total().wrong > known;
    for (const std::string& failure : campaign.failures)
        if (has_more) FAIL_CHECK(failure);
    CHECK(campaign.total().wrong <= known);

    // Were the rays what they are meant to be? Enough of them hit, and few are left undecided.
    std::ostringstream summary;
    for (std::size_t i = 0; i < oracle::ray_families; ++i) {
        const oracle::Tally& t = campaign.tally[i];
        summary << oracle::ray_family_names[i] << ": " << t.rays << " rays, " << t.hits << " hit, " << t.ties
                << " ties, " << t.wrong << " wrong\n";
        CHECK(t.hits * 4 > t.rays);
        CHECK(t.ties * 2 < t.rays);
    }
    INFO(summary.str() << "largest error: " << campaign.worst << " tolerances\n" << campaign.worst_case);
    const auto ties = [&](RayFamily family) { return campaign.tally[static_cast<std::size_t>(family)].ties; };
    CHECK(ties(RayFamily::ordinary) * 1000 <= rays);
    CHECK(ties(RayFamily::far) * 100 <= rays);
    CHECK(ties(RayFamily::tangent) * 5 <= rays);
}

}  // namespace csgrt
