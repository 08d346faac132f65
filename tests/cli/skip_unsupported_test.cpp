// --skip-unsupported: what csgrt does not know is left out, and said.
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

TEST_CASE("a scene with an unknown solid is refused, or rendered without it") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("odd.asc", odd),
                      rays = folder.write("rays", "-50 1 2 1 0 0\n-50 0 0 1 0.01 0\n");

    const Result refused = run({"shoot", scene, "odd.g", "--rays", rays, "--reference"});
    CHECK(refused.status == 3);
    CHECK(contains(refused.err, "'odd.s' is a solid of type 'brep', which csgrt does not support; used by 'odd.r'"));
    CHECK(contains(refused.err, "--skip-unsupported"));

    const Result skipped = run({"shoot", scene, "odd.g", "--rays", rays, "--reference", "--skip-unsupported"});
    REQUIRE(skipped.status == 0);
    CHECK(skipped.err ==
          "csgrt: left out: odd.s (brep), used by odd.r\n"
          "csgrt: note: 1 region without solids left out: /odd.g/lone.r\n");
    const Result without = run({"shoot", scene, "even.g", "--rays", rays, "--reference"});
    REQUIRE(without.status == 0);
    CHECK(contains(without.out, "even.r"));
    CHECK(partitions_only(skipped.out) == partitions_only(without.out));

    const Result nothing = run({"shoot", scene, "lone.r", "--rays", rays, "--reference", "--skip-unsupported"});
    CHECK(nothing.status == 3);
    CHECK(contains(nothing.err, "nothing to render"));

    const Result info = run({"info", scene, "odd.g", "--skip-unsupported"});
    CHECK(info.status == 0);
    CHECK(contains(info.out, "left out  odd.s (brep), used by odd.r"));
}
