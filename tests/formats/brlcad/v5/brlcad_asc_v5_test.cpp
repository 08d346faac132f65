// BRL-CAD's newer text form: each command, Tcl's quoting, trees of any depth, and what is wrong where.
#include "formats/brlcad/brlcad_asc_text.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;

namespace {

const std::string head = "title {T}\nunits mm\n";

std::string tree_of(const std::string& tree) {
    return written(comb(parse(head + "put {c} comb region no tree {" + tree + "}\n"), "c").tree);
}

}  // namespace

TEST_CASE("v5: title, units and colours", "[asc]") {
    const Scene scene = parse(
        "# a comment\n\ntitle {A \\{model\\}, \"quoted\"}\nunits {in}\ncolor 10 19 255 0 51 \n"
        "attr set {_GLOBAL} {regionid_colortable} {{1 2 0 0 255} {3 4 0 255 0} }\n");
    CHECK(scene.title == "A {model}, \"quoted\"");
    CHECK(scene.units == "in");
    CHECK(scene.unit_length == 25.4);
    REQUIRE(scene.region_colors.size() == 3);
    CHECK(scene.region_colors[0].low == 10);
    CHECK(scene.region_colors[0].high == 19);
    CHECK(scene.region_colors[0].color == Vec3{1, 0, 0.2});
    CHECK(scene.region_colors[2].low == 3);
    CHECK(scene.region_colors[2].color == Vec3{0, 1, 0});

    const Scene global = parse("title two  words\nattr set {_GLOBAL} {title} {other} {units} {304.8} {note} {}\n");
    CHECK(global.title == "other");
    CHECK(global.units == "ft");
    CHECK(global.unit_length == 304.8);
    CHECK(parse("title two  words\n").title == "two words");
}

TEST_CASE("v5: trees", "[asc]") {
    CHECK(tree_of("") == "");
    CHECK(tree_of(" l a ") == "a");
    CHECK(tree_of("u {l a} {l b}") == "u(a b)");
    CHECK(tree_of("- {n {l a} {l b}} {u {l c} {^ {l d} {l e}}}") == "-(+(a b) u(c ^(d e)))");
    CHECK(tree_of("+ {! {l a}} {l b}") == "+(!(a) b)");
    CHECK(tree_of("\n  u\n{ l a }\\\n {\tl b}\n") == "u(a b)");
    CHECK(tree_of("u {l {two words}} {l a{b}c}") == "u(two words a{b}c)");

    const std::string scaled = "{0 -4 0 8  4 0 0 0  0 0 4 0  0 0 0 4}";
    const Scene scene = parse(head + "put {c} comb region no tree {u {l a} {l b " + scaled + "}}\n");
    const auto& nodes = comb(scene, "c").tree.nodes;
    CHECK(nodes[0].matrix == identity);
    CHECK(nodes[1].matrix == Matrix{0, -1, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    CHECK(nodes[1].place.line == 3);
    CHECK(nodes[1].place.column == 41);
    CHECK(nodes[1].place.pointer == "c");
    CHECK(nodes[2].arity == 2);
    CHECK(nodes[2].place.column == 30);
}

TEST_CASE("v5: a tree may be 100,000 deep, to either side", "[asc]") {
    constexpr int depth = 100'000;
    std::string left, right;
    for (int i = 0; i < depth; ++i) left += "{- ";
    left += "{l a}";
    for (int i = 0; i < depth; ++i) left += " {l b}}";
    for (int i = 0; i < depth; ++i) right += "{u {l a} ";
    right += "{l b}" + std::string(depth, '}');
    const std::string braces = std::string(depth, '{') + std::string(depth, '}');
    const Scene scene = parse(head + "put {left} comb region no tree " + left + "\nput {right} comb region no tree " +
                              right + "\nput {many} comb region no tree {l " + braces + "}\n");
    for (const char* name : {"left", "right"}) {
        const auto& nodes = comb(scene, name).tree.nodes;
        REQUIRE(nodes.size() == 2 * depth + 1);
        CHECK(nodes.back().arity == 2);
    }
    CHECK(comb(scene, "left").tree.nodes[2].op == Operator::difference);
    CHECK(comb(scene, "right").tree.nodes[depth].op == Operator::leaf);
    CHECK(comb(scene, "many").tree.nodes[0].object.size() == 2 * (depth - 1));
    // The same without its end: a finding, not a crash.
    const auto findings = findings_in(head + "put {left} comb region no tree " + left.substr(0, left.size() - 1));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].place.column == 32);
    CHECK(findings[0].excerpt.size() < 300);
}

TEST_CASE("v5: a combination's attributes, in every spelling", "[asc]") {
    const Scene scene = parse(
        head +
        "put {a} comb region yes tree {l x}\n"
        "attr set {a} {region} {R} {region_id} {1001} {aircode} {3} {material_id} {7} {los} {50} {rgb} {255/0/51}"
        " {oshader} {glass {tr .85}} {inherit} {1} {PTC_MATERIAL} {steel}\n"
        "put {b} comb region no tree {}\n"
        "attr set {b} {region} {P} {REGION_ID} {5} {air} {1} {GIFTmater} {2} {color} {0 255 0} {shader} {phong sh=5}\n"
        "put {c} comb region yes id 9 air 1 los 30 GIFTmater 4 rgb {0 0 255} shader {mirror} inherit yes tree {l x}\n"
        "put {d} comb region no shader {glass} tree {}\nattr set {d} {oshader} {}\n");
    CHECK(same_attributes(comb(scene, "a"), glass_region));
    const Combination& b = comb(scene, "b");
    CHECK(same_attributes(b, {.region = true,
                              .fastgen = Fastgen::plate,
                              .region_id = 5,
                              .air = 1,
                              .material_id = 2,
                              .color = Vec3{0, 1, 0},
                              .finish = Finish{.shader = "phong", .shine = 5}}));
    CHECK(b.tree.nodes.empty());
    const Finish mirror{.shader = "mirror", .specular = 0.6, .diffuse = 0.4, .shine = 4, .reflect = 0.75};
    CHECK(same_attributes(comb(scene, "c"), {.region = true,
                                             .region_id = 9,
                                             .air = 1,
                                             .material_id = 4,
                                             .los = 30,
                                             .color = Vec3{0, 0, 1},
                                             .finish = mirror,
                                             .color_inherits = true,
                                             .finish_inherits = true}));

    CHECK_FALSE(comb(scene, "d").region);
    CHECK_FALSE(comb(scene, "d").color);
    CHECK_FALSE(comb(scene, "d").finish);
    // Attributes of a solid are no concern of its shape.
    CHECK(parse(head + "put {s} brep\nattr set {s} {region_id} {x}\n").objects.size() == 1);
}

TEST_CASE("v5: Tcl's quoting", "[asc]") {
    const std::string ell = " ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}";
    const Scene scene = parse(
        "title \"tab\\tand \\u00e9 \\101 \\x42\"; units mm\n"
        "put \\\n   {two words}" +
        ell +
        "\n"
        "put a\\ b\\{\\}" +
        ell + "; put \"q\\\"q\"" + ell +
        "\r\n"
        "put {open\\{} ell V {0 0 0} A {1\n0 \\\n 0} B \"0 1 0\" C 0\\ 0\\ 1\n"
        "put {back\\slash}" +
        ell +
        "\n"
        "  put {c} comb region no tree"
        " \"u {l {two words}} {u {l open\\\\{} {l a\\\\ b\\\\{\\\\}}}\"\n"
        "attr set {open\\{} {note} {a \\} b}\n"
        "put {d} comb region no tree {u {l open\\{} {l back\\\\slash}}\n");
    CHECK(scene.title == "tab\tand \u00e9 A B");
    for (const char* name : {"two words", "a b{}", "q\"q", "open{", "back\\slash"}) {
        INFO(name);
        CHECK(shape<Ell>(scene, name).c == Vec3{0, 0, 1});
    }
    CHECK(written(comb(scene, "c").tree) == "u(two words u(open{ a b{}))");
    CHECK(written(comb(scene, "d").tree) == "u(open{ back\\slash)");
    CHECK(scene.objects.size() == 7);
}

TEST_CASE("v5: what is wrong is named with its place", "[asc][broken]") {
    const std::string c = head + "put {c} comb region no tree ";
    const Broken cases[] = {
        {"unknown command", head + "kill {a}\n", 3, 1, "", "'kill' is no command"},
        {"no name", head + "put\n", 3, 4, "", "the object's name is missing"},
        {"no type", head + "put {a}\n", 3, 7, "a", "the object's type is missing"},
        {"empty name", head + "put {} ell\n", 3, 6, "", "name is empty"},
        {"missing parameter", head + "put {a} tor V {0 0 0} H {0 0 1} r_a 2\n", 3, 9, "a", "the tor has no r_h"},
        {"unknown parameter", head + "put {a} half N {0 0 1} e 3 d 2\n", 3, 24, "a", "'e' is no parameter"},
        {"parameter given twice", head + "put {a} half N {0 0 1} d 3 d 2\n", 3, 28, "a", "given twice"},
        {"parameter without a value", head + "put {a} half N {0 0 1} d\n", 3, 24, "a", "has no value"},
        {"two of three", head + "put {a} half N {0 1} d 3\n", 3, 20, "a", "N has 2 of 3"},
        {"four of three", head + "put {a} half N {0 0 0 1} d 3\n", 3, 23, "a", "N has more than 3"},
        {"not a number", head + "put {a} half N {0 0 one} d 3\n", 3, 21, "a", "'one' is not a number"},
        {"not a number, second line", head + "put {a} half N {0\n0 0x1} d 3\n", 4, 3, "a", "'0x1' is not a number"},
        {"not finite", head + "put {a} half N {0 0 1} d inf\n", 3, 26, "a", "not a finite number"},
        {"number of planes", head + "put {a} arbn N 2 P0 {0 0 1 5}\n", 3, 9, "a", "the arbn has no P1"},
        {"planes without number", head + "put {a} arbn N 0\n", 3, 16, "a", "outside 1 to 16384"},
        {"too many planes given", head + "put {a} arbn N 1 P0 {0 0 1 5} P1 {0 0 1 5}\n", 3, 31, "a", "'P1' is no"},
        {"duplicate", head + "put {a} brep\nput {a} brep\n", 4, 6, "a", "line 3"},
        {"operator", c + "{? {l a} {l b}}\n", 3, 30, "c", "'?' is no operator"},
        {"empty node", c + "{u {l a} {}}\n", 3, 39, "c", "empty"},
        {"one operand", c + "{u {- {l a}} {l b}}\n", 3, 33, "c", "1 operands, not 2"},
        {"three operands", c + "{u {l a} {l b} {l c}}\n", 3, 30, "c", "3 operands, not 2"},
        {"two operands of not", c + "{! {l a} {l b}}\n", 3, 30, "c", "2 operands, not 1"},
        {"bare operand", c + "{u {l a} b}\n", 3, 38, "c", "must stand in braces"},
        {"leaf without a name", c + "{l}\n", 3, 31, "c", "names no object"},
        {"leaf that goes on", c + "{l a {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1} b}\n", 3, 68, "c", "goes on"},
        {"short matrix", c + "{l a {1 0 0 0}}\n", 3, 42, "c", "4 numbers, not 16"},
        {"long matrix", c + "{l a {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 9}}\n", 3, 67, "c", "more than 16"},
        {"unknown key of a comb", head + "put {c} comb region no bush {}\n", 3, 24, "c", "'bush' is no parameter"},
        {"neither yes nor no", head + "put {c} comb region maybe\n", 3, 21, "c", "neither yes nor no"},
        {"unclosed brace", head + "put {a} half N {0 0 1 d 3\nput {b} brep\n", 3, 16, "a", "never closed"},
        {"a brace too many", head + "put {a} half N {0 0 1}} d 3\nput {b} brep\n", 3, 23, "a", "without a blank"},
        {"unclosed quote", head + "put \"a half\n", 3, 5, "", "never closed"},
        {"execution", head + "put [exec rm] brep\n", 3, 5, "", "Tcl would replace"},
        {"variables", head + "put {a} half N {0 0 1} d $d\n", 3, 26, "a", "Tcl would replace"},
        {"unit", "title {}\nunits barleycorn\n", 2, 7, "", "'barleycorn' is no unit"},
        {"colour command", head + "color 1 2 0 0\n", 3, 14, "", "blue is missing"},
        {"colour command's range", head + "color 1 2 0 0 300\n", 3, 15, "", "outside 0 to 255"},
        {"colour table", "attr set {_GLOBAL} {regionid_colortable} {{1 2 3 4}}\n", 1, 44, "_GLOBAL", "five numbers"},
        {"attributes of nothing", head + "attr set {a} {los} {1}\n", 3, 11, "a", "no object of that name"},
        {"odd attributes", head + "put {c} comb\nattr set {c} {los}\n", 4, 15, "c", "'los' has no value"},
        {"attr's action", head + "put {c} comb\nattr rm {c} {los}\n", 4, 6, "", "only attr set"},
        {"colour", head + "put {c} comb\nattr set {c} {rgb} {1/2}\n", 4, 21, "c", "no colour"},
        {"colour of four", head + "put {c} comb\nattr set {c} {rgb} {1/2/3/4}\n", 4, 26, "c", "three components"},
        {"region id", head + "put {c} comb\nattr set {c} {region_id} {a}\n", 4, 27, "c", "not a whole number"},
    };
    for (const Broken& broken : cases) check_broken(broken);
}

TEST_CASE("v5: several findings come at once, and one fault is one finding", "[asc][broken]") {
    const auto findings = findings_in(head +
                                      "put {a} ell V {0 0 0} A {1 0 0\n"         // 3: swallows what follows
                                      "attr set {a} {note} {text}\n"             // 4: of a broken object, not another
                                      "put {b} half N {0 0 x} d 1\n"             // 5
                                      "attr set {b} {note} {text}\n"             // 6
                                      "frob\n"                                   // 7
                                      "put {c} comb region no tree {u {l a}}\n"  // 8
                                      "put {d} half N {0 0 1} d 1\n"
                                      "put {d} half N {0 0 1} d 1\n");  // 10
    REQUIRE(findings.size() == 5);
    const int lines[] = {3, 5, 7, 8, 10};
    for (std::size_t i = 0; i < 5; ++i) CHECK(findings[i].place.line == lines[i]);
}

TEST_CASE("v5: findings end at a limit", "[asc][broken]") {
    std::string text = head;
    for (int i = 0; i < 1000; ++i) text += "put {a} half N {\n";
    const auto findings = findings_in(text);
    REQUIRE(findings.size() == FindingList::most + 1);
    CHECK(findings.back().message == "and 950 more errors");
}
