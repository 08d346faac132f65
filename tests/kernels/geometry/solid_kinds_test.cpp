// The kernels' answers for each kind of solid before the oracle.
#include <sstream>

#include "catch.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/campaign.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

constexpr std::size_t short_run = test::tries(10'000), long_run = 1'000'000;

struct Kind {
    const char* name;
    oracle::Kind kind;
    std::size_t rays = short_run, many_rays = long_run;  ///< in equal parts of the seven families; 42 at each solid
    std::size_t known = 0;  ///< how many of `many_rays` may be wrong, because docs/accuracy.md says so
};

// The oracle samples hrt and metaball closely, looks closely at the seams of part's three surfaces, and takes powers
// for superell: less of them.
const Kind kinds[] = {
    {"ell", oracle::Kind::ell},
    {"tgc", oracle::Kind::tgc},
    {"arb", oracle::Kind::arb},
    {"arbn", oracle::Kind::arbn},
    {"half", oracle::Kind::half},
    {"tor", oracle::Kind::tor},
    {"ehy", oracle::Kind::ehy},
    {"part", oracle::Kind::part, short_run / 3, long_run, 4},
    {"epa", oracle::Kind::epa},
    {"rpc", oracle::Kind::rpc},
    {"rhc", oracle::Kind::rhc},
    {"eto", oracle::Kind::eto},
    {"hyp", oracle::Kind::hyp},
    {"superell", oracle::Kind::superell, short_run / 10, 50'000},
    {"hrt", oracle::Kind::hrt, short_run / 4, 250'000},
    {"metaball", oracle::Kind::metaball, short_run / 40, 20'000},
};
static_assert(std::size(kinds) == oracle::kind_count);

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

}  // namespace

TEST_CASE("geometry: each kind of solid agrees with the oracle", "[geometry]") {
    for (const Kind& kind : kinds) DYNAMIC_SECTION(kind.name) {
            check_kernels(kind.kind, kind.rays, 1, 0);
        }
}
TEST_CASE("geometry: each kind of solid agrees with the oracle on a million rays", "[.long]") {
    for (const Kind& kind : kinds) DYNAMIC_SECTION(kind.name) {
            check_kernels(kind.kind, kind.many_rays, 2, kind.known);
        }
}
