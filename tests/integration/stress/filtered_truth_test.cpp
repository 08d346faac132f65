// Expected answers of the stress suite through the floating-point filter and in 113 bits throughout: the same, ties
// included.
#include "catch.hpp"

#include <cstdlib>

#include "integration/stress/expected.hpp"
#include "stress/families.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

std::string contradiction(const Expected& filtered, const Expected& full) {
    if (filtered.tie != full.tie) return full.tie ? "no tie, but one it is" : "a tie, but none it is";
    if (filtered.tie) return {};
    if (!same_regions(filtered.sequence, full.sequence)) return "other regions";
    if (filtered.overlaps != full.overlaps) return "other overlaps";
    for (std::size_t i = 0; i < full.sequence.size(); ++i) {
        const Item &a = filtered.sequence[i], &b = full.sequence[i];
        const auto same = [](double x, double y, double part) {
            return x == y || std::abs(x - y) <= part * std::abs(y);
        };
        if (!same(a.in, b.in, 1e-14) || !same(a.out, b.out, 1e-14)) return "other ends";
        if (!same(a.in_tolerance, b.in_tolerance, 1e-4) || !same(a.out_tolerance, b.out_tolerance, 1e-4))
            return "other tolerances";
    }
    return {};
}

}  // namespace

TEST_CASE("stress: the filter gives the expected answers that 113 bits give", "[stress]") {
    std::uint64_t seeds = 3;
    if (const char* more = std::getenv("CSGRT_SEEDS")) seeds = std::strtoull(more, nullptr, 10);
    for (const std::string& family : stress::families()) {
        std::size_t rays = 0, wrong = 0;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            const stress::StressScene made = stress::make(family, 7 * seed + 1);
            if (!made.known.empty()) continue;
            const ExpectedAnswers filtered(made, true), full(made);
            for (std::size_t i = 0; i < made.rays.size(); ++i, ++rays) {
                const std::string what = contradiction(filtered(i), full(i));
                if (!what.empty() && ++wrong < 4)
                    FAIL_CHECK(family << ' ' << made.seed << ", ray " << i << ": " << what);
            }
        }
        INFO(family << ", " << rays << " rays");
        CHECK(wrong == 0);
    }
}
