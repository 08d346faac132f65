// csgrt SCENE: pictures, figures, and every way in which rendering ends.
#include <algorithm>

#include <csgrt/renderer.hpp>

#include "cli/command.hpp"
#include "sanitized.hpp"

using namespace command_test;

namespace {

/// The keys of a JSON text in their order; good enough for flat texts without escapes.
std::vector<std::string> keys(const std::string& json) {
    std::vector<std::string> found;
    for (std::size_t at = 0; (at = json.find('"', at)) != json.npos;) {
        const std::size_t end = json.find('"', at + 1);
        if (end == json.npos) break;
        if (json.compare(end + 1, 1, ":") == 0) found.push_back(json.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return found;
}

double value(const std::string& json, const std::string& key) {
    return std::stod(json.substr(json.find("\"" + key + "\": ") + key.size() + 4));
}

bool have_device() {
    if (!csgrt::devices().empty()) return true;
    WARN("no device: skipped");
    return false;
}

}  // namespace

TEST_CASE("--stats holds the promised keys in their order") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::vector<std::string> expected = {"device",        "awaited_device",
                                               "precision",     "method",
                                               "tolerance",     "size",
                                               "rays",          "ends",
                                               "segments",      "partitions",
                                               "used",          "allocated",
                                               "overlaps",      "device_bytes",
                                               "segment_bytes", "partition_bytes",
                                               "batches",       "ms",
                                               "load",          "compile",
                                               "build",         "count_segments",
                                               "scan",          "store_segments",
                                               "weave",         "evaluate",
                                               "shade",         "rows",
                                               "cull_tiles",    "first_hits",
                                               "kernels",       "frame",
                                               "write"};
    const Result once = run({scene, "all.g", "--reference", "--size", "40x30", "--stats", "-"});
    REQUIRE(once.status == 0);
    CHECK(once.err.empty());
    CHECK(keys(once.out) == expected);
    CHECK(contains(once.out, "\"size\": [40, 30]"));
    CHECK(value(once.out, "rays") == 1200);
    CHECK(value(once.out, "ends") > 0);
    CHECK(value(once.out, "overlaps") > 0);
    CHECK(value(once.out, "load") > 0);
    CHECK(value(once.out, "frame") > 0);

    const std::string file = folder / "stats.json";
    const Result repeated =
        run({scene, "all.g", "--reference", "--size", "40x30", "--stats", file, "--repeat", "4", "--threads", "2"});
    CHECK(repeated.status == 0);
    CHECK(repeated.out.empty());
    CHECK(repeated.err.empty());
    const std::string json = read_file(file);
    CHECK(keys(json) == expected);
    CHECK(value(json, "segments") == value(once.out, "segments"));
    CHECK(folder.files().size() == 2);
}

TEST_CASE("scenes that cannot be rendered say where they are wrong", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);

    check_run({scene, "all.gg", "--reference", "--stats", "-"}, 3, "all.gg");

    const std::string broken = folder.write("broken.asc", std::string(two_balls) + "put bad.s ell V {0 0 zero}\n");
    check_run({broken, "--reference", "--stats", "-", "--strict"}, 3, "csgrt: error: " + broken + ":9:");

    check_run({broken, "--reference", "--size", "16", "--stats", "-"}, 0, "csgrt: warning: " + broken + ":9:");

    const Result absent = check_run({folder / "absent.json", "--reference", "--stats", "-"}, 6, "absent.json");
    CHECK(absent.out.empty());
}

TEST_CASE("outputs that cannot be written are found before the scene is even read", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), absent = folder / "absent.asc";
    const Result nowhere = check_run({absent, "--reference", "--stats", folder / "none/stats.json"}, 6,
                                     "--stats: " + (folder / "none/stats.json") + ": the folder");
    CHECK(!contains(nowhere.err, "absent.asc"));

    check_run({scene, "--reference", "--stats", scene + "/stats.json"}, 6, "is no folder");

    check_run({scene, "--reference", "--stats", folder / "."}, 6, "is a folder");

    check_run({scene, "--reference", "--stats", folder / "./balls.asc"}, 2, "would overwrite SCENE");
    CHECK(read_file(scene) == two_balls);

    check_run({scene, "--reference", "--size", "8", "--stats", "-"}, 6, "standard output: cannot write",
              {.output = "/dev/full"});

    if (geteuid() != 0) {  // root may write anywhere
        fs::create_directory(folder / "locked");
        fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
        CHECK(run({scene, "--reference", "--stats", folder / "locked/stats.json"}).status == 6);
        fs::permissions(folder / "locked", fs::perms::owner_all);
    }
}

TEST_CASE("a device keeps being a device, a link a link") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), file = folder.write("stats.json", "old");
    CHECK(run({scene, "--reference", "--size", "8", "--stats", "/dev/null"}).status == 0);
    CHECK(fs::is_character_file("/dev/null"));

    fs::create_symlink("stats.json", folder / "link.json");
    CHECK(run({scene, "--reference", "--size", "8", "--stats", folder / "link.json"}).status == 0);
    CHECK(fs::is_symlink(folder / "link.json"));
    CHECK(read_file(file).starts_with("{"));
}

TEST_CASE("a device that is not there exits with 4", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    for (const char* device : {"no such device", "9999"}) {
        const Result result = run({scene, "--device", device, "--stats", "-"});
        CAPTURE(device, result.err);
        CHECK(result.status == 4);
        CHECK(result.out.empty());
    }
}

TEST_CASE("too little device memory exits with 5", "[promise:command][promise:failures]") {
    NEEDS_COMMAND();
    if (!have_device()) return;
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const Result result = run({scene, "--max-memory", "64", "--stats", "-"});
    INFO(result.err);
    CHECK(result.status == 5);
    CHECK(result.out.empty());
}

#ifndef CSGRT_SANITIZED  // these need the address space themselves
TEST_CASE("too little host memory exits with 5", "[promise:command][promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    check_run({scene, "--reference", "--size", "32768", "--stats", "-"}, 5, "memory",
              {.address_space = rlim_t{3} << 30});
}
#endif

TEST_CASE("the listed devices are those of the library", "[promise:devices]") {
    NEEDS_COMMAND();
    if (!have_device()) return;
    const Result result = run({"devices"});
    CHECK(result.status == 0);
    CHECK(contains(result.out, "0  " + csgrt::devices()[0].type + "  " + csgrt::devices()[0].name));
}

#ifdef CSGRT_HAVE_IMAGE

TEST_CASE("one render writes several pictures, whole and nothing beside them") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string exr = folder / "a.exr", png = folder / "a.png", stats = folder / "a.json";
    const Result result =
        run({scene, "all.g", "--reference", "--size", "64x48", "-o", exr, "--output", png, "--stats", stats});
    REQUIRE(result.status == 0);
    CHECK(result.out.empty());
    CHECK(result.err.empty());
    CHECK(folder.files().size() == 4);
    CHECK(read_file(png).starts_with("\x89PNG"));
    CHECK(value(read_file(stats), "write") > 0);
    const csgrt::Image image = csgrt::read_image(exr);
    CHECK(image.width == 64);
    CHECK(image.height == 48);
    CHECK(image.names.size() == 13);
    CHECK(image.attributes.at("csgrt:title") == "two balls");
    CHECK(image.attributes.at("csgrt:command") ==
          "csgrt balls.asc all.g --tolerance 5e-04 --size 64x48 --azimuth 35 --elevation 25 --perspective 0");
    const std::span<const std::uint32_t> regions = image.ids("region");
    CHECK(*std::max_element(regions.begin(), regions.end()) == 2);
}

TEST_CASE("--transparent and --display-shading reach the picture and its header") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), exr = folder / "a.exr";
    const auto draw = [&](std::vector<std::string> options) {
        options.insert(options.end(), {scene, "--reference", "--size", "32", "-o", exr});
        REQUIRE(run(options).status == 0);
        return csgrt::read_image(exr);
    };
    const auto alpha_of_nothing = [](const csgrt::Image& image) {
        return image.channel("A")[0] + 2 * static_cast<float>(image.ids("region")[0]);
    };
    const csgrt::Image usual = draw({}), transparent = draw({"--transparent"}), display = draw({"--display-shading"});
    CHECK(alpha_of_nothing(usual) == 1);
    CHECK(alpha_of_nothing(display) == 1);
    CHECK(alpha_of_nothing(transparent) == 0);
    CHECK(usual.attributes.at("csgrt:shading") == "linear light");
    CHECK(display.attributes.at("csgrt:shading") == "display values");
    CHECK(transparent.attributes.at("csgrt:command").ends_with(" --transparent"));
    CHECK(display.attributes.at("csgrt:command").find(" --display-shading") != std::string::npos);
    CHECK(std::ranges::equal(usual.channel("Z"), display.channel("Z")));
    CHECK_FALSE(std::ranges::equal(usual.channel("R"), display.channel("R")));
}

TEST_CASE("-o - writes the same picture to standard output") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    REQUIRE(run({scene, "--reference", "--size", "32", "-o", folder / "a.exr", "-o", folder / "a.png"}).status == 0);
    CHECK(run({scene, "--reference", "--size", "32", "-o", "-"}).out == read_file(folder / "a.exr"));
    CHECK(run({scene, "--reference", "--size", "32", "-o-", "--format", "png"}).out == read_file(folder / "a.png"));

    CHECK(run({scene, "--reference", "--size", "32", "-o", "-"}, {.output = "/dev/full"}).status == 6);
    check_run({scene, "--reference", "--size", "32", "-o", "-", "--stats", "-"}, 2,
              "standard output is taken by --output");
    check_run({scene, "--reference", "-o", folder / "b.exr", "--format", "png"}, 2, "--format");
}

TEST_CASE("pictures that cannot be written are refused before the render") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    check_run({scene, "--reference", "-o", folder / "a.jpg"}, 2, "a.jpg");
    check_run({scene, "--reference", "-o", folder / "a.exr", "-o", folder / "./a.exr"}, 2,
              "is written by --output already");
    const Result nowhere =
        check_run({scene, "--reference", "-o", folder / "x/a.exr", "-o", folder / "y/a.png"}, 6, "x/a.exr");
    CHECK(contains(nowhere.err, "y/a.png"));
    CHECK(folder.files().size() == 1);
}

TEST_CASE("the options of the camera reach the picture", "[promise:views]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const auto render = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {scene, "all.g", "--reference", "--size", "32", "-o", folder / "a.exr"});
        REQUIRE(run(options).status == 0);
        return csgrt::read_image(folder / "a.exr");
    };
    const csgrt::Image plain = render({});
    CHECK(render({"--azimuth", "35", "--elevation", "25", "--perspective", "0"}).channels == plain.channels);
    CHECK(render({"--azimuth", "-35"}).channels != plain.channels);
    CHECK(render({"--elevation=60"}).channels != plain.channels);
    CHECK(render({"--perspective", "60"}).channels != plain.channels);
    const csgrt::Image first_hit = render({"--first-hit"});
    const std::span<const float> distances = first_hit.channel("Z"), expected = plain.channel("Z");
    CHECK(std::ranges::equal(distances, expected));
    CHECK(!first_hit.has_channel("overlap"));
}

#endif
