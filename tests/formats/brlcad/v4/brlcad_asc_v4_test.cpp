// BRL-CAD's older text form: each record, the members' precedence, matrices, and what is wrong where.
#include "formats/brlcad/brlcad_asc_text.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;

namespace {

const std::string head = "I 1 v4\ntitle\n";
const std::string unit_matrix = " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\n";
const std::string zeros = " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";

/// A solid record whose parameters are those given, filled up with zeros to 24.
std::string solid(int type, const std::string& name, const std::vector<double>& parameters) {
    std::string out = "S " + std::to_string(type) + " " + name + " 0";
    for (std::size_t i = 0; i < 24; ++i) out += " " + std::to_string(i < parameters.size() ? parameters[i] : 0.0);
    return out + "\n";
}

std::string combination(const std::string& name, const std::vector<std::string>& members) {
    std::string out = "C N " + name + " 0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    for (const std::string& member : members) out += "M " + member + unit_matrix;
    return out;
}

std::string tree_of(const std::vector<std::string>& members) {
    return written(comb(parse(head + combination("c", members)), "c").tree);
}

}  // namespace

TEST_CASE("v4: ident and colour table", "[asc]") {
    const Scene scene = parse("# a comment\n\nI 4 v4\nA model, \"quoted\"\nm 0 10 19 255 0 51\nm 0 -1 -1 0 0 0\n");
    CHECK(scene.title == "A model, \"quoted\"");
    CHECK(scene.units == "in");
    CHECK(scene.unit_length == 25.4);
    REQUIRE(scene.region_colors.size() == 2);
    CHECK(scene.region_colors[0].low == 10);
    CHECK(scene.region_colors[0].high == 19);
    CHECK(scene.region_colors[0].color == Vec3{1, 0, 0.2});
    CHECK(scene.region_colors[1].low == -1);

    const char* names[] = {"mm", "mm", "cm", "m", "in", "ft", "um", "km", "yd", "mi"};
    const double lengths[] = {1, 1, 10, 1000, 25.4, 304.8, 1e-3, 1e6, 914.4, 1609344};
    for (int code = 0; code < 10; ++code) {
        const Scene with_unit = parse("I " + std::to_string(code) + " v4\n\n");
        CHECK(with_unit.units == names[code]);
        CHECK(with_unit.unit_length == lengths[code]);
    }
}

TEST_CASE("v4: lengths are millimetres whatever the unit", "[asc]") {
    const Scene scene = parse("I 3 v4\nin metres\n" + solid(19, "e", {1, 2, 3, 4, 0, 0, 0, 5, 0, 0, 0, 6}));
    CHECK(shape<Ell>(scene, "e").v == Vec3{1, 2, 3});
    CHECK(shape<Ell>(scene, "e").c == Vec3{0, 0, 6});
    CHECK(place_of(*scene.find("e")).line == 3);
    CHECK(place_of(*scene.find("e")).pointer == "e");
}

TEST_CASE("v4: a tube as thick as its circle survives rounding, a thicker one is left to validation", "[asc]") {
    const Scene scene = parse(head + "S 16 touching 0 0 0 0 0 0 2.0000001 2 0 0" + zeros.substr(0, 30) + "\n" +
                              solid(16, "crossing", {0, 0, 0, 0, 0, 3, 2, 0, 0}));
    CHECK(shape<Tor>(scene, "touching").r_h == shape<Tor>(scene, "touching").r_a);
    CHECK(shape<Tor>(scene, "crossing").r_h == 3);
}

TEST_CASE("v4: other solids are known by name, and their data is passed over", "[asc]") {
    std::string text = head;
    text += "s hf field file=\"a.bin\" w=256\n";
    text += "P poly\nQ 3 0 0 0\nQ 3 0 0 0\n";
    text += "b spline 1\nD 2 2 2 1 1 1 3 1 1\n0.0e+00\n1.0e+00\n1.0e+00\n-1.0e+00\n+1\n1\n";
    text += "n slab 2\nn 0 0 1 5\nn 0 0 -4 20\n" + solid(31, "grip", {});
    text += solid(19, "last", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    const Scene scene = parse(text);
    CHECK(unsupported_type(scene, "poly") == "poly");
    CHECK(unsupported_type(scene, "field") == "hf");
    CHECK(unsupported_type(scene, "spline") == "bspline");
    CHECK(shape<Ell>(scene, "last").a == Vec3{1, 0, 0});
    CHECK(shape<Arbn>(scene, "slab").planes.size() == 2);
    CHECK(scene.objects.size() == 5);  // a grip has no inside
}

TEST_CASE("v4: a combination's attributes", "[asc]") {
    const Scene scene = parse(head +
                              "C Y lit 1001 3 2 0 7 50 1 255 0 51 1 1 1\nglass\ntr=0.85\n"
                              "M u a 1 0 0 10 0 1 0 20 0 0 1 30 0 0 0 1 0\n"
                              "C N plain -1 0 9 -8792 0 0 0 9 138 48 0 0 0\n"
                              "C P plate 5 0 0 0 1 100 0 0 0 0\n"
                              "C V volume 6 0 0 0 1 100 0 0 0 0 1\nplastic  \n"
                              "C Y empty 7 0 0 0 1 100 0 0 0 0 1 1 0\nplastic\n\nM u a" +
                              unit_matrix);
    const Combination& lit = comb(scene, "lit");
    CHECK(same_attributes(lit, glass_region));
    REQUIRE(lit.tree.nodes.size() == 1);
    CHECK(lit.tree.nodes[0].matrix == Matrix{1, 0, 0, 10, 0, 1, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1});
    CHECK(lit.tree.nodes[0].place.line == 6);
    CHECK(lit.tree.nodes[0].place.pointer == "lit");

    const Combination& plain = comb(scene, "plain");
    CHECK(same_attributes(plain, {.region_id = -1, .material_id = 0, .los = 0}));
    CHECK(plain.tree.nodes.empty());

    CHECK(comb(scene, "plate").region);
    CHECK(comb(scene, "volume").region);
    CHECK(comb(scene, "volume").finish->shader == "plastic");
    CHECK(comb(scene, "empty").tree.nodes.size() == 1);  // an empty line of parameters is a line
}

TEST_CASE("v4: members combine from left to right, unions last", "[asc]") {
    CHECK(tree_of({}) == "");
    CHECK(tree_of({"u a"}) == "a");
    CHECK(tree_of({"u a", "u b", "u c"}) == "u(a b c)");
    CHECK(tree_of({"u a", "- b", "u c", "+ d"}) == "u(-(a b) +(c d))");
    CHECK(tree_of({"u a", "- b", "- c"}) == "-(a b c)");
    CHECK(tree_of({"u a", "- b", "+ c"}) == "+(-(a b) c)");
    CHECK(tree_of({"u a", "+ b", "- c", "^ d", "u e"}) == "u(^(-(+(a b) c) d) e)");
    // The first operator says nothing.
    CHECK(tree_of({"- a", "u b"}) == "u(a b)");
    CHECK(tree_of({"+ a", "- b"}) == "-(a b)");
}

TEST_CASE("v4: the scale in a matrix's last element is divided out", "[asc]") {
    const Scene scene = parse(head +
                              "C N c 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                              "M u a 1 0 0 10 0 1 0 20 0 0 1 30 0 0 0 0.5 0\n"
                              "M u b 0 -4 0 8 4 0 0 0 0 0 4 0 0 0 0 4\n");
    const auto& nodes = comb(scene, "c").tree.nodes;
    CHECK(nodes[0].matrix == Matrix{2, 0, 0, 20, 0, 2, 0, 40, 0, 0, 2, 60, 0, 0, 0, 1});
    CHECK(nodes[1].matrix == Matrix{0, -1, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

TEST_CASE("v4: numbers and lines as other programs write them", "[asc]") {
    std::string text = "I 1 v4\r\ntitle\r\nS\t19  ball 0 +1.5 .5 5. 1e-400 0 1E+2" + zeros.substr(0, 36) + " \r\n";
    const Scene scene = parse(text);
    CHECK(scene.title == "title");
    CHECK(shape<Ell>(scene, "ball").v == Vec3{1.5, 0.5, 5});
    CHECK(shape<Ell>(scene, "ball").a == Vec3{0, 0, 100});
}

TEST_CASE("v4: what is wrong is named with its place", "[asc][broken]") {
    const std::string c = "C N c 0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    const std::string numbers = " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";
    const Broken cases[] = {
        {"23 parameters", head + "S 19 e 0" + numbers + "\n", 3, 55, "e", "23 of 24"},
        {"25 parameters", head + "S 19 e 0 0 0" + numbers + "\n", 3, 58, "e", "should end here"},
        {"not a number", head + "S 19 e 0 1x" + numbers + "\n", 3, 10, "e", "'1x' is not a number"},
        {"not finite", head + "S 19 e 0 nan" + numbers + "\n", 3, 10, "e", "not a finite number"},
        {"infinite", head + "S 19 e 0 -inf" + numbers + "\n", 3, 10, "e", "not a finite number"},
        {"too large", head + "S 19 e 0 1e999" + numbers + "\n", 3, 10, "e", "too large"},
        {"no type of solid", head + "S 17 e 0 0" + numbers + "\n", 3, 3, "e", "no solid has type 17"},
        {"no name", head + "S 19\n", 3, 5, "", "the solid's name is missing"},
        {"no unit", "I 10 v4\ntitle\n", 1, 3, "", "outside 0 to 9"},
        {"unknown record", head + "X y z\n", 3, 1, "", "no record"},
        {"a longer word", head + "Solid 19\n", 3, 1, "", "no record"},
        {"orphans, named once", head + "M u a" + unit_matrix + "M u b" + unit_matrix, 3, 1, "", "without a comb"},
        {"operator", head + c + "M u a" + unit_matrix + "M * b" + unit_matrix, 5, 3, "c", "'*' is no operator"},
        {"short matrix", head + c + "M u a 1 0 0 0 0 1 0\n", 4, 20, "c", "7 of 16"},
        {"long matrix", head + c + "M u a" + unit_matrix.substr(0, 34) + " 0 0\n", 4, 41, "c", "should end here"},
        {"matrix of text", head + c + "M u a 1 0 0 x" + unit_matrix, 4, 13, "c", "'x' is not a number"},
        {"region flag", head + "C X c 0 0 0 0 0 0 0 0 0 0 0 0 0\nM u a" + unit_matrix, 3, 3, "", "region flag"},
        {"short combination", head + "C Y c 0 0 0\n", 3, 12, "c", "COMGEOM number is missing"},
        {"colour", head + "C Y c 0 0 0 0 0 0 1 256 0 0 0 0 0\nM u a" + unit_matrix, 3, 21, "c", "outside 0 to 255"},
        {"shader cut off", head + "C Y c 0 0 0 0 0 0 0 0 0 0 1 1 0\nplastic\n", 5, 1, "c", "parameters is missing"},
        {"colour table", head + "m 0 1 2 0 0\n", 3, 12, "", "blue is missing"},
        {"whole numbers", head + "m 0 1.5 2 0 0 0\n", 3, 5, "", "not a whole number"},
        {"duplicate", head + "C N c 0 0 0 0 0 0 0 0 0 0\nS 19 c 0 0" + numbers + "\n", 4, 1, "c", "line 3"},
        {"planes missing", head + "n a 3\nn 0 0 1 5\nn 0 0 -1 5\n", 6, 1, "a", "plane 3 of 3 is missing"},
        {"plane cut off", head + "n a 2\nn 0 0 1\nn 0 0 -1 5\n", 4, 8, "a", "3 of 4"},
        {"too many planes", head + "n a 16385\n", 3, 5, "a", "outside 1 to 16384"},
        {"mesh cut off", head + "t b 2 2 0 3 1\n\t0: 0 0 0\n\t1: 1 0 0\n", 6, 1, "b", "2 of 4"},
        {"corner", head + "t b 2 2 0 1 1\n\t0: 0 0 0\n\t0: 0 0 1\n", 5, 9, "b", "there is no number 1"},
        {"plate without bits", head + "t b 3 2 0 1 1\n\t0: 0 0 0\n\t0: 0 0 0 5\n", 6, 1, "b", "2 of 3"},
        {"records of an ars", head + "A 21 r 2 9 2 3 0\n", 3, 8, "r", "need 4 records B, not 3"},
        {"segment", head + "d k 0 0 0 1 0 0 0 1 0 1 1\n 0 0\n  X 0 0 0\n", 5, 3, "k", "'X' is no curve"},
        {"vertex of a segment", head + "d k 0 0 0 1 0 0 0 1 0 1 1\n 0 0\n  L 0 0 1\n", 5, 9, "k", "no number 1"},
        {"knots", head + "d k 0 0 0 1 0 0 0 1 0 1 1\n 0 0\n  N 0 2 10 4 1\n", 5, 7, "k", "do not go with 4 knots"},
        {"sketch cut off", head + "d k 0 0 0 1 0 0 0 1 0 1 2\n 0 0\n  L 0 0 0\n", 6, 1, "k", "the sketch ends early"},
        {"dsp without a file", head + "s dsp d w=1 n=1\n", 3, 9, "d", "has no file"},
        {"dsp's width", head + "s dsp d file=a w=0 n=1\n", 3, 18, "d", "outside 1 to"},
        {"dsp's quote", head + "s dsp d file=\"a w=0 n=1\n", 3, 14, "d", "never closed"},
        {"dsp's word", head + "s dsp d file=a large\n", 3, 16, "d", "key=value"},
        {"dsp's key", head + "s dsp d file=a w=1 n=1 high=3\n", 3, 24, "d", "'high' is no parameter"},
        {"dsp's matrix", head + "s dsp d file=a w=1 n=1 stom=1,0,0\n", 3, 29, "d", "stom has 3 of 16"},
        {"vol's size", head + "s vol d file=a w=1 n=1 d=1 size=1,x,1\n", 3, 35, "d", "'x' is not a number"},
        {"mesh too long", head + "t b 2 2 0 1 0\n\t0: 0 0 0\n\t1: 1 0 0\n\t2: 1 0 0\n", 5, 1, "", "no record"},
        {"pipe without an end", head + "w p\n0 1 2 0 0 0\n", 3, 4, "p", "END_PIPE"},
        {"ars cut off", head + "A 21 r 1 9 2 2 0\nB 22 0 1" + zeros + "\n", 5, 1, "r", "1 of 2"},
        {"record B cut off", head + "A 21 r 1 9 2 2 0\nB 22 0 1\n", 4, 9, "r", "0 of 24 coordinates"},
        {"a count of billions", head + "N 1 n 2000000000\n 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n00\n",
         6, 1, "n", "1 of 8000000000"},
    };
    for (const Broken& broken : cases) check_broken(broken);
}

TEST_CASE("v4: several findings come at once, in the order of the file", "[asc][broken]") {
    const auto findings =
        findings_in(head + "S 19 e 0 x\nX\nC N c 0 0 0 0 0 0 0 0 0 0 0 0 0\nM u a 1\nM ? b" + unit_matrix +
                    "C Y d a\nplastic\nM u a" + unit_matrix + "I 77 v4\ntitle\n" + solid(19, "c", {}));
    REQUIRE(findings.size() == 7);
    const int lines[] = {3, 4, 6, 7, 8, 11, 13};
    for (std::size_t i = 0; i < 7; ++i) CHECK(findings[i].place.line == lines[i]);
    CHECK(findings[4].place.pointer == "d");
}

TEST_CASE("v4: findings end at a limit", "[asc][broken]") {
    std::string text = head;
    for (int i = 0; i < 1000; ++i) text += "S 19 e\nC ?\n";
    const auto findings = findings_in(text);
    REQUIRE(findings.size() == FindingList::most + 1);
    CHECK(findings.back().message == "and 1950 more errors");
}
