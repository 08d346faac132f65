#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

TEST_CASE("geometry: ehy agrees with the oracle", "[geometry]") { check_kernels(oracle::Kind::ehy, short_run, 1); }
TEST_CASE("geometry: ehy agrees with the oracle on a million rays", "[.long]") {
    check_kernels(oracle::Kind::ehy, long_run, 2);
}
