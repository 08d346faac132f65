#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

TEST_CASE("geometry: epa agrees with the oracle", "[geometry]") { check_kernels(oracle::Kind::epa, short_run, 1); }
TEST_CASE("geometry: epa agrees with the oracle on a million rays", "[.long]") {
    check_kernels(oracle::Kind::epa, long_run, 2);
}
