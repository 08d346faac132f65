// Which form a text has, files that are none, and BRL-CAD's own models.
#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/brlcad_models.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::asc_test;
using namespace csgrt::brlcad_test;

TEST_CASE("asc: the form is told by the first record", "[asc]") {
    CHECK(parse("I 1 v4\nold\n").title == "old");
    CHECK(parse("# I 1 v4\n\n  title new\n").title == "new");
    CHECK(parse("S 24 h 0 0 0 1 5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n").objects.size() == 1);
    CHECK(parse("put {h} half N {0 0 1} d 5").objects.size() == 1);
}

TEST_CASE("asc: what is no text database is refused", "[asc][broken]") {
    check_broken({"empty", "", 1, 1, "", "empty"});
    check_broken({"blank", " \n\n", 1, 1, "", "empty"});
    check_broken({"binary", std::string("title x\nv\1\0\0", 12), 2, 3, "", "no text"});
    check_broken({"another language", "{\"csgrt\": 1}\n", 1, 2, "", "no command"});

    CHECK(test::says(test::failure(Status::file, [] { read_brlcad_asc("no such folder/model.asc"); }),
                     "no such folder/model.asc"));
}

TEST_CASE("asc: any end of a file, and any byte in it, gives a scene or findings", "[asc][broken]") {
    const std::string texts[] = {
        "I 1 v4\ntitle\nS 16 t 0 0 0 0 0 0 1 3 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\nn a 1\nn 0 0 1 5\n"
        "t b 2 2 0 1 1\n\t0: 0 0 0\n\t0: 0 0 0\nC Y c 0 0 0 0 0 0 1 1 2 3 1 1 1\nplastic\nsh=1\n"
        "M u t 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\nM - a 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\nm 0 1 2 3 4 5\n",
        "title {T}\nunits mm\nput {a b} arbn N 1 P0 {0 0 1 5}\nput \"q\" tor V {0 0 0} H {0 0 1} r_a 2 r_h\\ \\x31 1\n"
        "put {c} comb region yes tree {- {l {a b} {1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 2}} {! {l q}}}\n"
        "attr set {c} {rgb} {1/2/3} {shader} {plastic {sh 5}}\ncolor 1 2 3 4 5\n",
    };
    Attempts all;
    for (const std::string& text : texts) {
        const Attempts attempts = changed(text, "{}\"\\\n -9e\x80", parse);
        all.read += attempts.read, all.refused += attempts.refused;
    }
    CHECK(all.read > 100);
    CHECK(all.refused > 1000);
}

TEST_CASE("asc: BRL-CAD's models", "[asc][models]") {
    const auto folder = model_folder();
    if (folder.empty()) return;
    for (const Model& model : models) {
        INFO(model.file);
        const Scene scene = read_brlcad_asc((folder / (std::string(model.file) + ".asc")).string());
        check_counts(scene, model);
    }
}

TEST_CASE("asc: Boolean Ops and Operators in detail", "[asc][models]") {
    const auto folder = model_folder();
    if (folder.empty()) return;

    const Scene boolean_ops = read_brlcad_asc((folder / "boolean-ops.asc").string());
    CHECK(boolean_ops.title == "Boolean Operations");
    CHECK(boolean_ops.units == "mm");
    CHECK(written(comb(boolean_ops, "aUbUc").tree) == "u(a b c)");
    CHECK(written(comb(boolean_ops, "a-b-c").tree) == "-(a b c)");
    CHECK(written(comb(boolean_ops, "a-b+c").tree) == "+(-(a b) c)");
    CHECK(written(comb(boolean_ops, "c-a-b").tree) == "-(c a b)");
    CHECK(written(comb(boolean_ops, "all").tree) == "u(a.r b.r c.r)");
    CHECK(comb(boolean_ops, "a-b-c").region_id == 1001);
    REQUIRE(boolean_ops.region_colors.size() == 3);
    CHECK(boolean_ops.region_colors[1].low == 1001);
    CHECK(boolean_ops.region_colors[1].color == Vec3{0, 1, 0});
    CHECK(shape<Arb>(boolean_ops, "a").vertices[0] == Vec3{1, -1, -1});
    CHECK(shape<Arb>(boolean_ops, "a").vertices[6] == Vec3{-1, 1, 1});

    const Scene operators = read_brlcad_asc((folder / "operators.asc").string());
    CHECK(written(comb(operators, "subtraction").tree) == "-(grnsph.r redehy.r)");
    CHECK(written(comb(operators, "subtraction_r").tree) == "-(redehy.r grnsph.r)");
    CHECK(written(comb(operators, "union").tree) == "u(-(grnsph.r redehy.r) redehy.r)");
    CHECK(written(comb(operators, "intersection").tree) == "+(grnsph.r redehy.r)");
    CHECK(comb(operators, "subtraction").tree.nodes[1].matrix[3] == 750);
    CHECK(comb(operators, "intersection").color == Vec3{1, 1, 0});
    CHECK(comb(operators, "intersection").color_inherits);
    CHECK(comb(operators, "redehy.r").region);
    CHECK(comb(operators, "redehy.r").region_id == 1000);
    CHECK(shape<Ehy>(operators, "ehy").h == Vec3{0, 0, 1500});
    CHECK(shape<Ehy>(operators, "ehy").c == 1);
    CHECK(top_objects(operators) == std::vector<std::string>{"operators"});
}
