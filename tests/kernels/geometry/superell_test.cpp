#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

// The oracle's powers take their time.
TEST_CASE("geometry: superell agrees with the oracle", "[geometry]") {
    check_kernels(oracle::Kind::superell, short_run / 10, 1);
}
TEST_CASE("geometry: superell agrees with the oracle on 50,000 rays", "[.long]") {
    check_kernels(oracle::Kind::superell, 50'000, 2);
}
