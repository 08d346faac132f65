// What is said about solids of triangles that are not sound.
#include <limits>

#include "catch.hpp"
#include "scene/solid_faults.hpp"

using namespace csgrt;

namespace {

std::string fault(const Shape& shape) {
    const std::vector<std::string> all = solid_faults(shape);
    return all.empty() ? "" : all.front();
}
Bot tetrahedron() {
    Bot bot;
    bot.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    bot.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    return bot;
}
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("faults of bots", "[scene]") {
    Bot bot = tetrahedron();
    CHECK(fault(bot).empty());
    bot.faces[2][1] = 4;
    CHECK(fault(bot) == "face 2 uses vertex 4; there are only vertices 0 to 3");
    bot.faces.clear();
    CHECK_THAT(fault(bot), ContainsSubstring("no faces"));
    bot = tetrahedron();
    bot.vertices[3].y = not_a_number;
    CHECK(fault(bot) == "vertex 3 has a number that is not finite");
    bot.vertices[3].y = 1e200;
    CHECK_THAT(fault(bot), ContainsSubstring("vertex 3 lies too far away"));
}

TEST_CASE("faults of ars", "[scene]") {
    const std::vector<Vec3> point(4, Vec3{0, 0, 5}), square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    Ars ars{{point, square, point}};
    CHECK(fault(ars).empty());
    ars.curves[1].pop_back();
    CHECK(fault(ars) == "curve 1 has 3 points, not 4 as the first one");
    ars.curves[1] = {{0, 0, 0}, {1, 0, 0}, {1, not_a_number, 0}, {0, 1, 0}};
    CHECK_THAT(fault(ars), ContainsSubstring("curve 1 has a number"));
    CHECK_THAT(fault(Ars{{square}}), ContainsSubstring("less than two curves"));
    CHECK_THAT(fault(Ars{}), ContainsSubstring("less than two curves"));
    CHECK_THAT(fault(Ars{{{}, {}}}), ContainsSubstring("less than three points"));
}

TEST_CASE("faults of nmg", "[scene]") {
    Nmg nmg{tetrahedron().vertices, {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 2, 3}}, {{1, 2, 3}}}};
    CHECK(fault(nmg).empty());
    nmg.faces[1][0][0] = 9;
    CHECK_THAT(fault(nmg), ContainsSubstring("face 1 uses vertex 9"));
    nmg.faces[1] = {{0, 1}};
    CHECK_THAT(fault(nmg), ContainsSubstring("face 1 has a loop of less than three vertices"));
    nmg.faces[1] = {};
    CHECK(fault(nmg) == "face 1 has no loop");
    CHECK_THAT(fault(Nmg{}), ContainsSubstring("no faces"));
}

TEST_CASE("faults of vol and dsp", "[scene]") {
    Vol vol;
    vol.width = vol.depth = 2, vol.height = 3;
    vol.cells.resize(12);
    CHECK(fault(vol).empty());
    vol.height = 4;
    CHECK(fault(vol) == "it has 12 cells, not 2 x 2 x 4");
    vol.width = vol.depth = vol.height = 0xffffffff;
    CHECK_THAT(fault(vol), ContainsSubstring("it has 12 cells"));
    vol.height = 0;
    CHECK_THAT(fault(vol), ContainsSubstring("no cells"));
    vol.width = vol.depth = 2, vol.height = 3;
    vol.cell.y = 0;
    CHECK_THAT(fault(vol), ContainsSubstring("sides of a cell"));
    vol.cell.y = 1;
    vol.matrix[5] = 0;
    CHECK_THAT(fault(vol), ContainsSubstring("singular"));
    vol.matrix[5] = not_a_number;
    CHECK_THAT(fault(vol), ContainsSubstring("not finite"));

    Dsp dsp;
    dsp.width = 3, dsp.depth = 2;
    dsp.heights.resize(6);
    CHECK(fault(dsp).empty());
    dsp.heights.pop_back();
    CHECK(fault(dsp) == "it has 5 heights, not 3 x 2");
    dsp.width = 1;
    CHECK_THAT(fault(dsp), ContainsSubstring("no cells"));
}
