// csgrt check: what it prints and writes, and how it ends.
#include <array>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

using namespace command_test;
using nlohmann::json;

namespace {

/// Two balls of radius 10, one of them about the origin, in csgrt's format.
std::string balls(const std::array<double, 3>& other, const std::string& left = "left.r", bool with_mesh = false) {
    json scene = {
        {"csgrt", 1},
        {"solids",
         {{"a", {{"type", "sphere"}, {"center", {0, 0, 0}}, {"radius", 10}}},
          {"b", {{"type", "sphere"}, {"center", other}, {"radius", 10}}}}},
        {"combinations",
         {{left, {{"tree", "a"}, {"region", true}, {"id", 1}}},
          {"right.r", {{"tree", "b"}, {"region", true}, {"id", 2}}},
          {"all", {{"tree", {{"union", {left, "right.r"}}}}}}}},
    };
    if (with_mesh) {  // a tetrahedron on each side, far away; distances to it are not known
        json far = {{"type", "bot"}, {"vertices", json::array()}, {"faces", json::array()}};
        for (const int s : {-1, 1}) {
            const std::size_t n = far["vertices"].size();
            for (const std::array<int, 3>& v : {std::array{50, 50, 50}, {51, 50, 50}, {50, 51, 50}, {50, 50, 51}})
                far["vertices"].push_back({s * v[0], s * v[1], s * v[2]});
            for (const std::array<std::size_t, 3>& f :
                 {std::array<std::size_t, 3>{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
                far["faces"].push_back({n + f[0], n + f[1], n + f[2]});
        }
        scene["solids"]["far"] = far;
        scene["combinations"][left]["tree"] = {{"union", {"a", "far"}}};
    }
    return scene.dump();
}

constexpr std::array<double, 3> deep = {18, 0, 0};         ///< 2 mm
constexpr std::array<double, 3> aslant = {10.8, 14.4, 0};  ///< as deep, in a larger common box
constexpr double pi = 3.14159265358979323846;
const double lens = 2 * pi * 1 * (3 * 10 - 1) / 3;  ///< mm^3, that these balls share: two caps of height 1

}  // namespace

TEST_CASE("check prints a table of what overlaps, and writes JSON and rays that shoot reads", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.json", balls(deep));
    const Result table = run({"check", scene, "--json", folder / "out.json", "--write-rays", folder / "rays"});
    CAPTURE(table.out, table.err);
    CHECK(table.status == 8);
    CHECK(table.err.empty());
    CHECK(table.out.starts_with("  depth mm    at most   volume mm^3         +-  place mm\n"));
    CHECK(contains(table.out, "\n  /all/left.r /all/right.r\n"));
    CHECK(contains(
        table.out,
        "\n1 overlap: 1 new at least 0.01 mm deep, 0 allowed, 0 less deep\nboxes that overlap: 1 pair of 2 regions"));
    std::istringstream lines(table.out);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);

    const json result = json::parse(read_file(folder / "out.json"));
    CHECK(result["complete"] == true);
    CHECK(result["new"] == 1);
    REQUIRE(result["overlaps"].size() == 1);
    const json& overlap = result["overlaps"][0];
    CHECK(overlap["regions"] == json({"/all/left.r", "/all/right.r"}));
    CHECK(overlap["indices"] == json({0, 1}));
    CHECK(std::abs(overlap["depth"].get<double>() - 2) < 0.02);
    CHECK(overlap["depth_at_most"].get<double>() >= overlap["depth"].get<double>());
    CHECK(std::abs(overlap["volume"][0].get<double>() - lens) <= 2.5 * overlap["volume"][1].get<double>());
    CHECK(std::abs(overlap["place"][0].get<double>() - 9) < 0.1);
    CHECK(overlap["link"].get<std::string>().starts_with("#%7B%22camera%22%3A%7B%22center%22%3A%5B"));
    CHECK((overlap["new"] == true && overlap["allowed"] == false && overlap["near_limit"] == false));

    const Result shot = run({"shoot", scene, "--rays", folder / "rays"});
    CAPTURE(shot.out);
    CHECK(shot.status == 0);
    const std::size_t at = shot.out.find("\noverlap ");
    REQUIRE(at != shot.out.npos);
    std::istringstream words(shot.out.substr(at + 9));
    double in = 0, out = 0;
    std::string regions;
    words >> in >> out;
    std::getline(words, regions);
    CHECK(std::abs(in - overlap["range"][0].get<double>()) < 1e-9);
    CHECK(std::abs(out - overlap["range"][1].get<double>()) < 1e-9);
    CHECK(regions == " /all/left.r /all/right.r");
}

TEST_CASE("parts that touch or stand apart do not overlap, and check ends with 0", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    std::vector<std::string> scenes = {folder.write("touch.json", balls({20, 0, 0})),
                                       folder.write("touch_aslant.json", balls({12, 16, 0})),
                                       folder.write("apart.json", balls({12, 16.001, 0}))};
    if (const char* own = std::getenv("CSGRT_SCENES")) {
        const fs::path field = fs::path(own) / "../../shared/field/touching.json";
        if (fs::exists(field))
            scenes.push_back(field);
        else
            WARN("shared/field/touching.json is absent: left out");
    }
    for (const std::string& scene : scenes) {
        const Result result = run({"check", scene, "--junit", folder / "junit"});
        CAPTURE(scene, result.out, result.err);
        CHECK(result.status == 0);
        CHECK(contains(result.out, "0 overlaps: 0 new at least 0.01 mm deep, 0 allowed, 0 less deep\n"));
        CHECK(contains(read_file(folder / "junit"), "tests=\"1\" failures=\"0\" errors=\"0\""));
        CHECK(contains(read_file(folder / "junit"), "name=\"no regions overlap\"/>"));
    }
}

TEST_CASE("what is allowed or less deep than --min-depth is listed, but does not count", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.json", balls(deep));
    const auto checked = [&](const std::string& list) {
        return run({"check", scene, "--allow", folder.write("allowed", list), "--json", folder / "json"});
    };
    for (const char* list : {"/all/right.r /all/left.r\n", "/all /all\n", "*left* \"/all/r*\"  # welded\n"}) {
        const Result result = checked(list);
        CAPTURE(list, result.out, result.err);
        CHECK(result.status == 0);
        CHECK(result.err.empty());
        CHECK(contains(result.out, "  allowed\n"));
        CHECK(contains(result.out, "\n1 overlap: 0 new at least 0.01 mm deep, 1 allowed, 0 less deep\n"));
    }
    const Result other = checked("/all/left.r /all/left.r\n");
    CHECK(other.status == 8);
    CHECK(contains(other.err, "allowed: no overlap needs the row '/all/left.r /all/left.r'\n"));
    CHECK(json::parse(read_file(folder / "json"))["unused"] ==
          json::array({json::array({"/all/left.r", "/all/left.r"})}));
    CHECK(contains(check_run({"check", scene, "--allow", folder.write("wrong", "/a\n")}, 3, "wrong:1:3: ").err,
                   "the second pattern is missing"));

    const Result near = run({"check", scene, "--min-depth", "2.5"});
    CAPTURE(near.out);
    CHECK(near.status == 0);
    CHECK(contains(near.out, "~  "));
    CHECK(contains(near.out, "  less deep\n"));
    CHECK(contains(near.out, "\n~ is near the limit"));
    CHECK(contains(near.out, "\n1 overlap: 0 new at least 2.5 mm deep, 0 allowed, 1 less deep\n"));
    const std::string bar = folder.write("mesh.json", balls(deep, "left.r", true));
    CHECK(contains(run({"check", bar, "--min-depth", "2.0001", "--certain", "2.0001"}).out, " perhaps deeper)\n"));
    const std::string shallow = folder.write("aslant.json", balls(aslant));
    CHECK(contains(run({"check", shallow, "--min-depth", "5"}).out,
                   "shallower than 2.5 mm: 1\nnot seen to overlap: 0 pairs; largest ball that is not "));
}

TEST_CASE("check names a region without an end, and searches its part in the box of all others", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("half.json",
                                           R"({"csgrt":1,"solids":{"h":{"type":"half","normal":[0,0,1],"distance":0},
            "b":{"type":"sphere","center":[0,0,8],"radius":10}},
            "combinations":{"h.r":{"region":true,"tree":"h"},"b.r":{"region":true,"tree":"b"},
            "all":{"tree":{"union":["h.r","b.r"]}}}})");
    const Result result = run({"check", scene, "--json", folder / "json"});
    CAPTURE(result.out, result.err);
    CHECK(result.status == 8);
    CHECK(result.err ==
          "csgrt: warning: /all/h.r: has no end: only its part within the box of the others was searched\n");
    const json found = json::parse(read_file(folder / "json"));
    CHECK(found["unbounded"] == json::array({"/all/h.r"}));
    REQUIRE(found["overlaps"].size() == 1);
    CHECK(std::abs(found["overlaps"][0]["depth"].get<double>() - 2) < 0.05);
}

TEST_CASE("check tells the largest ball that it does not exclude, and with --certain what this costs",
          "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    const auto checked = [&](const std::string& scene, const std::string& certain) {
        return run({"check", scene, "--min-depth", "0.005", "--certain", certain, "--json", folder / "json"});
    };
    const std::string apart =
        folder.write("apart.json", balls({15, 15, 0}, "left.r", true));  // but their boxes overlap
    for (const char* certain : {"0", "0.02"}) {
        const Result result = checked(apart, certain);
        CAPTURE(result.out, result.err);
        CHECK(result.status == 0);
        CHECK(contains(result.err, "rays to come, some ") == (certain != std::string("0")));
        CHECK(contains(result.out, "\nnot seen to overlap: 1 pair; largest ball that is not excluded: 0."));
        CHECK(contains(result.out, "\nA ball of 0.02 mm is in no pair that is not listed.\n") ==
              (certain != std::string("0")));
        CHECK(contains(result.out, certain == std::string("0") ? " mm (see --certain)\n  /all/left.r /all/right.r\n"
                                                               : " mm\n  /all/left.r /all/right.r\n"));
        const json found = json::parse(read_file(folder / "json"));
        CHECK(found["certain"] == std::stod(certain));
        REQUIRE(found["unlisted"].size() == 1);
        const json& pair = found["unlisted"][0];
        CHECK((pair["regions"] == json({"/all/left.r", "/all/right.r"}) && pair["indices"] == json({0, 1})));
        CHECK(pair["seen"] == false);
        CHECK((pair["depth_at_most"] < 0.02) == (certain != std::string("0")));
    }
    const Result both = checked(folder.write("balls.json", balls(deep)), "0.02");
    CHECK_FALSE(contains(both.out, "not seen to overlap"));
    CHECK(json::parse(read_file(folder / "json"))["unlisted"].empty());
    check_run({"check", apart, "--certain", "1e-6", "--min-depth", "1e-6"}, 2, "is possible");
}

TEST_CASE("a row that check writes for the list of allowed overlaps allows its overlap, whatever the paths",
          "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    for (const char* name : {"left.r", "a b.r", "[a-b]*.r", "a\\b?.r", "say \"x\" y.r", "\"q\".r", "a#b.r"}) {
        const std::string scene = folder.write("balls.json", balls(deep, name));
        const json found = json::parse(run({"check", scene, "--json", "-"}).out);
        CAPTURE(name, found.dump());
        REQUIRE(found["overlaps"].size() == 1);
        const std::string row = found["overlaps"][0]["allow"];
        CHECK(run({"check", scene, "--allow", folder.write("allowed", row + "\n")}).status == 0);
    }
}

TEST_CASE("check's report of JUnit is XML with a failure for each new overlap", "[promise:check]") {
    NEEDS_COMMAND();
    if (std::system("python3 -c 'import xml.etree.ElementTree'") != 0) {
        WARN("there is no python3: skipped");
        return;
    }
    const Folder folder;
    const std::string scene = folder.write("two \"balls\" & <more>.json", balls(deep, "<a & 'b'>\x01\xc3\xa9.r"));
    const auto parsed = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"check", scene, "--junit", "-"});
        const Result result = run(more);
        CAPTURE(result.out, result.err);
        const std::string xml = folder.write("junit.xml", result.out);
        const std::string program =
            "import sys, xml.etree.ElementTree as e\n"
            "suite = e.parse(sys.argv[1]).getroot().find('testsuite')\n"
            "cases = suite.findall('testcase')\n"
            "print(suite.get('tests'), suite.get('failures'), len(cases), len(suite.findall('testcase/failure')))\n"
            "for case in cases: print(ascii(case.get('classname')[-25:]), ascii(case.get('name')))\n";
        REQUIRE(std::system(("python3 '" + folder.write("parse.py", program) + "' '" + xml + "' > '" +
                             (folder / "parsed") + "'")
                                .c_str()) == 0);
        return read_file(folder / "parsed");
    };
    const std::string name = " '\"/all/<a & \\'b\\'>\\\\001\\xe9.r\" /all/right.r'\n";
    const std::string of = "'two \"balls\" & <more>.json'";
    CHECK(parsed({}) == "1 1 1 1\n" + of + name);
    CHECK(parsed({"--min-depth", "2.5"}) == "1 0 1 0\n" + of + name);
}

TEST_CASE("check's JSON has the same bytes with any number of threads", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.json", balls(deep));
    const auto bytes = [&scene](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"check", scene, "--json", "-"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).out;
    };
    const std::string one = bytes({"--threads", "1"});
    CHECK(one.size() > 500);
    CHECK(bytes({"--threads", "2"}) == one);
    CHECK(bytes({"--reference"}) == one);
    CHECK(bytes({"--seed", "2"}) != one);
}
