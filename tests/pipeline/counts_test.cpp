// Times of kernels that run one after another, and at once.
#include "pipeline/counts.hpp"

#include "catch.hpp"

using namespace csgrt;

TEST_CASE("time in which kernels run at once counts once") {
    constexpr std::uint64_t ms = 1'000'000;  // of nanoseconds
    CHECK(covered_time({}) == 0);
    CHECK(covered_time({{2 * ms, 5 * ms}}) == 3);
    CHECK(covered_time({{2 * ms, 5 * ms}, {7 * ms, 8 * ms}}) == 4);                    // one after another
    CHECK(covered_time({{7 * ms, 8 * ms}, {2 * ms, 5 * ms}}) == 4);                    // whichever is told first
    CHECK(covered_time({{2 * ms, 5 * ms}, {4 * ms, 9 * ms}}) == 7);                    // the second begins in the first
    CHECK(covered_time({{2 * ms, 9 * ms}, {3 * ms, 4 * ms}, {5 * ms, 6 * ms}}) == 7);  // two within the first
    CHECK(covered_time({{2 * ms, 5 * ms}, {5 * ms, 6 * ms}, {0, 0}}) == 4);
}

TEST_CASE("a sum of counts has the sum of the times of the devices") {
    PipelineCounts sum, one, other;
    one.kernels = 2;
    one.first_hits = 3;
    other.kernels = 5;
    sum += one;
    sum += other;
    CHECK(sum.kernels == 7);
    CHECK(sum.first_hits == 3);
}
