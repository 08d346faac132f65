// The library for pictures, which the command loads while it draws.
#include "cli/command.hpp"

using namespace command_test;

#ifdef CSGRT_HAVE_IMAGE

namespace {

std::vector<std::string> drawing(const std::string& scene, const std::string& picture) {
    return {scene, "--size", "16", "--reference", "-o", picture};
}

}  // namespace

TEST_CASE("a command that ends while the library for pictures is loaded ends as without it", "[promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("broken.json", "{\"csgrt\": 1,\n \"sloids\": {}}"),
                      picture = folder / "x.png";
    const Result expected = run({"info", scene});
    REQUIRE(expected.status == 3);
    for (int i = 0; i < 20; ++i) {
        const Result result = run(drawing(scene, picture));
        CHECK(result.status == 3);
        CHECK(result.err == expected.err);
    }
    CHECK(!fs::exists(picture));
    CHECK(run({scene, "-o", "x.bmp"}).status == 2);
}

TEST_CASE("a library for pictures that cannot be loaded is an error where the picture is written",
          "[promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder, libraries;
    const std::string scene = folder.write("balls.asc", two_balls), picture = folder / "x.png";
    const fs::path core = fs::absolute(command()).parent_path() / library_name("csgrt");
    REQUIRE(fs::exists(core));
    fs::create_symlink(core, libraries / library_name("csgrt"));
    libraries.write(library_name("csgrt_image"), "no library");
    How how;
    how.environment = {{"LD_LIBRARY_PATH", libraries / ""}};
    const Result result = check_run(drawing(scene, picture), 6, "cannot load the library for pictures: ", how);
    CHECK(contains(result.err, library_name("csgrt_image")));
    CHECK(!fs::exists(picture));
    CHECK(run({"info", scene}, how).status == 0);
}

TEST_CASE("a library for pictures that takes long is waited for, and the wait can be interrupted",
          "[promise:failures]") {
    NEEDS_COMMAND();
    const char* const library = std::getenv("CSGRT_FAIL_LIBRARY");
    if (library == nullptr) return;
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), picture = folder.write("x.png", "old"),
                      held = folder / "held", errors = folder / "err";
    for (const bool interrupts : {true, false}) {
        fs::remove(held);
        const pid_t child = start(drawing(scene, picture), "/dev/null", "/dev/null", errors, 0, {}, 0,
                                  {{"LD_PRELOAD", library}, {"CSGRT_SLOW_LOAD", held}});
        const auto await = [](const auto& there) {
            for (int i = 0; i < 6000 && !there(); ++i) usleep(10'000);
            CHECK(there());
        };
        await([&] { return fs::exists(held); });
        REQUIRE(kill(child, SIGALRM) == 0);  // as if 30 s were over
        await([&] { return contains(read_file(errors), "have not come back from their start for 30 s"); });
        CHECK(read_file(picture) == "old");
        if (interrupts) {
            REQUIRE(kill(child, SIGINT) == 0);
            usleep(100'000);
            kill(child, SIGINT);
        }
        if (!interrupts) fs::remove(held);
        CHECK(wait_for(child) == (interrupts ? 130 : 0));
    }
    CHECK(read_file(picture) != "old");
}

TEST_CASE("the libraries that the one for pictures needs are loaded one by one", "[promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), log = folder / "log";
    How how;
    how.environment = {{"LD_DEBUG", "files"}, {"LD_DEBUG_OUTPUT", log}};
    REQUIRE(run(drawing(scene, folder / "x.png"), how).status == 0);
    // "file=libOpenImageIO_Util.so.2.4 [0];  dynamically loaded by ...", not "needed by"
    std::size_t one_by_one = 0;
    for (const std::string& name : folder.files()) {
        if (!name.starts_with("log")) continue;
        std::ifstream lines(folder / name);
        for (std::string line; std::getline(lines, line);)
            one_by_one += contains(line, "file=libOpenImageIO_Util") && contains(line, "dynamically loaded by");
    }
    CHECK(one_by_one == 1);
}

#endif
