// How often intervals hold the true figures, and how large errors are. ctest -C Long -L coverage; minutes long.
#include <cmath>
#include <cstdio>

#include "bodies.hpp"
#include "catch.hpp"
#include "figures.hpp"

using namespace csgrt;

namespace {

constexpr std::size_t compact = 8;  ///< of the bodies, the first ones
constexpr std::size_t figures = 17;
constexpr int seeds = 500;

struct Seen {
    std::array<int, figures> covered = {};
    std::array<double, figures> squares = {};  ///< of errors
    double rays = 0;
};

Seen seen(const test::Body& body, int count, MeasureRequest request) {
    const Settings settings{.device = "native"};
    Measurer measurer(Model(body.scene, {}, settings), settings);
    const std::vector<double> truths = test::truths_of(body);
    Seen all;
    for (int seed = 1; seed <= count; ++seed) {
        request.seed = static_cast<std::uint64_t>(seed);
        const Measurement result = measurer.measure(request);
        all.rays += static_cast<double>(result.rays) / count;
        for (const Measured& m : result.parts) {
            if (m.name != "/" + body.name) continue;
            const std::vector<Estimate> estimates = test::estimates_of(m);
            for (std::size_t i = 0; i < figures; ++i) {
                const double error = estimates[i].value - truths[i];
                all.covered[i] += std::abs(error) <= estimates[i].half_width;
                all.squares[i] += error * error / count;
            }
        }
    }
    return all;
}

void print(const test::Body& body, const Seen& all) {
    std::printf("%-14s %10.0f rays, volume %.1e, area %.1e, covered", body.name.c_str(), all.rays,
                std::sqrt(all.squares[0]) / body.volume, std::sqrt(all.squares[1]) / body.area);
    for (const int covered : all.covered) std::printf(" %d", covered);
    std::printf("\n");
    std::fflush(stdout);
}

}  // namespace

TEST_CASE("95 % intervals hold the true figures in 95 % of 500 measures", "[.coverage]") {
    const std::vector<test::Body> bodies = test::bodies();
    int pooled = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Seen all = seen(bodies[b], seeds, {});
        print(bodies[b], all);
        for (const int covered : all.covered) {
            CAPTURE(bodies[b].name, covered);
            CHECK(covered >= (b < compact ? 460 : 450));
            if (b < compact) CHECK(covered <= 495);
            pooled += covered;
        }
    }
    const double percent = 100.0 * pooled / (seeds * static_cast<int>(figures * bodies.size()));
    std::printf("pooled: %.2f %%\n", percent);
    CHECK((percent >= 94 && percent <= 96.5));
}

TEST_CASE("intervals hold the true volumes also where a measure ends by their size", "[.coverage]") {
    const std::vector<test::Body> bodies = test::bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const test::Body& body = bodies[b];
        const Seen all = seen(body, seeds, {.rel_error = b < compact ? 3e-4 : 5e-3});
        print(body, all);
        CAPTURE(body.name);
        CHECK(all.covered[0] >= 450);
        CHECK(all.covered[1] >= 450);
    }
}

TEST_CASE("a million rays tell volumes and areas of compact bodies to 1e-4", "[.coverage]") {
    const std::vector<test::Body> bodies = test::bodies();
    for (std::size_t b = 0; b < compact; ++b) {
        const Seen all = seen(bodies[b], 100, {.rays = 1'000'000});
        print(bodies[b], all);
        CAPTURE(bodies[b].name);
        CHECK(std::sqrt(all.squares[0]) < 1e-4 * bodies[b].volume);
        CHECK(std::sqrt(all.squares[1]) < 1e-4 * bodies[b].area);
    }
}
