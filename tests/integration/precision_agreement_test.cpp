// In every precision that a device has, it gives what the reference gives, to the last bit.
#include "catch.hpp"

#include <algorithm>
#include <cmath>

#include <csgrt/csgrt.hpp>

#include "base/laboratory.hpp"
#include "integration/every_type.hpp"
#include "integration/same_answers.hpp"
#include "integration/scene_of_kinds.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;

namespace {

Settings in_single() {
    Settings settings = test::on_device();
    settings.precision = Precision::single;
    return settings;
}

Settings in_world() { return with_methods({.single_world = true}, test::on_device()); }

// By default every third of our scenes, all in one program, since what an OpenCL compiler takes for each is most of the
// time here. `all`: each in its own.
void require_scenes(const Settings& settings, bool all) {
    const std::vector<std::string> files = test::scene_files();
    for (std::size_t i = 0; i < files.size(); i += all ? 1 : 3) {
        INFO(files[i]);
        std::vector<std::string> objects;
        Scene scene = load_scene(files[i]);
        if (!all) scene = test::with_every_type(std::move(scene), objects);
        test::require_agreement(scene, objects, 64, 200, settings);
    }
}

void require_models(const Settings& settings) {
    for (const test::Model& model : test::models_there()) {
        if (!model.main) continue;
        INFO(model.file);
        test::require_agreement(load_scene(model.file), model.objects, 64, 100, settings);
    }
}

void require_hard_rays(Settings settings) {
    using oracle::Kind;
    std::vector<Ray> rays;
    std::vector<std::string> objects = {"all"};
    const Scene scene = test::with_every_type(
        test::scene_of({Kind::tgc, Kind::tor, Kind::ehy, Kind::eto, Kind::hyp, Kind::superell, Kind::metaball}, rays),
        objects);
    const bool is_world = laboratory(settings).single_world;
    Renderer device(scene, objects, settings);
    settings.reference = true;
    settings.device.clear();
    Renderer reference(scene, objects, settings);
    // From afar, coordinates of the world in float put solids outside their boxes: the device's hierarchy does not see
    // those there.
    const std::vector<Ray> some = is_world ? test::near_only(rays) : rays;
    test::require_same(device.shoot(some), reference.shoot(some));
}

}  // namespace

TEST_CASE("device and reference agree in single precision on our scenes", "[.pocl][agreement][promise:bits]") {
    require_scenes(in_single(), false);
}

TEST_CASE("device and reference agree in single precision on rays that methods fail on", "[.pocl][agreement]") {
    require_hard_rays(in_single());
}

TEST_CASE("device and reference agree in single precision of the world's coordinates", "[.pocl][agreement]") {
    require_scenes(in_world(), false);
    require_hard_rays(in_world());
}

TEST_CASE("device and reference agree in both single precisions, each scene with its own program",
          "[.long][agreement]") {
    for (const Settings& settings : {in_single(), in_world()}) {
        require_scenes(settings, true);
        require_models(settings);
    }
}

TEST_CASE("contraction changes last digits and no region", "[.pocl][agreement]") {
    const std::string folder = test::folder("CSGRT_SCENES");
    if (folder.empty()) return;
    const Scene scene = load_scene(folder + "/solids.json");
    Renderer plain(scene, {}, test::on_device()),
        contracted(scene, {}, with_methods({.contraction = true}, test::on_device()));
    const std::vector<Ray> rays = test::random_rays(plain.model().bounds(), 2000);
    const auto a = plain.shoot(rays), b = contracted.shoot(rays);
    std::size_t other_regions = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto same_region = [](const Partition& p, const Partition& q) { return p.region == q.region; };
        if (!std::equal(a[i].partitions.begin(), a[i].partitions.end(), b[i].partitions.begin(), b[i].partitions.end(),
                        same_region)) {
            ++other_regions;
            continue;
        }
        for (std::size_t k = 0; k < a[i].partitions.size(); ++k)
            farthest = std::fmax(farthest, std::fabs(a[i].partitions[k].in - b[i].partitions[k].in));
    }
    CHECK(other_regions <= 2);
    CHECK(farthest > 0);  // in millimetres of some hundred: a few units in the last place
    CHECK(farthest < 1e-6);
}
