// Solids of BRL-CAD's newer text form: every number of each type in its place, and what is wrong where.
#include "formats/brlcad/brlcad_asc_text.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;

namespace {

const std::string head = "title {T}\nunits m\n";  // numbers are millimetres, whatever the unit

Scene one(const std::string& solid) { return parse(head + "put {s} " + solid + "\n"); }

const std::string square =
    "put {sq} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {0 0} {2 0} {2 2} {0 2} } SL { { line S 0 E 1 }"
    " { line S 1 E 2 } { line S 2 E 3 } { line S 3 E 0 } }\n";

}  // namespace

TEST_CASE("v5: part, epa, rpc, rhc, eto, hyp", "[asc]") {
    const Scene part_scene = one("part V {1 2 3} H {0 0 4} r_v 5 r_h 6");
    const Part& part = shape<Part>(part_scene, "s");
    CHECK(part.v == Vec3{1, 2, 3});
    CHECK(part.h == Vec3{0, 0, 4});
    CHECK(part.r_v == 5);
    CHECK(part.r_h == 6);

    const Scene epa_scene = one("epa V {1 2 3} H {0 0 4} A {0 2 0} r_1 7 r_2 6");
    const Epa& epa = shape<Epa>(epa_scene, "s");
    CHECK(epa.h == Vec3{0, 0, 4});
    CHECK(epa.a == Vec3{0, 1, 0});
    CHECK(epa.r_1 == 7);
    CHECK(epa.r_2 == 6);

    const Scene rpc_scene = one("rpc V {1 2 3} H {0 0 4} B {5 0 0} r 6");
    const Rpc& rpc = shape<Rpc>(rpc_scene, "s");
    CHECK(rpc.v == Vec3{1, 2, 3});
    CHECK(rpc.h == Vec3{0, 0, 4});
    CHECK(rpc.b == Vec3{5, 0, 0});
    CHECK(rpc.r == 6);

    const Scene rhc_scene = one("rhc V {1 2 3} H {0 0 4} B {5 0 0} r 6 c 7");
    const Rhc& rhc = shape<Rhc>(rhc_scene, "s");
    CHECK(rhc.b == Vec3{5, 0, 0});
    CHECK(rhc.r == 6);
    CHECK(rhc.c == 7);

    const Scene eto_scene = one("eto V {1 2 3} N {0 0 2} C {3 0 1} r 9 r_d 2");
    const Eto& eto = shape<Eto>(eto_scene, "s");
    CHECK(eto.n == Vec3{0, 0, 2});
    CHECK(eto.c == Vec3{3, 0, 1});
    CHECK(eto.r == 9);
    CHECK(eto.r_d == 2);

    const Scene hyp_scene = one("hyp V {1 2 3} H {0 0 4} A {5 0 0} b 6 bnr .25");
    const Hyp& hyp = shape<Hyp>(hyp_scene, "s");
    CHECK(hyp.h == Vec3{0, 0, 4});
    CHECK(hyp.a == Vec3{5, 0, 0});
    CHECK(hyp.b == 6);
    CHECK(hyp.neck == 0.25);
}

TEST_CASE("v5: superell, hrt, cline, metaball, pipe", "[asc]") {
    const Scene superell_scene = one("superell V {1 2 3} A {4 0 0} B {0 5 0} C {0 0 6} n .5 e 2");
    const Superell& superell = shape<Superell>(superell_scene, "s");
    CHECK(superell.b == Vec3{0, 5, 0});
    CHECK(superell.n == 0.5);
    CHECK(superell.e == 2);

    const Scene hrt_scene = one("hrt V {1 2 3} X {4 0 0} Y {0 5 0} Z {0 0 6} d 7");
    const Hrt& hrt = shape<Hrt>(hrt_scene, "s");
    CHECK(hrt.x == Vec3{4, 0, 0});
    CHECK(hrt.y == Vec3{0, 5, 0});
    CHECK(hrt.z == Vec3{0, 0, 6});
    CHECK(hrt.d == 7);

    const Scene cline_scene = one("cline V {1 2 3} H {0 0 4} R 5 T 1");
    const Cline& cline = shape<Cline>(cline_scene, "s");
    CHECK(cline.h == Vec3{0, 0, 4});
    CHECK(cline.radius == 5);
    CHECK(cline.thickness == 1);

    const Scene ball_scene = one("metaball method 2 thresh 1.5 PL { {1 2 3 4 5} {6 7 8 9 10} }");
    const Metaball& ball = shape<Metaball>(ball_scene, "s");
    CHECK(ball.method == Metaball::Method::blob);
    CHECK(ball.threshold == 1.5);
    REQUIRE(ball.points.size() == 2);
    CHECK(ball.points[1].position == Vec3{6, 7, 8});
    CHECK(ball.points[1].strength == 9);
    CHECK(ball.points[1].softness == 10);
    CHECK(shape<Metaball>(one("metaball method 0 thresh 1 PL {}"), "s").method == Metaball::Method::metaball);
    CHECK(shape<Metaball>(one("metaball method 1 thresh 1 PL {}"), "s").method == Metaball::Method::isopotential);

    const Scene pipe_scene = one("pipe V0 { 1 2 3 } O0 9 I0 -0 R0 8 V1 {4 5 6} O1 7 I1 3 R1 2");
    const Pipe& pipe = shape<Pipe>(pipe_scene, "s");
    REQUIRE(pipe.points.size() == 2);
    CHECK(pipe.points[0].inner == 0);
    CHECK(pipe.points[1].position == Vec3{4, 5, 6});
    CHECK(pipe.points[1].outer == 7);
    CHECK(pipe.points[1].inner == 3);
    CHECK(pipe.points[1].bend == 2);
}

TEST_CASE("v5: bot, ars, nmg", "[asc]") {
    const std::string vertices = " V { {0 0 0} {1 0 0} {0 1 0} {0 0 1} }";
    const Scene plain_scene = one("bot mode volume orient lh flags {use_floats}" + vertices + " F { {0 1 2} {3 2 1} }");
    const Bot& plain = shape<Bot>(plain_scene, "s");
    CHECK(plain.mode == Bot::Mode::volume);
    CHECK(plain.orientation == Bot::Orientation::clockwise);
    REQUIRE(plain.vertices.size() == 4);
    CHECK(plain.vertices[3] == Vec3{0, 0, 1});
    REQUIRE(plain.faces.size() == 2);
    CHECK(plain.faces[1] == std::array<std::uint32_t, 3>{3, 2, 1});
    CHECK(plain.thickness.empty());
    CHECK(plain.append.empty());
    CHECK(plain.normals.empty());

    // One bit a face, that of face 0 last.
    const Scene plate_scene = one("bot mode plate orient rh flags {}" + vertices +
                                  " F { {0 1 2} {3 2 1} {0 1 3} } T { 1 2 3 } fm 0000000000000005");
    const Bot& plate = shape<Bot>(plate_scene, "s");
    CHECK(plate.mode == Bot::Mode::plate);
    CHECK(plate.orientation == Bot::Orientation::counterclockwise);
    CHECK(plate.thickness == std::vector<double>{1, 2, 3});
    CHECK(plate.append == std::vector<std::uint8_t>{1, 0, 1});
    CHECK(shape<Bot>(one("bot mode plate_nocos orient no" + vertices + " F { {0 1 2} } T 4"), "s").append ==
          std::vector<std::uint8_t>{0});

    const Scene normals_scene = one("bot mode surf orient no flags {has_normals}" + vertices +
                                    " F { {0 1 2} } N { {0 0 1} {0 1 0} } fn { {1 0 1} }");
    const Bot& normals = shape<Bot>(normals_scene, "s");
    CHECK(normals.mode == Bot::Mode::surface);
    CHECK(normals.orientation == Bot::Orientation::unoriented);
    CHECK(normals.normals[1] == Vec3{0, 1, 0});
    CHECK(normals.face_normals[0] == std::array<std::uint32_t, 3>{1, 0, 1});

    const Scene ars_scene = one("ars NC 2 PPC 3 C0 { { 1 2 3 } { 4 5 6 } { 7 8 9 } } C1 { {0 0 1} {0 0 2} {0 0 3} }");
    const Ars& ars = shape<Ars>(ars_scene, "s");
    REQUIRE(ars.curves.size() == 2);
    CHECK(ars.curves[0][1] == Vec3{4, 5, 6});
    CHECK(ars.curves[1][2] == Vec3{0, 0, 3});

    const Scene nmg_scene = one("nmg" + vertices + " F {{0 2 1}} F {{0 1 3} {1 2 3}}");
    const Nmg& nmg = shape<Nmg>(nmg_scene, "s");
    CHECK(nmg.vertices.size() == 4);
    REQUIRE(nmg.faces.size() == 2);
    CHECK(nmg.faces[0] == std::vector<Nmg::Loop>{{0, 2, 1}});
    CHECK(nmg.faces[1] == std::vector<Nmg::Loop>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("v5: a sketch becomes part of the solids that name it, wherever it stands", "[asc]") {
    const Scene scene = parse(head + "put {e} extrude V {1 2 3} H {0 0 4} A {1 0 0} B {0 1 0} S sq\n" + square +
                              "put {r} revolve V {1 2 3} axis {0 0 1} R {1 0 0} ang 1.5 sk_name sq\n"
                              "put {k} extrude V {1 2 3} H {0 0 4} A {1 0 0} B {0 1 0} S sq K 0\n"
                              "attr set {sq} {note} {x}\n");
    CHECK(scene.objects.size() == 3);  // the sketch has no inside
    const Extrude& extrude = shape<Extrude>(scene, "e");
    CHECK(extrude.h == Vec3{0, 0, 4});
    CHECK(extrude.b == Vec3{0, 1, 0});
    CHECK(extrude.sketch.name == "sq");
    REQUIRE(extrude.sketch.vertices.size() == 4);
    CHECK(extrude.sketch.vertices[2].v == 2);
    REQUIRE(extrude.sketch.curves.size() == 4);
    CHECK(std::get<Sketch::Line>(extrude.sketch.curves[3]).start == 3);
    CHECK(extrude.sketch.reversed == std::vector<std::uint8_t>{0, 0, 0, 0});
    const Revolve& revolve = shape<Revolve>(scene, "r");
    CHECK(revolve.axis == Vec3{0, 0, 1});
    CHECK(revolve.r == Vec3{1, 0, 0});
    CHECK(revolve.angle == 1.5);
    CHECK(revolve.sketch.curves.size() == 4);
    CHECK(shape<Extrude>(scene, "k").sketch.curves.size() == 4);
}

TEST_CASE("v5: curves of a sketch", "[asc]") {
    const Scene scene =
        parse(head +
              "put {sk} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {0 0} {2 0} {2 2} {0 2} } SL { { carc S 1 E 2 R 1.5 "
              "L 1 O 0 }"
              " { carc S 2 E 1 R -1 L 0 O 1 } { bezier D 2 P {0 1 2} } { nurb O 3 T 10 K {0 0 0 1 2 2 2} P {0 1 2 3} }"
              " { nurb O 2 T 11 K {0 0 1 1} P {0 1} W {1 .5} } }\n"
              "put {e} extrude V {0 0 0} H {0 0 4} A {1 0 0} B {0 1 0} S sk\n");
    const Sketch& sketch = shape<Extrude>(scene, "e").sketch;
    REQUIRE(sketch.curves.size() == 5);
    const auto& arc = std::get<Sketch::Arc>(sketch.curves[0]);
    CHECK(arc.start == 1);
    CHECK(arc.end == 2);
    CHECK(arc.radius == 1.5);
    CHECK(arc.center_left);
    CHECK_FALSE(arc.clockwise);
    const auto& circle = std::get<Sketch::Arc>(sketch.curves[1]);
    CHECK(circle.radius == -1);
    CHECK_FALSE(circle.center_left);
    CHECK(circle.clockwise);
    CHECK(std::get<Sketch::Bezier>(sketch.curves[2]).points == std::vector<std::uint32_t>{0, 1, 2});
    const auto& nurb = std::get<Sketch::Nurb>(sketch.curves[3]);
    CHECK(nurb.order == 3);
    CHECK(nurb.knots == std::vector<double>{0, 0, 0, 1, 2, 2, 2});
    CHECK(nurb.points == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(nurb.weights.empty());
    CHECK(std::get<Sketch::Nurb>(sketch.curves[4]).weights == std::vector<double>{1, 0.5});
}

TEST_CASE("v5: objects without an inside are the empty set where they are used, and else left out", "[asc]") {
    const Scene scene = parse(head + square +
                              "put {g} grip V {0 0 0} N {0 0 1} L 60\nput {free} grip V {0 0 0}\n"
                              "put {ball} ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
                              "put {c} comb region no tree {u {l g} {u {l sq} {l ball}}}\n"
                              "attr set {free} {note} {x}\n");
    CHECK(scene.objects.size() == 4);
    CHECK(scene.find("free") == nullptr);
    CHECK(comb(scene, "g").tree.nodes.empty());
    CHECK(comb(scene, "sq").tree.nodes.empty());
    CHECK(validate(scene).empty());
}

TEST_CASE("v5: what is wrong with a solid is named with its place", "[asc][broken]") {
    const std::string vertices = "V { {0 0 0} {1 0 0} {0 1 0} }";
    const std::string sketch = head + "put {k} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {0 0} {2 0} } SL { { ";
    const Broken cases[] = {
        {"mode", head + "put {b} bot mode solidish orient no\n", 3, 18, "b", "'solidish' is no mode"},
        {"orientation", head + "put {b} bot mode surf orient up\n", 3, 30, "b", "'up' is no orientation"},
        {"corner", head + "put {b} bot mode surf orient no " + vertices + " F { {0 1 3} }\n", 3, 72, "b",
         "there is no number 3"},
        {"negative corner", head + "put {b} bot mode surf orient no " + vertices + " F { {0 1 -1} }\n", 3, 72, "b",
         "'-1' is outside 0"},
        {"four corners", head + "put {b} bot mode surf orient no " + vertices + " F { {0 1 2 0} }\n", 3, 68, "b",
         "4 corners"},
        {"plate without thickness", head + "put {b} bot mode plate orient no " + vertices + " F { {0 1 2} }\n", 3, 9,
         "b", "the bot has no T"},
        {"thicknesses", head + "put {b} bot mode plate orient no " + vertices + " F { {0 1 2} } T {1 2}\n", 3, 81, "b",
         "2 thicknesses for 1 faces"},
        {"bits", head + "put {b} bot mode plate orient no " + vertices + " F { {0 1 2} } T 1 fm 0g\n", 3, 86, "b",
         "'g' is no hexadecimal digit"},
        {"two numbers of a vertex", head + "put {b} bot mode surf orient no V { {0 0} }\n", 3, 41, "b", "V has 2 of 3"},
        {"curve of an ars", head + "put {a} ars NC 2 PPC 2 C0 { {0 0 0} {0 0 1} } C1 { {0 0 0} }\n", 3, 51, "a",
         "C1 has 1 points, not 2"},
        {"missing curve", head + "put {a} ars NC 2 PPC 1 C0 { {0 0 0} }\n", 3, 9, "a", "the ars has no C1"},
        {"billions of curves", head + "put {a} ars NC 2000000000 PPC 1 C0 {{0 0 0}}\n", 3, 9, "a", "the ars has no C1"},
        {"vertex of an nmg", head + "put {n} nmg " + vertices + " F {{0 1 2}} F {{0 1 7}}\n", 3, 63, "n",
         "there is no number 7"},
        {"pipe without points", head + "put {p} pipe\n", 3, 9, "p", "the pipe has no V0"},
        {"pipe's gap", head + "put {p} pipe V0 {0 0 0} O0 1 I0 0 R0 1 V2 {0 0 1}\n", 3, 40, "p",
         "'V2' is no parameter"},
        {"method", head + "put {m} metaball method 3 thresh 1 PL {}\n", 3, 25, "m", "outside 0 to 2"},
        {"point of a metaball", head + "put {m} metaball method 1 thresh 1 PL { {1 2 3 4} }\n", 3, 49, "m", "4 of 5"},
        {"curve", sketch + "spiral S 0 E 1 } }\n", 3, 72, "k", "'spiral' is no curve"},
        {"empty curve", sketch + " } }\n", 3, 71, "k", "the curve is empty"},
        {"vertex of a line", sketch + "line S 0 E 2 } }\n", 3, 83, "k", "there is no number 2"},
        {"two vertices", sketch + "line S {0 1} E 1 } }\n", 3, 80, "k", "S is not one vertex"},
        {"degree", sketch + "bezier D 3 P {0 1} } }\n", 3, 81, "k", "one point more than that, not 2"},
        {"knots", sketch + "nurb O 2 K {0 1} P {0 1} } }\n", 3, 84, "k", "need 4 knots, not 2"},
        {"weights", sketch + "nurb O 2 K {0 0 1 1} P {0 1} W 1 } }\n", 3, 103, "k", "1 weights for 2 points"},
        {"flag of an arc", sketch + "carc S 0 E 1 R 1 L 2 O 0 } }\n", 3, 91, "k", "outside 0 to 1"},
        {"source", head + "put {d} dsp file a src x w 1 n 1 sm 0 stom {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}\n", 3, 24, "d",
         "'x' is no kind of source"},
        {"cut", head + "put {d} dsp file a src f w 1 n 1 sm 0 cut x stom {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}\n", 3, 43,
         "d", "'x' is no cut"},
        {"no cells", head + "put {d} dsp file a src f w 0 n 1\n", 3, 28, "d", "outside 1 to"},
        {"no file", head + "put {d} dsp file {} src f w 1 n 1\n", 3, 19, "d", "file is empty"},
        {"value of a cell", head + "put {v} vol file a src f w 1 n 1 d 1 lo 0 hi 256\n", 3, 46, "v",
         "outside 0 to 255"},
        {"odd digit", head + "put {n} binunif T 4 D {00 0}\n", 3, 27, "n", "odd"},
    };
    for (const Broken& broken : cases) check_broken(broken);
}
