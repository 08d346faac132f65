// csgrt verify: what it says of right answers and of wrong ones.
#include <cstdio>
#include <sstream>

#include "cli/command.hpp"

using namespace command_test;

namespace {

constexpr const char* ball =
    "title {a ball}\n"
    "units mm\n"
    "put ball.s ell V {0 0 0} A {99.7 0 0} B {0 99.7 0} C {0 0 99.7}\n"
    "put ball.r comb region yes id 1001 tree {l ball.s}\n";

/// Rays that graze the ball, within what single precision rounds.
std::string grazing_rays() {
    std::string rays;
    char ray[64];
    for (int i = -20; i < 20; ++i) {
        std::snprintf(ray, sizeof ray, "-200 %.9f 0.0 1 0 0\n", 99.7 + 3e-8 * i);
        rays += ray;
    }
    return rays;
}

constexpr const char* ring =
    "title {a thin ring}\n"
    "units mm\n"
    "put ring.s tor V {0 0 0} H {0 0 1} r_a 100 r_h 1\n"
    "put ring.r comb region yes id 1001 tree {l ring.s}\n";

/// The value of a row of the table.
std::string value(const std::string& table, const std::string& name) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(name + "  ")) return line.substr(line.find_first_not_of(' ', name.size()));
    return {};
}

}  // namespace

TEST_CASE("a scene that the device computes right is verified", "[promise:verify]") {
    NEEDS_COMMAND();
    const Folder folder;
    const Result result = run({"verify", folder.write("balls.asc", two_balls), "all.g", "--rays", "500"});
    CAPTURE(result.out, result.err);
    CHECK(result.status == 0);
    CHECK(result.err.empty());
    CHECK(!contains(value(result.out, "device"), "reference"));
    CHECK(value(result.out, "rays") == "500");
    CHECK(std::stoi(value(result.out, "hits")) > 100);
    CHECK(std::stoi(value(result.out, "decided")) + std::stoi(value(result.out, "ties")) == 500);
    CHECK(value(result.out, "wrong regions") == "0");
    CHECK(value(result.out, "bit differences") == "0");
    CHECK(contains(value(result.out, "most ulps"), "/all.g/"));
}

TEST_CASE("wrong regions are found, and the ray that is printed shows them", "[promise:verify]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ball.asc", ball);
    const std::vector<std::string> how = {"--reference", "--precision", "single"};
    std::vector<std::string> words = {"verify", scene, "--rays", folder.write("grazing", grazing_rays())};
    words.insert(words.end(), how.begin(), how.end());
    const Result result = run(words);
    CHECK(result.status == 8);
    CHECK(std::stoi(value(result.out, "wrong regions")) > 5);
    const std::size_t at = result.out.find("\nwrong on the reference\n  ray ");
    REQUIRE(at != result.out.npos);
    std::istringstream lines(result.out.substr(at + 1));
    std::string line, exact, found;
    std::getline(lines, line);
    std::getline(lines, line);
    const std::string rays = folder.write("rays", line.substr(line.find(": ") + 2) + "\n");
    std::getline(lines, exact);
    std::getline(lines, found);
    CHECK((exact.starts_with("    113 bits: ") && found.starts_with("    found: ")));

    words = {"shoot", scene, "--rays", rays};
    const std::string right = run({"shoot", scene, "--rays", rays, "--reference"}).out;
    words.insert(words.end(), how.begin(), how.end());
    const std::string wrong = run(words).out;
    CHECK(contains(right, "\n/ball.r ") == contains(exact, "/ball.r"));
    CHECK(contains(wrong, "\n/ball.r ") == contains(found, "/ball.r"));
    CHECK(contains(right, "\n/ball.r ") != contains(wrong, "\n/ball.r "));
}

TEST_CASE("a ring is right on rays from far away") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ring.asc", ring);
    std::string far;
    for (int i = 0; i < 40; ++i) far += "-10000000 " + std::to_string(5 * i - 97) + " 0.1 1 0 0\n";
    const std::string rays = folder.write("rays", far);
    CHECK(run({"verify", scene, "--reference", "--rays", rays}).status == 0);
}

TEST_CASE("a ray along a face is a tie, and named", "[promise:verify]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rays = folder.write("rays", "-100 2 0 1 0 0\n-100 2 1 1 0 0\n-100 50 0 1 0 0\n");
    const Result result = run({"verify", scene, "left.r", "--reference", "--rays", rays});
    CHECK(result.status == 0);
    CHECK(value(result.out, "rays") == "3");
    CHECK(value(result.out, "ties") == "2");
    CHECK(value(result.out, "bit differences") == "not compared");
    CHECK(contains(result.out, "a tie, as 2 rays in all\n  ray 0: -100 2 0 1 0 0\n    113 bits: "));
    CHECK(contains(result.out, "    varied: "));
}

TEST_CASE("the same sample gives the same result, as a table and as JSON") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ball.asc", ball), json = folder / "result.json";
    const std::vector<std::string> words = {"verify", scene, "--reference", "--precision", "single", "--threads", "2"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    const Result sampled = with({"--rays", "100"});
    CHECK(!sampled.out.empty());
    CHECK(with({"--rays", "100"}).out == sampled.out);
    CHECK(with({"--rays", "100", "--seed", "2"}).out != sampled.out);
    const std::string rays = folder.write("grazing", grazing_rays());
    CHECK(with({"--rays", rays, "--json", json}).out == with({"--rays", rays}).out);
    const Result printed = with({"--rays", rays, "--json", "-"});
    CHECK(printed.status == 8);
    CHECK(printed.out == read_file(json));
    CHECK(printed.out.starts_with("{\n  \"device\": null,\n  \"precision\": \"single\",\n"));
    CHECK(contains(printed.out, "\n  \"wrong_rays\": [\n    {\"index\": "));
    CHECK(contains(printed.out, "\"on\": \"reference\", \"exact\": ["));
    CHECK(folder.files().size() == 3);
}

TEST_CASE("rays and results that cannot be read or written") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), rays = folder.write("rays", "0 0 0 1 0\n");
    check_run({"verify", scene, "--reference", "--rays", rays, "--json", folder / "out"}, 6, ":1:10: dz is missing");
    CHECK(run({"verify", scene, "--reference", "--rays", folder / "absent"}).status == 6);
    CHECK(run({"verify", scene, "--reference", "--json", folder / "no" + "/out"}).status == 6);
    CHECK(run({"verify", scene, "--reference", "--json", scene}).status == 2);
    CHECK(run({"verify", scene, "nothing.r", "--reference"}).status == 3);
    CHECK(run({"verify", scene, "--device", "none such"}).status == 4);
    CHECK(folder.files().size() == 2);
}
