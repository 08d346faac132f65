// Solids of BRL-CAD's older text form: every number of each type in its place.
#include <cmath>

#include "formats/brlcad/brlcad_asc_text.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;

namespace {

const std::string head = "I 1 v4\ntitle\n";

/// A record of 24 parameters: 1, 2, 3, ... as far as the solid has any.
std::string counted(int type, int parameters) {
    std::string out = "S " + std::to_string(type) + " s 0";
    for (int i = 1; i <= 24; ++i) out += " " + std::to_string(i <= parameters ? i : 0);
    return head + out + "\n";
}

}  // namespace

TEST_CASE("v4: rpc, rhc, epa, eto, superell, hyp", "[asc]") {
    const Scene rpc_scene = parse(counted(26, 10)), rhc_scene = parse(counted(27, 11)),
                epa_scene = parse(counted(28, 11));
    const Rpc& rpc = shape<Rpc>(rpc_scene, "s");
    CHECK(rpc.v == Vec3{1, 2, 3});
    CHECK(rpc.h == Vec3{4, 5, 6});
    CHECK(rpc.b == Vec3{7, 8, 9});
    CHECK(rpc.r == 10);
    const Rhc& rhc = shape<Rhc>(rhc_scene, "s");
    CHECK(rhc.b == Vec3{7, 8, 9});
    CHECK(rhc.r == 10);
    CHECK(rhc.c == 11);
    const Epa& epa = shape<Epa>(epa_scene, "s");
    CHECK(epa.h == Vec3{4, 5, 6});
    CHECK(std::abs(epa.a.x - 7 / std::sqrt(194)) < 1e-15);
    CHECK(epa.r_1 == 10);
    CHECK(epa.r_2 == 11);

    const Scene eto_scene = parse(counted(30, 11)), superell_scene = parse(counted(32, 14)),
                hyp_scene = parse(counted(33, 11));
    const Eto& eto = shape<Eto>(eto_scene, "s");
    CHECK(eto.n == Vec3{4, 5, 6});
    CHECK(eto.c == Vec3{7, 8, 9});
    CHECK(eto.r == 10);
    CHECK(eto.r_d == 11);
    const Superell& superell = shape<Superell>(superell_scene, "s");
    CHECK(superell.a == Vec3{4, 5, 6});
    CHECK(superell.c == Vec3{10, 11, 12});
    CHECK(superell.n == 13);
    CHECK(superell.e == 14);
    const Hyp& hyp = shape<Hyp>(hyp_scene, "s");
    CHECK(hyp.h == Vec3{4, 5, 6});
    CHECK(hyp.a == Vec3{7, 8, 9});
    CHECK(hyp.b == 10);
    CHECK(hyp.neck == 11);
}

TEST_CASE("v4: part, cline, pipe, bot, ars", "[asc]") {
    const Scene scene = parse(head +
                              "p part 1 2 3 0 0 4 5 6\nc cline 1 2 3 0 0 4 5 1\n"
                              "w pipe\n1 9 8 1 2 3\n2 7 6 4 5 6\nEND_PIPE pipe\n"
                              "t bot 2 3 0 3 1\n\t0: 0 0 0\n\t1: 1 0 0\n\t2: 0 1 2\n\t0: 0 2 1\n"
                              "t plate 3 2 0 3 2\n\t0: 0 0 0\n\t1: 1 0 0\n\t2: 0 1 0\n\t0: 0 1 2 5\n\t1: 2 1 0 6\n"
                              "\t02\n"
                              "t nocos 4 1 0 3 1\n\t0: 0 0 0\n\t1: 1 0 0\n\t2: 0 1 0\n\t0: 0 1 2\n"
                              "A 21 ars 2 3 1 2 0 0 0 0 0 0\n"
                              "B 22 0 1 1 2 3 0 0 1 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                              "B 22 1 1 0 0 5 0 0 6 0 0 7 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
    CHECK(shape<Part>(scene, "part").h == Vec3{0, 0, 4});
    CHECK(shape<Part>(scene, "part").r_v == 5);
    CHECK(shape<Part>(scene, "part").r_h == 6);
    CHECK(shape<Cline>(scene, "cline").radius == 5);
    CHECK(shape<Cline>(scene, "cline").thickness == 1);

    const Pipe& pipe = shape<Pipe>(scene, "pipe");
    REQUIRE(pipe.points.size() == 2);
    CHECK(pipe.points[1].position == Vec3{4, 5, 6});
    CHECK(pipe.points[1].inner == 2);
    CHECK(pipe.points[1].outer == 7);
    CHECK(pipe.points[1].bend == 6);

    const Bot& bot = shape<Bot>(scene, "bot");
    CHECK(bot.mode == Bot::Mode::volume);
    CHECK(bot.orientation == Bot::Orientation::clockwise);
    REQUIRE(bot.vertices.size() == 3);
    CHECK(bot.vertices[2] == Vec3{0, 1, 2});
    CHECK(bot.faces == std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}});
    const Bot& plate = shape<Bot>(scene, "plate");
    CHECK(plate.mode == Bot::Mode::plate);
    CHECK(plate.thickness == std::vector<double>{5, 6});
    CHECK(plate.append == std::vector<std::uint8_t>{0, 1});
    // That program did not write what this mode needs.
    CHECK(unsupported_type(scene, "nocos") == "bot");
    CHECK(shape<Unsupported>(scene, "nocos").reason.find("thickness") != std::string::npos);

    const Ars& ars = shape<Ars>(scene, "ars");
    REQUIRE(ars.curves.size() == 2);
    REQUIRE(ars.curves[0].size() == 3);
    CHECK(ars.curves[0][0] == Vec3{1, 2, 3});
    CHECK(ars.curves[0][1] == Vec3{1, 2, 4});  // relative to the first
    CHECK(ars.curves[1][2] == Vec3{1, 2, 10});
}

TEST_CASE("v4: sketch and extrude", "[asc]") {
    const Scene scene = parse(head +
                              "e solid sk 0 1 2 3 0 0 4 1 0 0 0 1 0\n"
                              "d sk 0 0 0 1 0 0 0 1 0 4 5\n 0 0 2 0 2 2 0 2\n  L 0 0 1\n  A 1 1 2 1.5 1 0\n"
                              "  B 0 2\n   1 2 3\n  N 0 2 10 4 2\n   0 0 1 1\n   2 3\n"
                              "  N 0 2 11 4 2\n   0 0 1 1\n   2 3\n   1 .5\n");
    const Extrude& extrude = shape<Extrude>(scene, "solid");
    CHECK(extrude.v == Vec3{1, 2, 3});
    CHECK(extrude.h == Vec3{0, 0, 4});
    CHECK(extrude.a == Vec3{1, 0, 0});
    CHECK(extrude.b == Vec3{0, 1, 0});
    const Sketch& sketch = extrude.sketch;
    CHECK(sketch.name == "sk");
    REQUIRE(sketch.vertices.size() == 4);
    CHECK(sketch.vertices[3].v == 2);
    REQUIRE(sketch.curves.size() == 5);
    CHECK(std::get<Sketch::Line>(sketch.curves[0]).end == 1);
    const auto& arc = std::get<Sketch::Arc>(sketch.curves[1]);
    CHECK(arc.end == 2);
    CHECK(arc.radius == 1.5);
    CHECK(arc.center_left);
    CHECK_FALSE(arc.clockwise);
    CHECK(std::get<Sketch::Bezier>(sketch.curves[2]).points == std::vector<std::uint32_t>{1, 2, 3});
    CHECK(std::get<Sketch::Nurb>(sketch.curves[3]).knots == std::vector<double>{0, 0, 1, 1});
    CHECK(std::get<Sketch::Nurb>(sketch.curves[4]).weights == std::vector<double>{1, 0.5});
    CHECK(sketch.reversed == std::vector<std::uint8_t>{0, 1, 0, 0, 0});
    CHECK(scene.find("sk") == nullptr);
}
