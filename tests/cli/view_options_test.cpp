// The options of a view: what they say, and what they refuse.
#include <csgrt/image.hpp>

#include "cli/command.hpp"

using namespace command_test;

namespace {

const char* const script = "viewsize 40;\norientation 0.5 0.5 0.5 0.5;\neye_pt 100 0 0;\nstart 0; clean;\nend;\n";

}  // namespace

TEST_CASE("options that say a view twice are refused", "[promise:views]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), view = folder.write("view.rt", script);
    const struct {
        std::vector<std::string> options;
        std::string says;
    } cases[] = {
        {{"--eye", "1,2,3", "--azimuth", "5"}, "--eye: cannot be combined with --azimuth"},
        {{"--eye", "1,2,3", "--elevation", "5"}, "--eye: cannot be combined with --elevation"},
        {{"--center", "1,2,3", "--look-at", "1,2,3"}, "--look-at: cannot be combined with --center"},
        {{"--eye", "1,2,3", "--perspective", "20", "--view-size", "5"}, "--view-size: cannot be combined with --eye"},
        {{"--view", view, "--up", "0,0,1"}, "--up: cannot be combined with --view"},
        {{"--view", view, "--view-size", "3"}, "--view-size: cannot be combined with --view"},
        {{"--eye", "1,2"}, "--eye: '1,2' is not a point"},
        {{"--eye", "1,2,3,4"}, "--eye: '1,2,3,4' is not a point"},
        {{"--eye", "1,,3"}, "--eye: '1,,3' is not a point"},
        {{"--center", "nan,0,0"}, "--center: 'nan,0,0' is not a point"},
        {{"--up", "inf,0,0"}, "--up: 'inf,0,0' is not a direction"},
        {{"--view-size", "0"}, "--view-size: '0' is not a length"},
        {{"--view-size", "nan"}, "--view-size: 'nan' is not a length"},
        {{"--clip", "0,0,0:1"}, "--clip: '0,0,0:1' is not a plane"},
        {{"--hide", "balls"}, "--hide: 'balls' is not the path of a region"},
        {{"--color", "/all.g:1,2,0"}, "--color: '/all.g:1,2,0' is not a path and three numbers"},
        {{"--hide", "/all.g/non.r"}, "--hide: no region is at '/all.g/non.r' or below it"},
        {{"--hide", "/all.g", "--show", "/all"}, "--show: no region is at '/all' or below it"},
        {{"--up", "0,0,0"}, "the direction upward has no length"},
        {{"--eye", "0,0,900", "--look-at", "0,0,0", "--up", "0,0,1"},
         "the direction upward runs along the line of sight"},
        {{"--eye", "9,9,9", "--look-at", "9,9,9"}, "the eye stands at the point that it looks at"},
        {{"--view-size", "1e30"}, "the size of the view is 1e+30 mm"},
    };
    for (const auto& [options, says] : cases) {
        std::vector<std::string> words = {scene, "all.g", "--reference", "--size", "8", "--stats", "-"};
        words.insert(words.end(), options.begin(), options.end());
        check_run(words, 2, says);
    }
    check_run({scene, "all.g", "--reference", "--stats", "-", "--view", folder.write("v", "viewsize x;")}, 3,
              "'x' is not a finite number");
}

#ifdef CSGRT_HAVE_IMAGE
TEST_CASE("the header's command draws the picture of any view again") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), view = folder.write("view.rt", script);
    const auto render = [&](std::vector<std::string> options) {
        const std::string file = folder / "picture.exr";
        std::vector<std::string> words = {scene, "all.g", "--reference", "--size", "16", "-o", file};
        words.insert(words.end(), options.begin(), options.end());
        const Result result = run(words);
        INFO(result.err);
        REQUIRE(result.status == 0);
        return csgrt::read_image(file);
    };
    const std::vector<std::vector<std::string>> views = {
        {"--center", "1,2,-3", "--view-size", "20"},
        {"--eye", "50,-40,30", "--look-at", "1,0,0", "--perspective", "35"},
        {"--eye", "50,-40,30", "--view-size", "12.5"},
        {"--azimuth", "20", "--up", "1,0,5"},
        {"--view", view},
        {"--view", view, "--perspective", "10"},
    };
    for (const auto& options : views) {
        const csgrt::Image image = render(options);
        const std::string text = image.attributes.at("csgrt:command");
        INFO(text);
        std::vector<std::string> words;
        for (std::size_t at = text.find(" --azimuth") == text.npos ? text.find(" --perspective")
                                                                   : text.find(" --azimuth");
             at < text.size();) {
            const std::size_t next = std::min(text.find(' ', at + 1), text.size());
            words.push_back(text.substr(at + 1, next - at - 1));
            at = next;
        }
        CHECK(render(words).channels == image.channels);
    }
    // A plane is where --plane of `csgrt sample` has it, too.
    CHECK(render({"--clip", "0,0,2:1.5"}).channels == render({"--clip", "z:1.5"}).channels);
    CHECK(render({"--clip", "0,0,2:1.5"}).channels != render({"--clip", "z:0.75"}).channels);
    // The saved view is azimuth 0, elevation 0, about the x axis.
    CHECK(render({"--view", view}).channels ==
          render({"--azimuth", "0", "--elevation", "0", "--center", "0,0,0", "--view-size", "40"}).channels);
}
#endif
