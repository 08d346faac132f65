// Every message about the command line itself: exit status 2, the option named, the nearest one suggested.
#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "thrown.hpp"

using namespace command_test;

namespace {

struct Mistake {
    std::vector<std::string> words;
    const char* said;  ///< part of the message
};

/// What is wrong with a command line; empty if nothing is.
std::string refusal(const std::vector<std::string>& words) {
    return csgrt::test::failure(csgrt::Status::usage, [&] { csgrt::cli::parse_arguments(words); });
}

}  // namespace

TEST_CASE("a wrong command line is refused with what is wrong") {
    const std::string scene = "balls.asc";
    const Mistake mistakes[] = {
        {{scene, "--size", "0", "--stats", "-"}, "--size: '0' is not a size"},
        {{scene, "--size", "32769", "--stats", "-"}, "--size"},
        {{scene, "--size", "10x", "--stats", "-"}, "--size"},
        {{scene, "--size", "-5", "--stats", "-"}, "--size"},
        {{scene, "--size=", "--stats", "-"}, "--size"},
        {{scene, "--size", "--stats", "-"}, "--size: a value is missing: N|WxH"},
        {{scene, "--stats"}, "--stats: a value is missing"},
        {{scene, "--size", "4", "--size", "5", "--stats", "-"}, "--size: given more than once"},
        {{scene, "--azimuth", "inf", "--stats", "-"}, "--azimuth: 'inf' is not an angle"},
        {{scene, "--elevation", "up", "--stats", "-"}, "--elevation: 'up' is not an angle"},
        {{scene, "--perspective", "180", "--stats", "-"}, "--perspective: '180'"},
        {{scene, "--perspective", "-1", "--stats", "-"}, "--perspective: '-1'"},
        {{scene, "--max-memory", "2X", "--stats", "-"}, "--max-memory: '2X'"},
        {{scene, "--max-memory", "0", "--stats", "-"}, "--max-memory: '0'"},
        {{scene, "--device-timeout", "-1", "--stats", "-"}, "--device-timeout: '-1' is not a number of seconds"},
        {{scene, "--check", "0", "--stats", "-"}, "--check: '0' is not a whole number from 1 to"},
        {{scene, "--max-memory", "16777216T", "--stats", "-"}, "--max-memory"},
        {{scene, "--tolerance", "-1", "--stats", "-"}, "--tolerance: '-1'"},
        {{scene, "--tolerance", "surfces", "--stats", "-"}, "did you mean 'surfaces'?"},
        {{scene, "--precision", "dubble", "--stats", "-"}, "did you mean 'double'?"},
        {{scene, "-o", "-", "--format", "epng"}, "did you mean 'png'?"},
        {{scene, "--tolerance", "some", "--stats", "-"}, "--tolerance: 'some' is not a length in millimetres"},
        {{scene, "--precision", "quad", "--stats", "-"}, "--precision: 'quad' is not one of double|single"},
        {{scene, "--repeat", "0", "--stats", "-"}, "--repeat: '0'"},
        {{scene, "--threads", "0", "--stats", "-"}, "--threads: '0'"},
        {{scene, "--device", "cpu", "--reference", "--stats", "-"}, "--device: cannot be combined with --reference"},
        {{scene, "--air=yes", "--stats", "-"}, "--air: takes no value"},
        {{scene, "--siez", "4", "--stats", "-"}, "--siez: no such option\n  did you mean '--size'?"},
        {{"render", scene, "--sampels", "4"}, "--sampels: no such option\n  did you mean '--samples'?"},
        {{scene, "-azimuth", "4", "--stats", "-"}, "did you mean '--azimuth'?"},
        {{scene, "--persp", "4", "--stats", "-"}, "did you mean '--perspective'?"},
        {{scene, "--azimuth", "1e400", "--stats", "-"}, "--azimuth: '1e400' is not an angle"},
        {{scene, "", "--stats", "-"}, "OBJECT: '' is not a name"},
        {{"--stats", "-"}, "SCENE: missing"},
        {{"shot"}, "no command and no file 'shot'\n  did you mean 'shoot'?"},
        {{"help", "devcies"}, "did you mean 'devices'?"},
        {{"help", "zzzzzzz"}, "'csgrt --help' lists the commands"},
        {{"devices", "all"}, "'all' is one argument too many"},
        {{"shoot", scene}, "--rays: missing"},
        {{"shoot", scene, "--rays", "grid:w:4"}, "--rays: 'grid:w:4' is not a file, or a grid such as grid:x:512"},
        {{"shoot", scene, "--rays", "grid:x:32769"}, "--rays: 'grid:x:32769' is not a file, or a grid"},
        {{"shoot", scene, "--rays", "a", "--near", "nan"}, "--near: 'nan' is not a number, inf or -inf"},
        {{"shoot", scene, "--rays", "a", "--format", "numpy"}, "--format: 'numpy' is not one of text|csv|binary|npy"},
        {{"verify"}, "SCENE: missing"},
        {{"verify", scene, "--rays", "0"}, "--rays: '0' is not a number of rays from 1 to 10000000, or a file"},
        {{"verify", scene, "--rays", "10000001"}, "--rays: '10000001' is not a number"},
        {{"verify", scene, "--seed", "-1"}, "--seed: '-1'"},
        {{"measure"}, "SCENE: missing"},
        {{"measure", scene, "--rel-error", "0"}, "--rel-error: '0' is not a number greater than 0"},
        {{"measure", scene, "--time", "-1"}, "--time: '-1' is not a number of seconds, 0 or more"},
        {{"measure", scene, "--rays", "0"}, "--rays: '0' is not a whole number from 1"},
        {{"check"}, "SCENE: missing"},
        {{"check", scene, "--min-depth", "0"}, "--min-depth: '0' is not a length in millimetres greater than 0"},
        {{"check", scene, "--effort", "-1"}, "--effort: '-1' is not a number greater than 0, at most 1000"},
        {{"check", scene, "--effort", "1001"}, "--effort: '1001' is not a number greater than 0, at most 1000"},
        {{"check", scene, "--sede", "1"}, "did you mean '--seed'?"},
        {{"verify", scene, "--precision", "quad"}, "--precision: 'quad' is not one of"},
        {{"compare", scene}, "B: missing"},
        {{"info", scene, "--depth", "many"}, "--depth: 'many'"},
        {{"convert", scene}, "OUT: missing"},
    };
    for (const Mistake& mistake : mistakes) {
        CAPTURE(mistake.words);
        const std::string said = refusal(mistake.words);
        INFO(said);
        CHECK(contains(said, mistake.said));
    }
}

TEST_CASE("a wrong command line exits with 2, and nothing is on standard output", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const Mistake mistakes[] = {
        {{}, "csgrt [render] SCENE [OBJECT...] -o FILE"},
        {{scene}, "nothing to write\n  name a picture with -o FILE.exr"},
        {{scene, "--size", "0", "--stats", "-"}, "--size: '0' is not a size"},
        {{scene, "--siez", "4", "--stats", "-"}, "--siez: no such option\n  did you mean '--size'?"},
        {{"help", "devcies"}, "did you mean 'devices'?"},
        {{"convert", scene, "balls.g"}, "must end in .json"},
    };
    for (const Mistake& mistake : mistakes) {
        const Result result = run(mistake.words);
        CAPTURE(mistake.words, result.err);
        CHECK(result.status == 2);
        CHECK(result.out.empty());
        CHECK(result.err.starts_with("csgrt: error: "));
        CHECK(contains(result.err, mistake.said));
    }
}

TEST_CASE("all mistakes of a command line are told in one run") {
    NEEDS_COMMAND();
    const Result result = run({"--size", "big", "--azimuth", "east", "--colour"});
    CHECK(result.status == 2);
    for (const char* part : {"--size: 'big'", "--azimuth: 'east'", "--colour: no such option", "SCENE: missing"})
        CHECK(contains(result.err, part));
}

TEST_CASE("help lists every option, and every option listed is understood") {
    NEEDS_COMMAND();
    struct Table {
        const char* command;
        std::vector<std::string> options;
    };
    // Commands that trace lists have the same options about the model and the work.
    const auto with_computing = [](std::vector<std::string> own) {
        own.insert(
            own.end(),
            {"--device NAME|cpu|gpu|N", "--reference", "--max-memory SIZE", "--tolerance MM|surfaces|relative|none",
             "--precision double|single", "--wait-for-device", "--device-timeout S", "--check N", "--air", "--strict",
             "--allow-files FOLDER", "--max-instances N", "--skip-unsupported", "--threads N", "-h, --help"});
        return own;
    };
    const Table tables[] = {
        {"render",
         {"-o, --output FILE",
          "--format exr|png",
          "--size N|WxH",
          "--azimuth DEG",
          "--elevation DEG",
          "--perspective DEG",
          "--center X,Y,Z",
          "--view-size MM",
          "--eye X,Y,Z",
          "--look-at X,Y,Z",
          "--up X,Y,Z",
          "--view FILE",
          "--clip AXIS:OFFSET",
          "--hide PATH",
          "--show PATH",
          "--color PATH:R,G,B",
          "--samples N",
          "--device NAME|cpu|gpu|N",
          "--reference",
          "--stats FILE",
          "--repeat N",
          "--max-memory SIZE",
          "--device-timeout S",
          "--check N",
          "--tolerance MM|surfaces|relative|none",
          "--precision double|single",
          "--wait-for-device",
          "--transparent",
          "--edges",
          "--light model|headlight|studio",
          "--display-shading",
          "--air",
          "--strict",
          "--allow-files FOLDER",
          "--max-instances N",
          "--skip-unsupported",
          "--threads N",
          "--first-hit",
          "-h, --help"}},
        {"view",
         {"--open", "--port N", "--address ADDRESS", "--device NAME|cpu|gpu|N", "--reference", "--max-memory SIZE",
          "--tolerance MM|surfaces|relative|none", "--precision double|single", "--device-timeout S", "--air",
          "--strict", "--allow-files FOLDER", "--max-instances N", "--skip-unsupported", "--threads N", "-h, --help"}},
        {"shoot", with_computing({"--rays FILE|grid:AXIS:N", "--near T", "--far T", "--format text|csv|binary|npy",
                                  "-o, --output FILE"})},
        {"sample", with_computing({"--points FILE", "--plane AXIS:OFFSET", "--size N|WxH", "-o, --output FILE"})},
        {"verify",
         {"--rays N|FILE", "--seed N", "--json FILE", "--device NAME|cpu|gpu|N", "--reference", "--max-memory SIZE",
          "--tolerance MM|surfaces|relative|none", "--precision double|single", "--device-timeout S", "--air",
          "--strict", "--allow-files FOLDER", "--max-instances N", "--skip-unsupported", "--threads N", "-h, --help"}},
        {"measure", with_computing({"--rel-error X", "--abs-error MM3", "--time S", "--rays N", "--seed N", "--walls",
                                    "--wall-limit MM", "--grid NX,NY,NZ", "--densities FILE", "--depth N",
                                    "--json FILE", "--csv FILE", "--grid-output FILE"})},
        {"check", with_computing({"--min-depth MM", "--certain MM", "--effort X", "--seed N", "--allow FILE",
                                  "--json FILE", "--junit FILE", "--write-rays FILE"})},
        {"compare", {"--tolerance X", "-h, --help"}},
        {"devices", {"-h, --help"}},
        {"info",
         {"--air", "--strict", "--allow-files FOLDER", "--max-instances N", "--skip-unsupported", "--depth N", "--json",
          "-h, --help"}},
        {"convert", {"--strict", "--allow-files FOLDER", "-h, --help"}},
    };
    for (const Table& table : tables) {
        const std::string name = table.command;
        const Result help = run({"help", name});
        CAPTURE(name);
        REQUIRE(help.status == 0);
        CHECK(help.err.empty());
        std::size_t listed = 0;
        for (std::size_t at = 0; (at = help.out.find("\n  -", at)) != help.out.npos; ++at) ++listed;
        CHECK(listed == table.options.size());
        for (const std::string& option : table.options) {
            CAPTURE(option);
            CHECK(contains(help.out, "\n  " + option));
            const std::string word =
                option.substr(option.find("--"), option.find(' ', option.find("--")) - option.find("--"));
            CHECK(!contains(refusal({name, word}), "no such option"));
        }
        const Result inside = run({name, "--help"});
        CHECK(inside.status == 0);
        CHECK(inside.out == help.out);
    }
}

TEST_CASE("the name of the command render may be left out") {
    NEEDS_COMMAND();
    const std::string page = run({"help", "render"}).out;
    CHECK(run({"scene.json", "-h"}).out == page);
    const Result all = run({"--help"});
    CHECK(all.out.ends_with(page.substr(page.find('\n'))));
    CHECK(run({"-h"}).out == all.out);
    CHECK(run({"help"}).out == all.out);
    for (const char* command : {"render", "view", "shoot", "sample", "verify", "measure", "check", "compare", "devices",
                                "info", "convert", "help"}) {
        CAPTURE(command);
        CHECK(contains(all.out, std::string(command) + (command == std::string("render") ? "] " : " ")));
    }
    CHECK(refusal({"render", "scene.json", "--stats", "-"}).empty());
    CHECK(contains(refusal({"render", "--stats", "-"}), "SCENE: missing"));
}

TEST_CASE("--version prints one line") {
    NEEDS_COMMAND();
    const Result result = run({"--version"});
    CHECK(result.status == 0);
    CHECK(result.out.starts_with("csgrt "));
    CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 1);
}
