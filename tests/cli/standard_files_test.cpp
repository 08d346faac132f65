// Scenes and rays on standard input, and standard files that are closed.
#include "cli/command.hpp"

#include <csgrt/image.hpp>
#include <csgrt/scene_io.hpp>

using namespace command_test;

namespace {

constexpr const char* ball_json =
    R"({"csgrt": 1, "solids": {"b": {"type": "sphere", "center": [0, 0, 0], "radius": 2}}})";

std::string after_name(const std::string& text) { return text.substr(text.find('\n')); }

}  // namespace

TEST_CASE("a scene comes from standard input, its format told by its first bytes", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string asc = folder.write("balls.asc", two_balls), json = folder / "balls.json";
    const std::string rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n0.3 0 -70 0 0.1 1\n");
    REQUIRE(run({"convert", asc, json}).status == 0);
    const std::string v4 =
        folder.write("v4.asc", "I 0 v4\nold\nS 19 b.s 19 0 0 0 2 0 0 0 2 0 0 0 2 0 0 0 0 0 0 0 0 0 0 0 0\n");
    std::vector<std::string> scenes = {asc, json, v4};
    const std::string bom = folder.write("bom.json", "\xEF\xBB\xBF \n" + read_file(json));
    scenes.push_back(bom);
    const char* models = std::getenv("CSGRT_BRLCAD");
    for (const char* name : {"axis.g", "bearing.g"})
        if (models && fs::exists(fs::path(models) / name)) scenes.push_back((fs::path(models) / name).string());
    for (const std::string& scene : scenes) {
        CAPTURE(scene);
        const Result file = run({"shoot", scene, "--rays", rays, "--reference"});
        REQUIRE(file.status == 0);
        const Result piped = run({"shoot", "-", "--rays", rays, "--reference"}, {.input = scene});
        INFO(piped.err);
        CHECK(piped.status == 0);
        CHECK(after_name(piped.out) == after_name(file.out));
        CHECK(piped.out.starts_with("# csgrt "));
    }
    const Result device_file = run({"info", "/dev/stdin"}, {.input = json});
    CHECK(contains(device_file.out, "bounds    -10 -10 -10 to 25 10 10 mm"));
}

TEST_CASE("errors of a scene on standard input name it, with line and column") {
    NEEDS_COMMAND();
    const Folder folder;
    const auto err = [&](const std::string& text) {
        const Result result = run({"info", "-", "--strict"}, {.input = folder.write("scene", text)});
        CHECK(result.status == 3);
        return result.err;
    };
    CHECK(contains(err("{\"csgrt\": 1,\n \"sloids\": {}}"), "standard input:2:2: /sloids: unknown key 'sloids'"));
    CHECK(contains(err("title x\nput a.s ell V {0 0 zero}\n"), "standard input:2:"));
    CHECK(contains(err(""), "standard input:1:1: the file is empty"));
    CHECK(contains(err(std::string("\x76\x01\x00\x00\x00", 5)), "standard input: byte "));
    CHECK(contains(run({"info", "-"}, {.input = folder.write("scene", "\x1f\x8b packed")}).err, "gunzip"));
}

TEST_CASE("files of a scene on standard input are relative to the present folder, which must be allowed",
          "[promise:untrusted]") {
    const Folder folder;
    const std::string text =
        "units mm\nput d.s dsp src f file heights w 2 n 2 sm 0 cut a stom {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}\n";
    folder.write("heights", std::string("\0\5\0\5\0\5\0\5", 8));
    const fs::path before = fs::current_path();
    fs::current_path(folder / ".");
    const csgrt::Scene refused = csgrt::parse_scene(text, "standard input");
    const csgrt::Scene allowed = csgrt::parse_scene(text, "standard input", {.file_folders = {"."}});
    fs::current_path(before);
    REQUIRE(refused.objects.size() == 1);
    const auto& solid = std::get<csgrt::Solid>(refused.objects[0]);
    REQUIRE(std::holds_alternative<csgrt::Unsupported>(solid.shape));
    CHECK(contains(std::get<csgrt::Unsupported>(solid.shape).reason, "may not name"));
    REQUIRE(allowed.objects.size() == 1);
    CHECK(std::holds_alternative<csgrt::Dsp>(std::get<csgrt::Solid>(allowed.objects[0]).shape));
}

TEST_CASE("a scene names files below its own folder, and below those of --allow-files", "[promise:untrusted]") {
    NEEDS_COMMAND();
    const Folder folder;
    for (const char* name : {"models", "models/inside", "cells", "cells2"}) fs::create_directory(folder / name);
    const std::string bytes("\0\5\0\5\0\5\0\5", 8);
    for (const char* name : {"models/own", "models/inside/own", "cells/other", "cells2/other"})
        folder.write(name, bytes);
    fs::create_symlink(folder / "cells/other", folder / "models/link");
    fs::create_directory_symlink(folder / "models", folder / "way");
    const auto model = [](const std::string& file) {
        return "units mm\nput d.s dsp src f file {" + file +
               "} w 2 n 2 sm 0 cut a stom {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}\nput r comb region yes tree {l d.s}\n";
    };
    const auto shown = [&](const std::string& file, std::vector<std::string> more = {}, const char* way = "models") {
        folder.write("models/m.asc", model(file));
        std::vector<std::string> words = {"info", folder / way + "/m.asc"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = run(words);
        INFO(file + "\n" + result.out + result.err);
        CHECK(result.status == 0);
        CHECK(contains(result.out, "solids    1 (dsp 1)") != contains(result.out, "\nwarning "));
        return result.out;
    };
    const auto is_read = [](const std::string& out) { return contains(out, "solids    1 (dsp 1)"); };
    for (const char* file : {"own", "inside/own", "./inside/../own", "../models/own"}) {
        CHECK(is_read(shown(file)));
        CHECK(is_read(shown(file, {}, "way")));
    }
    CHECK(is_read(shown(folder / "models/own")));
    CHECK(is_read(shown(folder / "way/own")));
    for (const std::string& file : {std::string("../cells/other"), std::string("link"), folder / "cells/other"}) {
        CHECK(!is_read(shown(file)));
        CHECK(!is_read(shown(file, {"--allow-files", folder / "cells2"})));
        CHECK(!is_read(shown(file, {"--allow-files", folder / "cell"})));
        CHECK(is_read(shown(file, {"--allow-files", folder / "cells"})));
        CHECK(is_read(shown(file, {"--allow-files", folder / "cells2", "--allow-files", folder / "cells/"})));
    }
    // The same is said whether the file exists or not, and of whatever size it is.
    folder.write("cells/large", bytes + bytes);
    std::string first;
    for (const char* file : {"../cells/other", "../cells/large", "../cells/absen", "../nosuc/absen", "/etc/passwd",
                             "/etc/shadow", "/proc/self/environ"}) {
        std::string said = shown(file);
        const std::size_t begin = said.find(file);
        REQUIRE(begin != said.npos);
        said.erase(0, begin + std::string(file).size());
        said.erase(said.find('\n'));
        CHECK(contains(said, "may not name: allow its folder with --allow-files"));
        if (first.empty()) first = said;
        CHECK(said == first);
    }
    CHECK(contains(shown("absent"), "No such file"));
    CHECK(contains(shown("../cells/absent", {"--allow-files", folder / "cells"}), "No such file"));
    CHECK(contains(shown("../cells/large", {"--allow-files", folder / "cells"}), "has 16 bytes, not 8"));
#ifdef CSGRT_HAVE_IMAGE
    {  // The header's command draws the same again.
        folder.write("models/m.asc", model("../cells/other"));
        const std::string exr = folder / "a.exr", allowed = folder / "cells";
        REQUIRE(
            run({folder / "models/m.asc", "--reference", "--size", "8", "-o", exr, "--allow-files", allowed}).status ==
            0);
        CHECK(contains(csgrt::read_image(exr).attributes.at("csgrt:command"), " --allow-files " + allowed));
    }
#endif
    // Neither convert nor --strict copies what may not be named.
    folder.write("models/m.asc", model("../cells/other"));
    CHECK(!contains(run({"convert", folder / "models/m.asc", "-"}).out, "heights"));
    CHECK(!contains(run({"convert", folder / "models/m.asc", "-", "--strict"}).out, "heights"));
    CHECK(run({"info", folder / "models/m.asc", "--strict"}).status == 3);
    // Standard input and pipes have no folder.
    folder.write("models/m.asc", model(folder / "models/own"));
    const std::vector<std::string> allow = {"info", "-", "--allow-files", folder / "models"};
    CHECK(!is_read(run({"info", "-"}, {.input = folder / "models/m.asc"}).out));
    CHECK(is_read(run(allow, {.input = folder / "models/m.asc"}).out));
    CHECK(!is_read(run({"info", "/dev/stdin"}, {.input = folder / "models/m.asc"}).out));
}

TEST_CASE("scene and rays cannot both be standard input", "[promise:shoot]") {
    NEEDS_COMMAND();
    for (const char* command : {"shoot", "verify"}) {
        check_run({command, "-", "--rays", "-", "--reference"}, 2, "--rays: standard input is taken by SCENE");
    }
}

TEST_CASE("a closed standard input is an error, and no other file is read in its place") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ball.json", ball_json), rays = folder.write("rays", "0 0 -9 0 0 1\n");
    const Result no_rays = check_run({"shoot", scene, "--rays", "-", "--reference"}, 6,
                                     "standard input: cannot read: it is closed", {.closed = {STDIN_FILENO}});
    CHECK(no_rays.out.empty());
    check_run({"info", "-"}, 6, "standard input: cannot be read: it is closed", {.closed = {STDIN_FILENO}});
    CHECK(run({"shoot", scene, "--rays", rays, "--reference"}, {.closed = {STDIN_FILENO}}).status == 0);  // not needed
}

TEST_CASE("output to a closed standard output is not lost in silence, nor written into another file") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("ball.json", ball_json), rays = folder.write("rays", "0 0 -9 0 0 1\n");
    const std::vector<std::vector<std::string>> commands = {
        {"--help"},
        {"--version"},
        {"info", scene},
        {"convert", scene, "-"},
        {"shoot", scene, "--rays", rays, "--reference"},
        {scene, "--reference", "--size", "8", "--stats", "-"},
#ifdef CSGRT_HAVE_IMAGE
        {scene, "--reference", "--size", "8", "-o", "-"},
#endif
    };
    for (const auto& command : commands) {
        CAPTURE(command);
        check_run(command, 6, "standard output: cannot write: it is closed", {.closed = {STDOUT_FILENO}});
    }
    const Result all = run({"shoot", scene, "--rays", rays, "--reference", "-o", folder / "out"},
                           {.closed = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}});
    CHECK(all.status == 0);
    CHECK(read_file(folder / "out").starts_with("# csgrt "));
    CHECK(read_file(scene) == ball_json);
}
