// What csgrt does not know, or cannot use, is left out of a database, and said; --strict refuses it.
#include "cli/command.hpp"

using namespace command_test;

namespace {

const std::string odd = std::string(two_balls) +
                        "put odd.s brep V {0 0 0}\n"
                        "put odd.r comb region yes tree {u {l left.s} {l odd.s}}\n"
                        "put cut.r comb region yes tree {- {l right.s} {l odd.s}}\n"
                        "put lone.r comb region yes tree {l odd.s}\n"
                        "put odd.g comb region no tree {u {l odd.r} {u {l cut.r} {l lone.r}}}\n"
                        "put even.r comb region yes tree {l left.s}\n"
                        "put bare.r comb region yes tree {l right.s}\n"
                        "put even.g comb region no tree {u {l even.r} {l bare.r}}\n";

std::string partitions_only(const std::string& text) {
    std::string lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at) + 1;
        std::string line = text.substr(at, end - at);
        if (line.front() != '#' && !line.starts_with("overlap"))
            lines += line.starts_with("ray") ? line : line.substr(line.find(' '));  // less the path
        at = end;
    }
    return lines;
}

}  // namespace

TEST_CASE("a database is drawn without its unknown solids, unless it must be strict", "[promise:databases]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("odd.asc", odd),
                      rays = folder.write("rays", "-50 1 2 1 0 0\n-50 0 0 1 0.01 0\n");

    const Result refused =
        check_run({"shoot", scene, "odd.g", "--rays", rays, "--reference", "--strict"}, 3,
                  "'odd.s' is a solid of type 'brep', which csgrt does not support; used by 'odd.r'");
    CHECK(contains(refused.err, "--skip-unsupported"));

    const Result without = run({"shoot", scene, "even.g", "--rays", rays, "--reference"});
    REQUIRE(without.status == 0);
    CHECK(contains(without.out, "even.r"));
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{}, {"--skip-unsupported"}, {"--strict", "--skip-unsupported"}}) {
        std::vector<std::string> words = {"shoot", scene, "odd.g", "--rays", rays, "--reference"};
        words.insert(words.end(), options.begin(), options.end());
        const Result skipped = run(words);
        REQUIRE(skipped.status == 0);
        CHECK(skipped.err ==
              "csgrt: warning: " + scene +
                  ":9:1: odd.s: left out: a brep is bounded by NURB surfaces, which csgrt does not draw; make a mesh "
                  "(bot) of it with BRL-CAD's `facetize`; used by 'odd.r' (3 times)\n"
                  "csgrt: warning: 1 region without solids left out: /odd.g/lone.r\n");
        CHECK(partitions_only(skipped.out) == partitions_only(without.out));
    }

    const Result nothing = check_run({"shoot", scene, "lone.r", "--rays", rays, "--reference"}, 3, "nothing to render");
    CHECK(contains(nothing.err, "odd.s: left out: a brep"));

    const Result info = run({"info", scene, "odd.g"});
    CHECK(info.status == 0);
    CHECK(contains(info.out, "odd.s: left out: a brep"));
}

TEST_CASE("a scene in JSON with an unknown solid is refused, unless it may be skipped", "[promise:databases]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string database = folder.write("odd.asc", odd), scene = folder / "odd.json";
    REQUIRE(run({"convert", database, scene}).status == 0);
    check_run({"info", scene, "odd.g"}, 3, "'odd.s' is a solid of type 'brep', which csgrt does not support");
    const Result skipped = run({"info", scene, "odd.g", "--skip-unsupported"});
    CHECK(skipped.status == 0);
    CHECK(contains(skipped.out, "odd.s: left out: a brep"));
}

TEST_CASE("info lists every broken object of a database, and what is sound, even if nothing is",
          "[promise:databases]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string broken = std::string(two_balls) +
                               "put flat.s ell V {0 0 0} A {1 0 0} B {0 0 0} C {0 0 1}\n"
                               "put bad.s ell V {0 x 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
                               "put bad.r comb region yes tree {u {l flat.s} {l bad.s}}\n";
    const Result info = run({"info", folder.write("broken.asc", broken)});
    CHECK(info.status == 0);
    CHECK(contains(info.out, "left.r"));
    CHECK(contains(info.out, "flat.s: left out: the axis b has length 0; used by 'bad.r'"));
    CHECK(contains(info.out, "bad.s: left out: 'x' is not a number; used by 'bad.r'"));
    CHECK(contains(info.out, "regions   2"));
    const Result nothing = run({"info", folder / "broken.asc", "bad.r"});
    CHECK(nothing.status == 0);
    CHECK(contains(nothing.out, "compiled  no: there is nothing to render"));
    CHECK(contains(nothing.out, "flat.s: left out"));
    CHECK(run({"info", folder / "broken.asc", "--strict"}).status == 3);
    CHECK(run({"info", folder / "broken.asc", "no.r"}).status == 3);  // a name that the user mistook
    CHECK(run({"info", folder.write("cut.asc", broken + "put open.s ell V {0 0 0")}).status == 3);
}

TEST_CASE("thousands of warnings are counted, not all printed or kept in the picture", "[promise:databases]") {
    NEEDS_COMMAND();
    const Folder folder;
    std::string many = std::string(two_balls) + "put many.r comb region yes tree ";
    for (int i = 0; i < 3000; ++i) many += "{u {l gone" + std::to_string(i) + ".s} ";
    many += "{l left.s}" + std::string(3000, '}') + "\n";
    const std::string scene = folder.write("many.asc", many);
    const Result drawn = check_run({scene, "many.r", "--size", "8", "--reference", "-o", folder / "many.exr"}, 0,
                                   "gone0.s: left out: there is no such object; used by 'many.r'");
    CHECK(contains(drawn.err, "csgrt: 2950 more warnings; 'csgrt info' lists all\n"));
    const std::string picture = read_file(folder / "many.exr");
    CHECK(contains(picture, "csgrt:warnings"));
    CHECK(contains(picture, "gone0.s: left out: there is no such object"));
    CHECK(contains(picture, " more"));
    CHECK(picture.size() < 20'000);
    CHECK(contains(run({"info", scene, "many.r"}).out, "gone2999.s: left out"));
}
