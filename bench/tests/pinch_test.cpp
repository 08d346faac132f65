// Pinches, tips and poles before the oracle (tests/stress/pinch.cpp), each kind of solid by itself.
#include <cstdio>

#include "base/laboratory.hpp"
#include "bench/chart/accuracy.hpp"
#include "bench/chart/truth.hpp"
#include "integration/field/judge.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/solids/all.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr const char* kinds[] = {"horn torus", "near horn",    "eto",    "cone", "on its apex",
                                 "edge top",   "near an edge", "part",   "ehy",  "hyp",
                                 "superell",   "hrt",          "revolve"};
static_assert(std::size(kinds) == stress::pinch_kinds);

stress::StressScene scene_of(std::size_t kind, std::uint64_t round, std::size_t times = 1) {
    return stress::make("pinch", kind + stress::pinch_kinds * round, times);
}

/// On the reference alone: a device needs another program for every type.
void judge_on_reference(const stress::StressScene& made, const Settings& settings, FieldTally& tally) {
    Renderer renderer(made.scene, made.objects, settings);
    std::vector<RayPartitions> found = renderer.shoot(made.rays);
    const Renumbering renumbering(renderer, made.objects);
    const ExpectedAnswers answers(made, true);
    ++tally.scenes;
    tally.rays += made.rays.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Expected expected = answers(i);
        if (expected.tie) {
            ++tally.ties;
            continue;
        }
        renumbering.apply(found[i]);
        const Compared compared = compare(found[i], expected, made.rays[i], renderer.statistics().tolerance);
        if (compared.regions) tally.worst = std::max(tally.worst, compared.worst);
        if (compared.regions && !compared.overlaps) ++tally.overlaps;
        if (!compared.regions) ++tally.wrong;
        if ((!compared.regions || compared.worst > 1) && tally.first.empty()) {
            keep_finding(compared.regions ? "far" : "wrong", made, made.scene, made.rays[i]);
            tally.first = "seed " + std::to_string(made.seed) + ", ray " + std::to_string(i) + ": " +
                          oracle::describe(made.rays[i]);
        }
    }
}

bench::Accuracy accuracy_of(const stress::StressScene& made) {
    Renderer renderer(made.scene, made.objects, on_reference());
    const std::vector<bench::TrueRay> truth = bench::true_rays(made.scene, made.objects, made.rays);
    const std::vector<RayPartitions> found = renderer.shoot(made.rays);
    bench::Accuracy accuracy;
    for (std::size_t i = 0; i < found.size(); ++i) accuracy.add(truth[i], found[i]);
    return accuracy;
}

}  // namespace

TEST_CASE("pinches, tips and poles are met as the oracle meets them", "[field][promise:rounding]") {
    for (std::size_t kind = 0; kind < stress::pinch_kinds; ++kind) {
        INFO(kinds[kind]);
        FieldTally tally;
        for (std::uint64_t round = 0; round < 3; ++round)
            judge_on_reference(scene_of(kind, round), on_reference(), tally);
        require_all_right(tally);
    }
}

TEST_CASE("pinches on the device are those on the reference, to the bit", "[field]") {
    for (const std::size_t kind : {0u, 1u, 2u, 5u, 6u, 12u}) {
        INFO(kinds[kind]);
        FieldTally tally;
        judge_field(scene_of(kind, 0), tally);
        require_all_right(tally);
    }
}

// The chart's unit: how far the end moves when the ray is moved by one unit in the last place.
TEST_CASE("ends at pinches are within 4 units in the ray's last place", "[field]") {
    for (const std::size_t kind : {0u, 1u, 2u, 5u, 6u}) {
        INFO(kinds[kind]);
        bench::Accuracy accuracy;
        for (std::uint64_t round = 0; round < 4; ++round) accuracy += accuracy_of(scene_of(kind, round));
        CHECK(accuracy.wrong == 0);
        CHECK(4 * accuracy.decided > 3 * accuracy.rays);
        CHECK(accuracy.error_ulp.worst() <= 4);
    }
}

// z^2 + rho^2 = 2 rho on the horn torus of radius 1.
TEST_CASE("a ray along the axis of a horn torus meets it where the circle says", "[field]") {
    const Tor horn{{0, 0, 0}, {0, 0, 1}, 1, 1};
    const CompiledScene scene = compile_alone(horn, identity);
    const oracle::ImplicitSolid solid = oracle::implicit(horn, oracle::to_affine(identity));
    for (const double off : {1e-3, 1e-6, 1e-9, 1e-10, 1e-11, 1e-12, 3e-13}) {
        INFO(off);
        const Ray ray{{off, 0, -0.5}, {0, 0, 1}};
        const double half = std::sqrt(off * (2 - off));
        const auto found = intersect_solid(scene, 0, ray);
        REQUIRE(found.size() == 1);
        CHECK(std::abs(found[0].in - (0.5 - half)) <= 4e-16);
        CHECK(std::abs(found[0].out - (0.5 + half)) <= 4e-16);
        // The oracle decides this ray, and rejects that nothing is there, or less.
        const oracle::Answer answer = oracle::intersect(solid, ray);
        CHECK_FALSE(answer.tie);
        REQUIRE(answer.intervals.size() == 1);
        CHECK(std::abs(answer.intervals[0].in.t - (0.5 - half)) <= 4e-16);
        CHECK_FALSE(oracle::judge(solid, ray, answer, {}).wrong.empty());
        oracle::Segment segment{found[0].in, found[0].out, found[0].in_normal, found[0].out_normal};
        CHECK(oracle::judge(solid, ray, answer, {segment}).wrong.empty());
        segment.in = 0.5 - 0.5 * half;
        // Closer, the 1e-12 of the size by which the surface may be off move the end by as much.
        if (off > 1e-11) CHECK_FALSE(oracle::judge(solid, ray, answer, {segment}).wrong.empty());
    }
}

// The ray runs beside the side from far off: f falls by 0.7 % of what its terms change by, until 10^-4 before the tip.
// The ends are of 60 digits' arithmetic, by the definition.
TEST_CASE("a ray along the side of a pointed superellipsoid meets its tip", "[field][promise:rounding]") {
    const Superell pointed{{2.9616880392244935, -1.853129323327839, 3.6616108962409397},
                           {-2.0678628708247495, 0.903791054162198, 0},
                           {0.11204047982719124, 0.25634724663081154, -2.6454456241357414},
                           {-1.0298711068891178, -2.3563324884260264, -0.2719491158567254},
                           2,
                           1.1398693025966784};
    const Ray ray{{-4.2506561713210216, 23.448224353497448, -3.9100127811914609},
                  {0.21125635931631684, -0.94506865797199402, 0.24943131793421172}};
    const oracle::ImplicitSolid solid = oracle::implicit(pointed, oracle::to_affine(identity));
    const oracle::Answer answer = oracle::intersect(solid, ray);
    CHECK_FALSE(answer.tie);
    CHECK_FALSE(oracle::judge(solid, ray, answer, {}).wrong.empty());
    const auto found = intersect_solid(compile_alone(pointed, identity), 0, ray);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].in - 29.26519786035334) <= 1e-12);
    CHECK(std::abs(found[0].out - 29.265265592060868) <= 1e-12);
    const oracle::Segment segment{found[0].in, found[0].out, found[0].in_normal, found[0].out_normal};
    CHECK(oracle::judge(solid, ray, answer, {segment}).wrong.empty());
}

// No way to solve a quartic but the default has to be right here.
TEST_CASE("pinches, every way to solve a quartic", "[.long]") {
    for (const auto& [name, quartic] : quartic_names) {
        for (const std::size_t kind : {0u, 1u, 2u, 5u, 6u}) {
            INFO(name << ", " << kinds[kind]);
            const Settings settings = with_methods({.quartic = quartic}, on_reference());
            FieldTally tally;
            for (std::uint64_t round = 0; round < 12; ++round)
                judge_on_reference(scene_of(kind, round, 10), settings, tally);
            std::printf("%s, %s: %zu of %zu decided rays wrong, worst end %.3g\n", std::string(name).c_str(),
                        kinds[kind], tally.wrong, tally.rays - tally.ties, tally.worst);
            std::fflush(stdout);
            if (quartic == Quartic::bracketed) require_all_right(tally);
        }
    }
}

/// 10^6 rays for tor and tgc, 10^5 for the others; CSGRT_RAYS_SHARE: so many times less.
TEST_CASE("pinches, tips and poles, a million rays", "[.long]") {
    std::size_t share = 1;
    if (const char* less = std::getenv("CSGRT_RAYS_SHARE")) share = std::strtoull(less, nullptr, 10);
    constexpr std::size_t rounds = 36;
    const std::array<std::size_t, stress::pinch_kinds> rays{500'000, 500'000, 100'000, 250'000, 250'000,
                                                            250'000, 250'000, 100'000, 100'000, 100'000,
                                                            100'000, 100'000, 100'000};
    for (std::size_t kind = 0; kind < stress::pinch_kinds; ++kind) {
        INFO(kinds[kind]);
        FieldTally tally;
        const std::size_t times = std::max<std::size_t>(1, rays[kind] / share / rounds / 60 + 1);
        for (std::uint64_t round = 0; round < rounds; ++round)
            judge_on_reference(scene_of(kind, round, times), on_reference(), tally);
        std::printf("%s: %zu rays, %zu ties, %zu wrong, worst end %.3g of what is documented %s\n", kinds[kind],
                    tally.rays, tally.ties, tally.wrong, tally.worst, tally.first.c_str());
        std::fflush(stdout);
        require_all_right(tally);
    }
}
