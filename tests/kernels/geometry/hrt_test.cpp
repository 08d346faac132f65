#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

// The oracle samples closely, which takes its time.
TEST_CASE("geometry: hrt agrees with the oracle", "[geometry]") { check_kernels(oracle::Kind::hrt, short_run / 4, 1); }
TEST_CASE("geometry: hrt agrees with the oracle on 250,000 rays", "[.long]") {
    check_kernels(oracle::Kind::hrt, 250'000, 2);
}
