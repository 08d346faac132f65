// Outputs through links, onto devices and where there is no room: the target is there whole or as it was.
#include <csgrt/image.hpp>
#include <csgrt/scene_io.hpp>

#include "cli/command.hpp"
#include "base/new_file.hpp"

using namespace command_test;

namespace {

/// Each command that writes a file, with its last word the file.
std::vector<std::vector<std::string>> writers(const Folder& folder) {
    const std::string scene = folder.write("balls.asc", two_balls), rays = folder.write("rays", "-100 0 0 1 0 0\n");
    return {
        {"convert", scene, ".json"},
        {"shoot", scene, "--rays", rays, "--reference", "-o", ".txt"},
        {"verify", scene, "--rays", rays, "--reference", "--json", ".txt"},
        {scene, "--reference", "--size", "8", "--stats", ".txt"},
#ifdef CSGRT_HAVE_IMAGE
        {scene, "--reference", "--size", "8", "-o", ".exr"},
        {scene, "--reference", "--size", "8", "-o", ".png"},
#endif
    };
}

}  // namespace

TEST_CASE("every output through a link, or links to links, writes the target and keeps the links", "[promise:files]") {
    NEEDS_COMMAND();
    const Folder folder;
    fs::create_directory(folder / "a");
    fs::create_directory(folder / "b");
    for (std::vector<std::string> words : writers(folder)) {
        const std::string extension = words.back(), target = folder / "b/target" + extension;
        for (const bool dangling : {false, true}) {
            CAPTURE(words, dangling);
            if (!dangling) folder.write("b/target" + extension, "old");
            fs::create_symlink("../b/link" + extension,
                               folder / "a/link" + extension);  // relative to their own folders
            fs::create_symlink("target" + extension, folder / "b/link" + extension);
            words.back() = folder / "a/link" + extension;
            const Result result = run(words);
            INFO(result.err);
            CHECK(result.status == 0);
            CHECK(fs::is_symlink(folder / "a/link" + extension));
            CHECK(fs::is_symlink(folder / "b/link" + extension));
            CHECK(fs::is_regular_file(fs::symlink_status(target)));
            CHECK(read_file(target).size() > 10);
            for (const char* each : {"a", "b"})
                for (const auto& entry : fs::directory_iterator(folder / each)) fs::remove(entry.path());
        }
    }
}

TEST_CASE("a link that leads to itself, to a folder or into none is refused before the work") {
    NEEDS_COMMAND();
    const Folder folder;
    fs::create_symlink("b.json", folder / "a.json");
    fs::create_symlink("a.json", folder / "b.json");
    fs::create_symlink("none/x.json", folder / "c.json");
    fs::create_symlink(".", folder / "d.json");
    const std::string absent = folder / "absent.asc";
    const auto said = [&](const char* name) {
        const Result result = run({"convert", absent, folder / name});
        CHECK(result.status == 6);
        return result.err;
    };
    CHECK(contains(said("a.json"), "is a link that leads to itself"));
    CHECK(contains(said("c.json"), "does not exist"));
    CHECK(contains(said("d.json"), "is a folder"));
}

TEST_CASE("devices, pipes and open files are written into") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string expected = [&] {
        const Result result = run({"convert", folder.write("balls.asc", two_balls), "-"});
        return result.out;
    }();
    const std::string scene = folder / "balls.asc";
    CHECK(run({"convert", scene, "/dev/stdout"}).out == expected);
    CHECK(run({"convert", scene, "/dev/fd/1"}).out == expected);
    fs::create_symlink("/dev/stdout", folder / "out.json");
    CHECK(run({"convert", scene, folder / "out.json"}).out == expected);
    fs::create_symlink("/dev/null", folder / "null.json");
    CHECK(run({"convert", scene, folder / "null.json"}).status == 0);
    CHECK(run({"convert", scene, "/dev/null"}).status == 0);
    CHECK(fs::is_character_file("/dev/null"));
    check_run({"convert", scene, "/dev/full"}, 6, "/dev/full: cannot write: No space left");
    check_run({"convert", scene, "/dev/fd/57"}, 6, "is not open");
#ifdef CSGRT_HAVE_IMAGE
    const auto picture = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {scene, "--reference", "--size", "8"});
        const Result result = run(words);
        INFO(result.err);
        CHECK(result.status == 0);
        return result.out;
    };
    CHECK(picture({"-o", "/dev/stdout", "--format", "png"}) == picture({"-o", "-", "--format", "PNG"}));
    CHECK(picture({"-o", "/dev/stdout"}) == picture({"-o", "-"}));
    CHECK(picture({"-o", "/dev/null"}).empty());
#endif
}

TEST_CASE("where there is no room the old file stays, and nothing beside it", "[promise:files]") {
    NEEDS_COMMAND();
    const Folder folder;
    for (std::vector<std::string> words : writers(folder)) {
        const std::string target = folder.write("target" + words.back(), "old");
        fs::create_symlink("target" + words.back(), folder / "link" + words.back());
        const std::size_t files = folder.files().size();
        words.back() = folder / "link" + words.back();
        CAPTURE(words);
        check_run(words, 6, "cannot write: File too large", {.file_size = 150});
        CHECK(read_file(target) == "old");
        CHECK(folder.files().size() == files);
        fs::remove(words.back());
    }
}

TEST_CASE("a file that is replaced keeps its permissions; one that may not be written is left alone") {
    const Folder folder;
    const std::string file = folder.write("a.json", "old");
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    csgrt::NewFile first(file);
    first.write("new");
    CHECK(read_file(file) == "old");
    first.keep();
    CHECK(read_file(file) == "new");
    CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
    if (geteuid() != 0) {  // root may write anything
        fs::permissions(file, fs::perms::owner_read);
        CHECK_THROWS_AS(csgrt::NewFile(file), csgrt::Error);
    }
    const std::string long_name = folder / std::string(250, 'n');
    csgrt::NewFile second(long_name);
    second.keep();
    CHECK(fs::exists(long_name));
    { csgrt::NewFile forgotten(folder / "b"); }
    CHECK(folder.files().size() == 2);
}
