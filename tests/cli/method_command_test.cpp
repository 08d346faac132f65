// The options that choose how a scene is computed, and what is said about them afterwards.
#include "cli/command.hpp"

#include <csgrt/image.hpp>

using namespace command_test;

TEST_CASE("--stats and the picture say how it was computed", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const auto stats = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {scene, "all.g", "--reference", "--size", "16", "--stats", "-"});
        const Result result = run(words);
        CHECK(result.status == 0);
        return result.out;
    };
    CHECK(contains(stats({}), "\"tolerance\": 5e-04,\n"));
    CHECK(contains(stats({}), "\"precision\": \"double\""));
    CHECK(contains(stats({"--precision", "single"}), "\"precision\": \"single\""));
    CHECK(contains(stats({"--tolerance", "0.25"}), "\"tolerance\": 0.25,"));
    CHECK(contains(stats({"--tolerance", "none"}), "\"tolerance\": 0,"));
    const std::string relative = stats({"--tolerance", "relative"});
    const double tolerance = std::stod(relative.substr(relative.find("\"tolerance\": ") + 13));
    CHECK((tolerance > 1e-9 && tolerance < 1e-6));  // of a scene between 1 and 1000 mm
#ifdef CSGRT_HAVE_IMAGE
    stats({"--tolerance", "none", "--precision", "single", "-o", folder / "a.exr"});
    const csgrt::Image image = csgrt::read_image(folder / "a.exr");
    CHECK(image.attributes.at("csgrt:precision") == "single");
    CHECK(image.attributes.at("csgrt:method") == "every solid near the ray, unique lists");
    CHECK(contains(image.attributes.at("csgrt:command"), " --precision single --tolerance 0 "));
#endif
}
