#include "kernels/geometry/check_kernels.hpp"

using namespace csgrt;

// Three surfaces, whose seams the oracle looks at closely.
TEST_CASE("geometry: part agrees with the oracle", "[geometry]") {
    check_kernels(oracle::Kind::part, short_run / 3, 1);
}
TEST_CASE("geometry: part agrees with the oracle on a million rays", "[.long]") {
    check_kernels(oracle::Kind::part, long_run, 2, 4);
}
