// The device and the reference agree to the last bit: every channel of every pixel, every partition of every ray,
// whatever the view and however small the tiles.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "pipeline/scenes.hpp"

using namespace csgrt;

namespace {

void require_same(const Image& a, const Image& b) {
    REQUIRE(a.names == b.names);
    for (std::size_t c = 0; c < a.names.size(); ++c) {
        REQUIRE(a.channels[c].size() == b.channels[c].size());
        std::size_t different = 0, where = 0;
        for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
            if (std::memcmp(&a.channels[c][i], &b.channels[c][i], sizeof(float)) == 0) continue;
            if (different++ == 0) where = i;
        }
        INFO("channel " << a.names[c] << ": first difference at (" << where % static_cast<std::size_t>(a.width) << ", "
                        << where / static_cast<std::size_t>(a.width) << "): " << a.channels[c][where] << " and "
                        << b.channels[c][where]);
        REQUIRE(different == 0);
    }
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same(Vec3 a, Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

void require_same(const std::vector<RayPartitions>& a, const std::vector<RayPartitions>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        INFO("ray " << i);
        REQUIRE(a[i].partitions.size() == b[i].partitions.size());
        for (std::size_t k = 0; k < a[i].partitions.size(); ++k) {
            const Partition &p = a[i].partitions[k], &q = b[i].partitions[k];
            const bool equal = same(p.in, q.in) && same(p.out, q.out) && same(p.in_normal, q.in_normal) &&
                               same(p.out_normal, q.out_normal) && p.region == q.region && p.in_solid == q.in_solid &&
                               p.out_solid == q.out_solid;
            REQUIRE(equal);
        }
        REQUIRE(a[i].overlaps.size() == b[i].overlaps.size());
        for (std::size_t k = 0; k < a[i].overlaps.size(); ++k) {
            const Overlap &p = a[i].overlaps[k], &q = b[i].overlaps[k];
            REQUIRE((same(p.in, q.in) && same(p.out, q.out) && p.regions == q.regions));
        }
    }
}

// Rays from a sphere around the model to points within it, and some from within.
std::vector<Ray> random_rays(const Box& box, int count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto inside = [&] {
        return Vec3{box.low.x + unit(random) * (box.high.x - box.low.x), box.low.y + unit(random) * (box.high.y - box.low.y),
                    box.low.z + unit(random) * (box.high.z - box.low.z)};
    };
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 a = inside(), b = inside();
        const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
        const double back = i % 4 == 0 ? 0 : 10;
        rays.push_back({{a.x - back * d.x, a.y - back * d.y, a.z - back * d.z}, d});
    }
    return rays;
}

/// The device that CSGRT_DEVICE chooses (as --device does), or the default one.
Settings on_device() {
    Settings settings;
    if (const char* choice = std::getenv("CSGRT_DEVICE")) settings.device = choice;
    return settings;
}

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
