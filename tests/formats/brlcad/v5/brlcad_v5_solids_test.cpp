// Solids of BRL-CAD's newer text form: sketches that others name, and what is wrong where.
#include "formats/brlcad/brlcad_asc_text.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;

namespace {

const std::string head = "title {T}\nunits m\n";  // numbers are millimetres, whatever the unit

const std::string square =
    "put {sq} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {0 0} {2 0} {2 2} {0 2} } SL { { line S 0 E 1 }"
    " { line S 1 E 2 } { line S 2 E 3 } { line S 3 E 0 } }\n";

}  // namespace

TEST_CASE("v5: a sketch becomes part of the solids that name it, wherever it stands", "[asc]") {
    const Scene scene = parse(head + "put {e} extrude V {1 2 3} H {0 0 4} A {1 0 0} B {0 1 0} S sq\n" + square +
                              "put {r} revolve V {1 2 3} axis {0 0 1} R {1 0 0} ang 1.5 sk_name sq\n"
                              "put {k} extrude V {1 2 3} H {0 0 4} A {1 0 0} B {0 1 0} S sq K 0\n"
                              "attr set {sq} {note} {x}\nput {surface} brep data {0 0 1}\n");
    CHECK(scene.objects.size() == 4);  // the sketch has no inside
    CHECK(shape<Extrude>(scene, "e").sketch.vertices.size() == 4);
    CHECK(shape<Extrude>(scene, "e").sketch.curves.size() == 4);
    CHECK(shape<Revolve>(scene, "r").sketch.curves.size() == 4);
    CHECK(shape<Extrude>(scene, "k").sketch.curves.size() == 4);
    CHECK(unsupported_type(scene, "surface") == "brep");
    CHECK(place_of(*scene.find("r")).line == 5);
    CHECK(place_of(*scene.find("r")).column == 1);
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
