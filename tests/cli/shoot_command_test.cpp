// csgrt shoot: rays in, partitions out, and what it says of rays that are none.
#include <algorithm>
#include <sstream>

#include "cli/command.hpp"

using namespace command_test;

namespace {

constexpr const char* rays =
    "# along x, then beside everything, then from inside\n"
    "-100 0 0  1 0 0   # a comment\n"
    "\n"
    "-100 50 0 1 0 0\r\n"
    "+5\t0 0 0 0 1";

}  // namespace

TEST_CASE("shoot names the line and the limit of a ray that is out of range", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("two balls.asc", two_balls);
    const std::string file =
        folder.write("rays", "-100 0 0 1 0 0\n0 0 0  0 1e260 0\n  2e18 0 0 1 0 0\n0 0 0 0 0 -1e-260\n");
    const Result result =
        check_run({"shoot", scene, "all.g", "--rays", file, "--reference"}, 6,
                  ":2:8: the largest component of its direction is 1e+260, and must be from 1e-250 to 1e+250");
    CHECK(contains(result.err, ":3:3: its origin has the coordinate 2e+18, and 1e+18 mm is the farthest"));
    CHECK(contains(result.err, ":4:7: the largest component of its direction is 1e-260"));
}

TEST_CASE("shoot takes rays behind a byte order mark, and objects by the paths that it prints", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("two balls.asc", std::string("\xEF\xBB\xBF") + two_balls);
    const std::string file = folder.write("rays", "\xEF\xBB\xBF-100 0 0 1 0 0\r\n-100 0 0 1 0 0\n");
    const Result result = run({"shoot", scene, "/all.g/left.r", "--rays", file, "--reference"});
    REQUIRE(result.status == 0);
    CHECK(contains(result.out, "\nray 0 2 0\n/all.g/left.r 90 "));
    CHECK(contains(result.out, "\nray 1 2 0\n/all.g/left.r 90 "));
    check_run({"shoot", scene, "all.g/lefd.r", "--rays", file, "--reference"}, 3,
              "'all.g' has no member 'lefd.r' (in the path 'all.g/lefd.r')\n  did you mean 'left.r'?");
}

TEST_CASE("shoot prints the partitions along each ray", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("two balls.asc", two_balls), file = folder.write("rays", rays);
    const Result result = run({"shoot", scene, "all.g", "--rays", file, "--reference"});
    REQUIRE(result.status == 0);
    CHECK(result.err.empty());
    std::istringstream lines(result.out);
    std::string line;
    std::getline(lines, line);
    CHECK(line.starts_with("# csgrt "));
    CHECK(line.ends_with(" model two\\040balls.asc all.g"));
    std::getline(lines, line);
    CHECK(line == "# rays 3 solids 3 regions 2 useair 0 tol.dist 5e-04");
    std::getline(lines, line);
    CHECK(line == "# box -10 -10 -10 25 10 10");
    std::getline(lines, line);
    CHECK(line == "ray 0 3 1");

    const auto next_words = [&] {
        std::getline(lines, line);
        std::istringstream split(line);
        std::vector<std::string> words;
        for (std::string word; split >> word;) words.push_back(word);
        return words;
    };
    std::vector<std::string> words = next_words();
    REQUIRE(words.size() == 13);
    CHECK(words[0] == "/all.g/left.r");
    CHECK(std::stod(words[1]) == Approx(90));
    CHECK(std::stod(words[2]) == Approx(98));
    CHECK(std::stod(words[3]) == Approx(-1));
    CHECK(words[9] == "left.s");
    CHECK(words[10] == "hole.s");
    CHECK(words[12] == "arb8");
    words = next_words();  // from the hole to the end of the left ball, which keeps the overlap: it came first
    CHECK(words[0] == "/all.g/left.r");
    CHECK(std::stod(words[1]) == Approx(102));
    CHECK(std::stod(words[2]) == Approx(110));
    words = next_words();
    CHECK(words[0] == "/all.g/right.r");
    CHECK(std::stod(words[1]) == Approx(110));
    CHECK(std::stod(words[2]) == Approx(125));
    words = next_words();
    REQUIRE(words.size() == 5);
    CHECK(words[0] == "overlap");
    CHECK(std::stod(words[1]) == Approx(105));
    CHECK(std::stod(words[2]) == Approx(110));
    CHECK(words[3] == "/all.g/left.r");
    CHECK(words[4] == "/all.g/right.r");
    std::getline(lines, line);
    CHECK(line == "ray 1 0 0");
    std::getline(lines, line);
    CHECK(line.starts_with("ray 2 "));
}

TEST_CASE("rays from a pipe and from a file give the same partitions, in a file and on standard output",
          "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), file = folder.write("rays", rays);
    const std::string plain = run({"shoot", scene, "--rays", file, "--reference"}).out;
    REQUIRE(!plain.empty());
    CHECK(run({"shoot", scene, "--rays", "-", "--reference"}, {.input = file}).out == plain);
    const Result written = run({"shoot", scene, "--rays", file, "--reference", "-o", folder / "out.txt"});
    CHECK(written.status == 0);
    CHECK(written.out.empty());
    CHECK(read_file(folder / "out.txt") == plain);
    CHECK(folder.files().size() == 3);
}

TEST_CASE("more rays than one chunk keep their numbers", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    std::string many;
    for (int i = 0; i < 70'000; ++i) many += i == 69'999 ? "-100 0 0 1 0 0\n" : "0 0 500 1 0 0\n";
    const Result result = run({"shoot", scene, "left.r", "--rays", folder.write("many", many), "--reference"});
    REQUIRE(result.status == 0);
    CHECK(contains(result.out, "# rays 70000 "));
    CHECK(contains(result.out, "\nray 69998 0 0\nray 69999 2 0\n"));
    CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 3 + 70'000 + 2);
}

TEST_CASE("lines that are no rays are told with their place, all of them, and nothing is shot",
          "[promise:shoot][promise:untrusted]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string file = folder.write("rays",
                                          "0 0 0 1 0 0\n"
                                          "0 0 0 1 0\n"
                                          "0 0 zero 1 0 0\n"
                                          "0 0 0 1 0 0 7\n"
                                          "1 2 3  0 0 -0\n"
                                          "0 0 inf 1 0 0\n");
    const Result result = run({"shoot", scene, "--rays", file, "--reference", "-o", folder / "out.txt"});
    CHECK(result.status == 6);
    CHECK(result.out.empty());
    for (const char* part : {":2:10: dz is missing", ":3:5: oz: 'zero'", ":4:13: more than six", ":5:8: the direction",
                             ":6:5: oz: 'inf'", "    0 0 zero 1 0 0\n        ^\n"}) {
        CAPTURE(part);
        CHECK(contains(result.err, part));
    }
    CHECK(!fs::exists(folder / "out.txt"));
    CHECK(folder.files().size() == 2);

    check_run({"shoot", scene, "--rays", "-", "--reference"}, 6, "standard input:2:10: dz is missing", {.input = file});
}

TEST_CASE("files of rays that cannot be read, and outputs that cannot be written", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), file = folder.write("rays", rays);
    check_run({"shoot", scene, "--rays", folder / "absent", "--reference"}, 6, "absent: cannot read");
    CHECK(run({"shoot", scene, "--rays", folder / ".", "--reference"}).status == 6);
    check_run({"shoot", scene, "--rays", file, "-o", file, "--reference"}, 2, "would overwrite --rays");
    CHECK(run({"shoot", scene, "--rays", file, "--reference"}, {.output = "/dev/full"}).status == 6);
}

TEST_CASE("a file of rays that is one line without end is refused while it is read") {
    NEEDS_COMMAND();
    const Folder folder;
    check_run({"shoot", folder.write("balls.asc", two_balls), "--rays", "/dev/zero", "--reference"}, 6,
              "/dev/zero: line 1 does not end: no text file");
}
