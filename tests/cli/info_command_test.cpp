// csgrt info and csgrt convert.
#include <nlohmann/json.hpp>

#include "cli/command.hpp"

using namespace command_test;

TEST_CASE("info tells what a scene holds") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const Result result = run({"info", scene});
    REQUIRE(result.status == 0);
    CHECK(result.err.empty());
    CHECK(contains(result.out,
                   "title     two balls\nunits     mm\nobjects   6 (ell 2, region 2, arb8 1, combination 1)\n"));
    CHECK(contains(result.out,
                   "all.g  combination  of 2\n"
                   "    left.r  region 1001  of 2\n"
                   "        left.s  ell\n"
                   "        - hole.s  arb8\n"
                   "    u right.r  region 1002  of 1\n"
                   "        right.s  ell\n"));
    CHECK(contains(result.out,
                   "\nsolids    3 (ell 2, arb8 1)\nregions   2\nbounds    -10 -10 -10 to 25 10 10 mm\ncompiled  "));

    const Result shallow = run({"info", scene, "all.g", "--depth", "1"});
    CHECK(contains(shallow.out, "    left.r  region 1001  of 2\n    u right.r"));
    const Result one = run({"info", scene, "right.r"});
    CHECK(contains(one.out, "bounds    5 -10 -10 to 25 10 10 mm"));
    const Result path = run({"info", scene, "all.g/left.r"});
    CHECK(contains(path.out, "\nall.g/left.r  region 1001  of 2\n    left.s  ell\n    - hole.s  arb8\n"));
}

TEST_CASE("info brackets what the operators alone do not say, and unfolds a shared object once") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write(
        "trees.asc", std::string(two_balls) +
                         "put nested.r comb region yes tree {- {u {l left.s} {l right.s}} {+ {l hole.s} {l left.s}}}\n"
                         "put chain.r comb region yes tree {+ {- {l left.s} {l hole.s}} {l right.s}}\n"
                         "put twice.g comb region no tree {u {l all.g} {l all.g {1 0 0 9 0 1 0 0 0 0 1 0 0 0 0 1}}}\n");
    const Result nested = run({"info", scene, "nested.r"});
    CHECK(contains(nested.out, "    (left.s  ell\n    u right.s)  ell\n    - (hole.s  arb8\n    + left.s)  ell\n"));
    const Result chain = run({"info", scene, "chain.r"});
    CHECK(contains(chain.out, "    left.s  ell\n    - hole.s  arb8\n    + right.s  ell\n"));
    const Result twice = run({"info", scene, "twice.g"});
    CHECK(contains(twice.out, "    u all.g  combination  of 2  (see above)\n"));
    CHECK(contains(twice.out, "regions   4\n"));
}

TEST_CASE("info shows the tree of a scene that cannot be rendered, and says why it cannot") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene =
        folder.write("lost.asc", std::string(two_balls) + "put lost.r comb region yes tree {l gone.s}\n");
    const Result result = run({"info", scene, "lost.r", "--strict"});
    CHECK(result.status == 3);
    CHECK(contains(result.out, "    gone.s  (missing)\n"));
    CHECK(contains(result.err, "gone.s"));
    const Result lenient = run({"info", scene, "lost.r"});
    CHECK(lenient.status == 0);
    CHECK(contains(lenient.out, "    gone.s  (missing)\n"));
    CHECK(contains(lenient.out, "gone.s: left out: there is no such object; used by 'lost.r'"));
    CHECK(run({"info", folder / "absent.asc"}).status == 6);
}

TEST_CASE("info writes the model as JSON", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene =
        folder.write("odd.asc", std::string(two_balls) +
                                    "put half.s half N {0 0 1} d 3\n"
                                    "put \"a\\\"b.r\" comb region yes id 7 air 2 los 50 GIFTmater 4 rgb 255/0/51 "
                                    "tree {u {l half.s} {l gone.s}}\n");
    const Result result = run({"info", scene, "all.g", "a\"b.r", "--air", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto info = nlohmann::json::parse(result.out);
    CHECK(info["title"] == "two balls");
    CHECK(info["units"] == "mm");
    CHECK(info["solids"] == 4);
    CHECK(info["bounds"] == nlohmann::json::parse(R"({"low": [-10, -10, -10], "high": [25, 10, 10]})"));
    REQUIRE(info["regions"].size() == 3);
    CHECK(info["regions"][1]["path"] == "/all.g/right.r");
    CHECK(info["regions"][1]["region_id"] == 1002);
    CHECK(info["regions"][1]["bounds"]["low"] == nlohmann::json::parse("[5, -10, -10]"));
    const auto& odd = info["regions"][2];
    CHECK(odd["index"] == 2);
    CHECK(odd["path"] == "/a\"b.r");
    CHECK(odd["air"] == 2);
    CHECK(odd["material_id"] == 4);
    CHECK(odd["los"] == 50);
    CHECK(odd["color"] == nlohmann::json::parse("[1, 0, 0.2]"));
    CHECK(odd["bounds"]["low"][0].is_null());  // infinite
    REQUIRE(info["warnings"].size() == 1);
    CHECK(info["warnings"][0]["object"] == "gone.s");
    CHECK(contains(info["warnings"][0]["place"], "odd.asc:"));
    CHECK(contains(info["warnings"][0]["reason"], "left out: there is no such object"));

    const auto nothing = nlohmann::json::parse(
        run({"info", folder.write("lost.asc", std::string(two_balls) + "put lost.r comb region yes tree {l gone.s}\n"),
             "lost.r", "--json"})
            .out);
    CHECK(nothing["bounds"].is_null());
    CHECK(nothing["regions"].empty());
    CHECK(nothing["warnings"].size() >= 1);
}

TEST_CASE("convert writes a scene that renders the same", "[promise:round-trip]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), json = folder / "balls.json";
    const Result result = run({"convert", scene, json});
    REQUIRE(result.status == 0);
    CHECK(result.out.empty());
    CHECK(result.err.empty());
    CHECK(run({"convert", scene, "-"}).out == read_file(json));

    const std::string rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n0.3 0 -70 0 0.1 1\n");
    REQUIRE(run({"shoot", scene, "--rays", rays, "--reference", "-o", folder / "a.txt"}).status == 0);
    REQUIRE(run({"shoot", json, "--rays", rays, "--reference", "-o", folder / "b.txt"}).status == 0);
    CHECK(run({"compare", folder / "a.txt", folder / "b.txt"}).status == 0);

    const Result onto_itself = check_run({"convert", json, folder / "./balls.json"}, 2, "OUT: ");
    CHECK(contains(onto_itself.err, "would overwrite IN"));
    CHECK(run({"convert", scene, folder / "none/balls.json"}).status == 6);
    CHECK(run({"convert", scene, "-"}, {.output = "/dev/full"}).status == 6);
}
