#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

// The oracle samples closely, which takes its time.
TEST_CASE("geometry: metaball agrees with the oracle", "[geometry]") {
    check_kernels(oracle::Kind::metaball, short_run / 40, 1);
}
TEST_CASE("geometry: metaball agrees with the oracle on 20,000 rays", "[.long]") {
    check_kernels(oracle::Kind::metaball, 20'000, 2);
}
