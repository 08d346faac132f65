// What the numbers of a picture mean stands in its header.
#ifdef CSGRT_HAVE_IMAGE

#include <algorithm>

#include <csgrt/image.hpp>

#include "cli/command.hpp"

using namespace command_test;

TEST_CASE("an EXR names the regions and solids that occur in it, and no others", "[promise:pictures]") {
    NEEDS_COMMAND();
    const Folder folder;
    // 3,000 balls far apart; the view sees a few.
    std::string solids;
    for (int i = 0; i < 3000; ++i)
        solids += (i ? ", \"ball \\\"" : "\"ball \\\"") + std::to_string(i) +
                  "\\\"\": {\"type\": \"sphere\", \"center\": [" + std::to_string(10 * i) + ", 0, 0], \"radius\": 4}";
    const std::string text =
        "{\"csgrt\": 1, \"camera\": {\"azimuth\": -90, \"elevation\": 0, \"center\": [2000, 0, 0], \"size\": 35}, "
        "\"solids\": {" +
        solids + "}}";
    const std::string scene = folder.write("row.json", text), exr = folder / "a.exr";
    for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"--first-hit"}}) {
        std::vector<std::string> words = {scene, "--reference", "--size", "64x64", "-o", exr, "-o", folder / "a.png"};
        words.insert(words.end(), how.begin(), how.end());
        const Result result = run(words);
        INFO(result.err);
        REQUIRE(result.status == 0);
        const csgrt::Image image = csgrt::read_image(exr);
        const std::span<const std::uint32_t> regions = image.ids("region"), solid_numbers = image.ids("solid");
        for (const auto& [channel, attribute, slash] :
             {std::tuple{regions, "csgrt:regions", "/"}, {solid_numbers, "csgrt:solids", ""}}) {
            std::vector<std::uint32_t> numbers(channel.begin(), channel.end());
            std::sort(numbers.begin(), numbers.end());
            numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
            REQUIRE(numbers.size() > 3);
            REQUIRE(numbers.size() < 12);
            const std::string names = image.attributes.at(attribute);
            CHECK(std::count(names.begin(), names.end(), ':') ==
                  static_cast<std::ptrdiff_t>(numbers.size() - 1));  // 0: nothing
            CHECK(names.starts_with("{\""));
            CHECK(names.ends_with("\"}"));
            if (std::string(attribute) == "csgrt:solids") continue;
            for (std::size_t i = 1; i < numbers.size(); ++i) {
                const std::string number = std::to_string(numbers[i]), ball_number = std::to_string(numbers[i] - 1);
                CHECK(contains(names, "\"" + number + "\": \"" + slash + "ball \\\"" + ball_number + "\\\"\""));
            }
        }
        CHECK(image.attributes.at("csgrt:command").size() < 200);
        CHECK(fs::file_size(exr) < 300'000);
        CHECK(!contains(read_file(folder / "a.png"), "csgrt:regions"));
    }
    const Result nothing = run({scene, "--reference", "--size", "1", "--azimuth", "0", "--elevation", "90", "-o", exr});
    REQUIRE(nothing.status == 0);
}

TEST_CASE("an EXR names the pairs of regions that overlap in it", "[promise:pictures]") {
    NEEDS_COMMAND();
    const Folder folder;
    const auto overlaps_of = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--reference", "--size", "40x30", "-o", folder / "a.exr"});
        const Result result = run(words);
        INFO(result.err);
        REQUIRE(result.status == 0);
        const csgrt::Image image = csgrt::read_image(folder / "a.exr");
        const auto found = image.attributes.find("csgrt:overlaps");
        return found == image.attributes.end() ? std::string() : found->second;
    };
    const std::string scene = std::string(std::getenv("CSGRT_SCENES")) + "/overlap.json";
    const std::string bolt = R"(["/overlap/plate.r", "/overlap/bolt.r"])",
                      blocks = R"(["/overlap/left.r", "/overlap/right.r"])";
    CHECK(overlaps_of({scene}) == R"({"count": 2, "pairs": [)" + bolt + ", " + blocks + "]}");
    CHECK(overlaps_of({scene, "--hide", "/overlap/bolt.r"}) == R"({"count": 1, "pairs": [)" + blocks + "]}");
    // From azimuth 0, +x: what lies before the cut is not in the picture.
    const std::vector<std::string> from_x = {scene, "--azimuth", "0", "--elevation", "0", "--perspective", "0"};
    for (const auto& [place, expected] : {std::pair{"0.0", 2}, {"-19", 1}, {"-31", 0}}) {
        std::vector<std::string> words = from_x;
        words.insert(words.end(), {"--clip", std::string("1,0,0:") + place});
        CAPTURE(place);
        CHECK(overlaps_of(words).starts_with("{\"count\": " + std::to_string(expected) + ","));
    }
    CHECK(overlaps_of({scene, "--first-hit"}).empty());

    std::string solids;  // of 25 balls, each overlaps each
    for (int i = 0; i < 25; ++i)
        solids += std::string(i ? "," : "") + "\"" + std::to_string(100 + i) +
                  "\": {\"type\": \"sphere\", \"center\": [0, 0, " + std::to_string(i) + "], \"radius\": 40}";
    const std::string many = overlaps_of({folder.write("balls.json", "{\"csgrt\": 1, \"solids\": {" + solids + "}}")});
    CHECK(many.starts_with(R"({"count": 300, "pairs": [["/100", "/101"], )"));
    CHECK(std::count(many.begin(), many.end(), '[') == 1 + 256);
}

TEST_CASE("a picture without anything names nothing") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene =
        folder.write("away.json",
                     "{\"csgrt\": 1, \"camera\": {\"center\": [900, 0, 0], \"size\": 1}, \"solids\": {\"b\": "
                     "{\"type\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 2}}}");
    REQUIRE(run({scene, "--reference", "--size", "8", "-o", folder / "a.exr"}).status == 0);
    const csgrt::Image image = csgrt::read_image(folder / "a.exr");
    CHECK(image.attributes.at("csgrt:regions") == "{}");
    CHECK(image.attributes.at("csgrt:solids") == "{}");
}

#endif
