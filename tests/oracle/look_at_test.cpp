// Where sampling misses two roots that are close together, the oracle finds them if it is told where to look.
#include "catch.hpp"

#include "oracle/intersect.hpp"
#include "oracle/solids/all.hpp"

using namespace csgrt;

TEST_CASE("the oracle finds two roots that are close together where it looks") {
    Metaball shape{.method = Metaball::Method::isopotential, .threshold = 1};
    shape.points = {{{-2.47340043068427e-4, -8.9076974689717987e-4, 3.3846548940938078e-4}, 4.6876705360610944e-4, 1},
                    {{-3.5763384235789741e-4, -9.241445500424646e-4, -4.199809624825073e-4}, 4.9814925172463433e-4, 1},
                    {{4.2879559920121197e-4, -1.5407897316459182e-3, 6.720189204847001e-4}, 4.959111746363383e-4, 1}};
    const Matrix placed = {1.2438950930827648,
                           -0.070003709468424713,
                           -0.58603686601875049,
                           -5.1430918636487808e-4,
                           4.4345071373649629,
                           -1.3624401644265252,
                           -1.9703406108506365,
                           -2.6495939630996738e-3,
                           4.73460353778112,
                           -1.3146442436177854,
                           -2.534493790402323,
                           1.6921719386379429e-3,
                           0,
                           0,
                           0,
                           1};
    const Ray ray{{0.0043267408743148002, -0.031008306830029583, 0.040911201332370757},
                  {-0.099890537093843254, 0.62400045843491503, -0.77501310212932484}};
    const oracle::ImplicitSolid solid = oracle::implicit(shape, oracle::to_affine(placed));
    // By bisection of the field in 40 digits: inside from 0.04825225 to 0.04825447, and from 0.04836539 to 0.04873896.
    CHECK(oracle::intersect(solid, ray).intervals.size() == 1);  // else the second look is of no use
    const oracle::Answer answer = oracle::intersect(solid, ray, {0.0482534, 0.0486});
    REQUIRE(answer.intervals.size() == 2);
    CHECK_FALSE(answer.tie);
    CHECK(answer.intervals[0].in.t == Approx(0.04825225).margin(1e-8));
    CHECK(answer.intervals[0].out.t == Approx(0.04825447).margin(1e-8));
    CHECK(answer.intervals[1].in.t == Approx(0.04836539).margin(1e-8));
    CHECK(answer.intervals[1].out.t == Approx(0.04873896).margin(1e-8));
}
