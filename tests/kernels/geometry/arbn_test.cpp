#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

TEST_CASE("geometry: arbn agrees with the oracle", "[geometry]") { check_kernels(oracle::Kind::arbn, short_run, 1); }
TEST_CASE("geometry: arbn agrees with the oracle on a million rays", "[.long]") {
    check_kernels(oracle::Kind::arbn, long_run, 2);
}
