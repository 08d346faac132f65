// What a newcomer reads: help, documentation, bounds of what has none, suggestions, numbers out of range.
#include <sstream>

#include "cli/command.hpp"

using namespace command_test;

namespace {

/// A scene of one solid or tree.
std::string scene_of(const std::string& solids, const std::string& combinations = "") {
    return "{\"csgrt\": 1, \"solids\": {" + solids + "}" +
           (combinations.empty() ? "" : ", \"combinations\": {" + combinations + "}") + "}";
}

constexpr const char* half = R"("h": {"type": "half", "normal": [0, 0, 1], "distance": 0})";
constexpr const char* ball = R"("b": {"type": "sphere", "center": [0, 0, 0], "radius": 2})";

std::string line_with(const std::string& text, const std::string& start) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(start)) return line;
    return {};
}

}  // namespace

TEST_CASE("help says the units of each command, and one example of a picture and of a ray") {
    NEEDS_COMMAND();
    const Result all = run({"--help"});
    CHECK(contains(all.out, "\n  csgrt scenes/operators.json -o operators.png\n"));
    CHECK(contains(all.out, "\n  printf '0 -9000 0  0 1 0\\n' | csgrt shoot scenes/operators.json --rays -\n"));
    CHECK(contains(all.out, "Lengths are millimetres"));
    const Result shoot = run({"help", "shoot"});
    for (const char* column :
         {"\n  ox oy oz ", "\n  dx dy dz ", "\n  INDEX ", "\n  PARTITIONS ", "\n  OVERLAPS ", "\n  region ",
          "\n  in out ", "\n  inx iny inz ", "\n  outx outy outz ", "\n  in-solid ", "\n  out-solid ",
          "\n  in-type out-type ", "\n  overlap ", "millimetres", "lengths of the direction", "negative", "inf"}) {
        CAPTURE(column);
        CHECK(contains(shoot.out, column));
    }
    const std::pair<const char*, const char*> units[] = {
        {"verify", "in mm"}, {"measure", "kg mm^2"},  {"check", "volume mm^3"}, {"compare", "mm for Z"},
        {"devices", "GiB"},  {"info", "millimetres"}, {"convert", "unit"}};
    for (const auto& [command, unit] : units) CHECK(contains(run({"help", command}).out, unit));
    for (const char* command :
         {"", "view", "shoot", "sample", "verify", "measure", "check", "compare", "devices", "info", "convert"}) {
        const Result help = *command ? run({"help", command}) : all;
        std::istringstream lines(help.out);
        for (std::string line; std::getline(lines, line);) {
            CAPTURE(line);
            CHECK(line.size() <= 100);
        }
    }
}

TEST_CASE("the answer in docs/shoot.md is what shoot answers to its ray and scene", "[promise:shoot]") {
    NEEDS_COMMAND();
    const char* scenes = std::getenv("CSGRT_SCENES");
    const std::string page = scenes ? read_file((fs::path(scenes) / "../docs/shoot.md").string()) : "";
    if (page.empty()) {
        WARN("no docs: skipped");
        return;
    }
    const std::size_t json = page.find("```json\n") + 8;
    const Folder folder;
    const std::string scene = folder.write("balls.json", page.substr(json, page.find("```", json) - json));
    const std::size_t from = page.find("printf -- '") + 11;
    std::string ray = page.substr(from, page.find("\\n'", from) - from);
    const Result result =
        run({"shoot", scene, "--rays", "-", "--reference"}, {.input = folder.write("rays", ray + "\n")});
    REQUIRE(result.status == 0);
    std::size_t lines = 0;
    std::istringstream text(page);
    std::string shown, line;
    while (std::getline(text, line) && !line.starts_with("    # csgrt ")) {
    }
    std::istringstream answer(result.out);
    do {
        shown = line.substr(4);
        REQUIRE(std::getline(answer, line));
        if (!shown.starts_with("#")) CHECK(line == shown);
        ++lines;
    } while (std::getline(text, line) && line.starts_with("    "));
    CHECK(lines == 8);
    CHECK(!std::getline(answer, line));
}

TEST_CASE("bounds are told in words where there are none", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    struct Case {
        std::string scene;
        const char *info, *box;
    };
    const std::string nothing =
        R"("r": {"region": true, "tree": {"intersection": ["b", {"object": "b", "translate": [9, 0, 0]}]}})";
    const Case cases[] = {
        {scene_of(half, R"("r": {"region": true, "tree": "h"})"), "bounds    unbounded", "# box unbounded"},
        {scene_of(ball, nothing), "bounds    empty", "# box empty"},
        {scene_of(ball), "bounds    -2 -2 -2 to 2 2 2 mm", "# box -2 -2 -2 2 2 2"},
        {scene_of(std::string(half) + ", " + ball), "bounds    -2 -2 -2 to 2 2 2 mm, and 1 unbounded region",
         "# box -2 -2 -2 2 2 2"},
    };
    const std::string rays = folder.write("rays", "0 0 -9 0 0 1\n");
    for (const Case& each : cases) {
        const std::string scene = folder.write("scene.json", each.scene);
        CAPTURE(each.scene);
        CHECK(line_with(run({"info", scene}).out, "bounds") == each.info);
        CHECK(line_with(run({"shoot", scene, "--rays", rays, "--reference"}).out, "# box") == each.box);
    }
}

TEST_CASE("whatever is misspelt gets the nearest name", "[promise:refusals]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), rays = folder.write("rays", "0 0 -9 0 0 1\n");
    const std::pair<std::vector<std::string>, const char*> mistakes[] = {
        {{scene, "letf.r", "--reference", "--stats", "-"}, "did you mean 'left.r'?"},
        {{"shoot", scene, "rihgt.r", "--rays", rays, "--reference"}, "did you mean 'right.r'?"},
        {{"verify", scene, "al.g", "--reference"}, "did you mean 'all.g'?"},
        {{"info", scene, "hole"}, "did you mean 'hole.s'?"},
        {{"info", folder / "bals.asc"}, "did you mean 'balls.asc'?"},
        {{"convrt", scene, "a.json"}, "did you mean 'convert'?"},
        {{scene, "--azimut", "5", "--stats", "-"}, "did you mean '--azimuth'?"},
        {{"info", folder.write("a.json", R"({"csgrt": 1, "soilds": {}})")}, "did you mean 'solids'?"},
    };
    for (const auto& [words, near] : mistakes) {
        const Result result = run(words);
        CAPTURE(words, result.err);
        CHECK(result.status != 0);
        CHECK(contains(result.err, near));
    }
}

TEST_CASE("a number too small is 0 and one too large an error, in every reader in the same words", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ball.json", scene_of(ball));
    const auto sphere = [](const std::string& number) {
        return scene_of(R"("b": {"type": "sphere", "center": [)" + number + R"(, 0, 0], "radius": 2})");
    };
    const auto v5 = [](const std::string& number) {
        return "title x\nunits mm\nput b.s ell V {" + number + " 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n";
    };
    const auto v4 = [](const std::string& number) {
        return "I 0 v4\nx\nS 19 b.s 19 " + number + " 0 0 2 0 0 0 2 0 0 0 2 0 0 0 0 0 0 0 0 0 0 0 0\n";
    };
    const std::string zeros(400, '0');
    for (const std::string& small :
         {std::string("1e-400"), std::string("-1e-400"), "0." + zeros + "1e5", std::string("1e-99999999999999999999"),
          std::string("4e-324"), std::string("2e-310")}) {
        CAPTURE(small);
        CHECK(run({"info", folder.write("a.json", sphere(small))}).status == 0);
        CHECK(run({"info", folder.write("b.asc", v5(small))}).status == 0);
        CHECK(run({"info", folder.write("c.asc", v4(small))}).status == 0);
        const Result ray =
            run({"shoot", scene, "--rays", folder.write("rays", small + " 0 -9 0 " + small + " 1\n"), "--reference"});
        CHECK(contains(ray.out, "\n/b 7 11 "));
    }
    for (const std::string& large :
         {std::string("1e400"), std::string("-1e400"), "1" + zeros, "0.0001e" + std::string("99999999999999999999")}) {
        const std::string said = "the number " + large.substr(0, 40);
        CAPTURE(large);
        for (const auto& [name, text] :
             {std::pair{"a.json", sphere(large)}, {"b.asc", v5(large)}, {"c.asc", v4(large)}}) {
            const Result result = run({"info", "--strict", folder.write(name, text)});
            CAPTURE(name, result.err);
            CHECK(result.status == 3);
            CHECK(contains(result.err, said));
            CHECK(contains(result.err, " is too large for a double"));
        }
        check_run({"shoot", scene, "--rays", folder.write("rays", large + " 0 -9 0 0 1\n"), "--reference"}, 6,
                  "rays:1:1: ox: " + said);
    }
    const Result zero = run({"shoot", scene, "--rays", folder.write("rays", "0 0 -9 0 0 1e-400\n"), "--reference"});
    CHECK(contains(zero.err, "the direction is 0 0 0"));
}
