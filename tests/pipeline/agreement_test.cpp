// The device and the reference agree to the last bit: every channel of every pixel, every partition of every ray,
// whatever the view and however small the tiles.
#include <cstring>
#include <filesystem>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "pipeline/same_answers.hpp"
#include "pipeline/scenes.hpp"

using namespace csgrt;
using test::on_device;
using test::random_rays;
using test::require_same;

namespace {

void require_agreement(const Scene& scene, const std::vector<std::string>& objects, int size, int rays) {
    Settings by_reference;
    by_reference.reference = true;
    Renderer reference(scene, objects, by_reference);
    Renderer device(scene, objects, on_device());
    const std::uint64_t scene_bytes = [&] {
        device.render({.width = 8, .height = 8, .camera = {}});
        return device.statistics().device_bytes;
    }();
    Settings little = on_device();
    little.max_memory = scene_bytes + 400'000;  // some dozen tiles
    Renderer tiled(scene, objects, little);
    for (const double perspective : {0.0, 40.0}) {
        View view;
        view.width = size;
        view.height = size;
        view.camera = scene.camera;
        view.camera.perspective = perspective;
        INFO("perspective " << perspective);
        const Image expected = reference.render(view);
        require_same(device.render(view), expected);
        require_same(tiled.render(view), expected);
        if (expected.width >= 64) CHECK(tiled.statistics().tiles > 1);
        CHECK(device.statistics().segments == reference.statistics().segments);
        CHECK(device.statistics().partitions_used == reference.statistics().partitions_used);
        CHECK(device.statistics().overlaps == reference.statistics().overlaps);
        view.every_partition = false;
        const Image first = device.render(view);
        require_same(first, reference.render(view));
        for (std::size_t c = 0; c + 1 < expected.names.size(); ++c)  // all but the last, `overlap`
            CHECK(std::memcmp(first.channels[c].data(), expected.channels[c].data(), first.channels[c].size() * 4) == 0);
    }
    const std::vector<Ray> list = random_rays(reference.bounds(), rays);
    const auto expected = reference.shoot(list);
    require_same(device.shoot(list), expected);
    require_same(tiled.shoot(list), expected);
}

}  // namespace

TEST_CASE("device and reference agree on our scenes", "[agreement]") {
    const auto files = test::scene_files();
    if (files.empty()) WARN("CSGRT_SCENES names no folder of scenes: nothing compared");
    for (const std::string& file : files) {
        INFO(file);
        require_agreement(load_scene(file), {}, 96, 500);
    }
}

TEST_CASE("device and reference agree on BRL-CAD's models", "[agreement]") {
    const std::string folder = test::folder("CSGRT_BRLCAD");
    if (folder.empty()) {
        WARN("CSGRT_BRLCAD names no folder of models: nothing compared");
        return;
    }
    for (const test::Model& model : test::models()) {
        INFO(model.file);
        require_agreement(load_scene(folder + "/" + model.file), model.objects, model.main ? 64 : 24, 200);
    }
}

TEST_CASE("device and reference agree on BRL-CAD's models, 512 x 512", "[.long][agreement]") {
    const std::string folder = test::folder("CSGRT_BRLCAD");
    if (folder.empty()) {
        WARN("CSGRT_BRLCAD names no folder of models: nothing compared");
        return;
    }
    for (const test::Model& model : test::models()) {
        INFO(model.file);
        require_agreement(load_scene(folder + "/" + model.file), model.objects, 512, 20000);
    }
}

TEST_CASE("a model gives the same picture from .asc, from .g and from the .json that they become", "[agreement]") {
    const std::string folder = test::folder("CSGRT_BRLCAD");
    if (folder.empty()) {
        WARN("CSGRT_BRLCAD names no folder of models: nothing compared");
        return;
    }
    const std::string converted = (std::filesystem::temp_directory_path() / "csgrt_converted.json").string();
    const auto picture = [](const Scene& scene, const std::vector<std::string>& objects) {
        Settings settings;
        settings.reference = true;
        return Renderer(scene, objects, settings).render({.width = 24, .height = 24, .camera = scene.camera});
    };
    for (const test::Model& model : test::models()) {
        INFO(model.file);
        const std::string path = folder + "/" + model.file;
        const Scene text = load_scene(path), binary = load_scene(path.substr(0, path.size() - 3) + "g");
        const Image expected = picture(text, model.objects);
        require_same(picture(binary, model.objects), expected);
        for (const Scene* scene : {&text, &binary}) {
            save_scene(*scene, converted);
            require_same(picture(load_scene(converted), model.objects), expected);
        }
    }
    std::filesystem::remove(converted);
}

TEST_CASE("a ray whose segments do not fit the memory budget is an error, not a crash", "[agreement]") {
    const auto files = test::scene_files();
    if (files.empty()) return;
    Settings settings = on_device();
    settings.max_memory = 20'000;
    try {
        Renderer renderer(load_scene(files.front()), {}, settings);
        renderer.render({.width = 64, .height = 64, .camera = {}});
        SUCCEED("it fits");
    } catch (const Error& error) {
        CHECK(error.status() == Status::out_of_memory);
    }
}
