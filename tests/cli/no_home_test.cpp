// Where the command lets PoCL keep compiled kernels.
#include "cli/command.hpp"

using namespace command_test;

namespace {

/// PoCL's cache is below `home`, temporary files are in `temporary`.
How at_home(const std::string& home, const std::string& temporary) {
    How how;
    how.environment = {{"HOME", home}, {"XDG_CACHE_HOME", ""}, {"POCL_CACHE_DIR", ""}, {"TMPDIR", temporary}};
    return how;
}

}  // namespace

TEST_CASE("a home that cannot be written gives a temporary cache, which is gone afterwards", "[promise:process]") {
    NEEDS_COMMAND();
    const Folder folder, temporary;
    const std::string scene = folder.write("balls.asc", two_balls), rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n");
    const How homeless = at_home("/dev/null/none", temporary / "");
    const std::vector<std::string> commands[] = {
        {"devices"}, {scene, "--size", "16", "--stats", "-", "--first-hit"}, {"shoot", scene, "--rays", rays}};
    for (const std::vector<std::string>& words : commands) {
        CAPTURE(words);
        const Result result = run(words, homeless);
        INFO(result.err);
        CHECK(result.status == 0);
        CHECK(!result.out.empty());
        CHECK(temporary.files().empty());
    }
}

TEST_CASE("a command that uses no device looks for no cache") {
    NEEDS_COMMAND();
    const Folder folder, home;
    const std::string scene = folder.write("balls.asc", two_balls);
    const How how = at_home(home / "", folder / "");
    CHECK(run({scene, "--size", "16", "--stats", "-", "--reference"}, how).status == 0);
    CHECK(run({"info", scene}, how).status == 0);
    CHECK(run({"--version"}, how).status == 0);
    CHECK(home.files().empty());
    CHECK(run({"devices"}, how).status == 0);
    CHECK(home.files() == std::vector<std::string>{".cache"});
}
