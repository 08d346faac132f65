// Files: found by extension, written whole or not at all.
#include "catch.hpp"

#include <filesystem>
#include <fstream>

#include <csgrt/scene_io.hpp>

#include "folder.hpp"
#include "formats/same_scene.hpp"
#include "scene/make_scene.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::Folder;

namespace {

namespace fs = std::filesystem;

Status status_of(const std::function<void()>& action) {
    const test::Thrown thrown = test::thrown_by(action);
    CHECK(thrown.text.empty() == (thrown.status == Status::ok));
    return thrown.status;
}

}  // namespace

TEST_CASE("scene io: what is saved loads to the same scene", "[promise:round-trip]") {
    const Folder folder;
    const Scene scene = make_scene({ball("a", 0.1), combination("c", union_of({"a"}))});
    save_scene(scene, folder / "scene.JSON");
    CHECK(same_scene(load_scene(folder / "scene.JSON"), scene));
    CHECK(folder.files().size() == 1);
}

TEST_CASE("scene io: files that cannot be read") {
    const Folder folder;
    std::ofstream(folder / "scene.step") << "{}";
    fs::create_directory(folder / "folder.json");
    CHECK(status_of([&] { load_scene(folder / "absent.json"); }) == Status::file);
    CHECK(status_of([&] { load_scene(folder / "absent.asc"); }) == Status::file);
    CHECK(status_of([&] { load_scene(folder / "absent.g"); }) == Status::file);
    CHECK(status_of([&] { load_scene(folder / "scene.step"); }) == Status::file);
    CHECK(status_of([&] { load_scene(folder / "folder.json"); }) == Status::file);
    CHECK(status_of([&] { load_scene(""); }) == Status::file);
}

TEST_CASE("scene io: a name with a NUL is no shorter name") {
    using namespace std::string_literals;
    const Folder folder;
    const Scene scene = make_scene({ball("a", 0.1)});
    save_scene(scene, folder / "scene.json");
    CHECK(status_of([&] { load_scene(folder / "scene.json\0.json"s); }) == Status::file);
    CHECK(status_of([&] { save_scene(scene, folder / "other.json\0.json"s); }) == Status::file);
    CHECK(folder.files().size() == 1);
}

TEST_CASE("scene io: a file is replaced whole, or left alone", "[promise:files]") {
    const Folder folder;
    const std::string path = folder / "scene.json";
    std::ofstream(path) << "before";
    Scene scene = make_scene({ball("a", std::numeric_limits<double>::infinity())});
    CHECK(status_of([&] { save_scene(scene, path); }) == Status::scene);
    CHECK(test::read_file(path) == "before");
    scene = make_scene({ball("a")});
    save_scene(scene, path);
    CHECK(test::read_file(path).find("sphere") != std::string::npos);
    CHECK(folder.files().size() == 1);

    CHECK(status_of([&] { save_scene(scene, folder / "absent/scene.json"); }) == Status::file);
    CHECK(status_of([&] { save_scene(scene, folder / "scene.g"); }) == Status::file);
    CHECK(folder.files().size() == 1);
}

TEST_CASE("scene io: a link stays, what it leads to is replaced; a device is written to") {
    const Folder folder;
    const Scene scene = make_scene({ball("a")});
    std::ofstream(folder / "real.json") << "before";
    fs::create_symlink(folder / "real.json", folder / "link.json");
    save_scene(scene, folder / "link.json");
    CHECK(fs::is_symlink(folder / "link.json"));
    CHECK(test::read_file(folder / "real.json").find("sphere") != std::string::npos);
    save_scene(scene, "/dev/null");
    if (fs::exists("/dev/full")) CHECK(status_of([&] { save_scene(scene, "/dev/full"); }) == Status::file);
}
