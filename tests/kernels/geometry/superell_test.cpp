#include "catch.hpp"
#include "kernels/geometry/kernel_answer.hpp"

using namespace csgrt;

// It leaves at a pole, where x and y are 0 within a bit of each other, and both have powers below 1.
TEST_CASE("geometry: a ray through the middle and a pole of a superell meets it once") {
    Superell shape;
    shape.v = {-2978693.1965129366, -2552204.4695378756, -1518615.7115687579};
    shape.a = {485590.0137081127, -726629.40331158985, 724667.37011342787};
    shape.b = {-896862.09257835045, 255145.41846424007, 856811.6416067942};
    shape.c = {-686710.44065866643, -906553.15834567056, -448852.06874306145};
    shape.n = 0.96827397394424897, shape.e = 2.3760731910659092;
    const Matrix placed = {0.25949439022169196,
                           0.72173175920045651,
                           -0.64168990112427859,
                           1649404.6451275621,
                           -0.83532475342710089,
                           -0.16571616548610429,
                           -0.52418575792226108,
                           -1504585.6101677204,
                           -0.48465989905853096,
                           0.67204272204823134,
                           0.55987798848193548,
                           -2979602.7745020548,
                           0,
                           0,
                           0,
                           1};
    const auto segments =
        kernel_answer(shape, placed)({{-2435228.8713591858, 3161707.4203125029, -4629103.4120936356}, {-1, 0, 0}});
    REQUIRE(segments.size() == 1);
    // By bisection of the formula in 40 digits; no closer than the rounding of numbers of some 10^6.
    CHECK(segments.front().in == Approx(-2403793.3181273337).margin(1e-5));
    CHECK(segments.front().out == Approx(-1899690.8127356372).margin(1e-4));
}
