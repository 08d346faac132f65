// In every precision that a device has, it gives what the reference gives, to the last bit.
#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "pipeline/same_answers.hpp"
#include "pipeline/scene_of_kind.hpp"
#include "pipeline/scenes.hpp"

using namespace csgrt;

namespace {

std::vector<Settings> in_single() {
    Settings eye = test::on_device(), world = eye;
    eye.precision = Precision::single;
    world.precision = Precision::single_world;
    return {eye, world};
}

}  // namespace

TEST_CASE("device and reference agree in single precision on our scenes", "[agreement]") {
    const auto files = test::scene_files();
    if (files.empty()) WARN("CSGRT_SCENES names no folder of scenes: nothing compared");
    for (const std::string& file : files)
        for (const Settings& settings : in_single()) {
            INFO(file << " " << name_of(precision_names, settings.precision));
            test::require_agreement(load_scene(file), {}, 64, 200, settings);
        }
}

TEST_CASE("device and reference agree in single precision on BRL-CAD's models", "[agreement]") {
    const std::string folder = test::folder("CSGRT_BRLCAD");
    if (folder.empty()) {
        WARN("CSGRT_BRLCAD names no folder of models: nothing compared");
        return;
    }
    for (const test::Model& model : test::models()) {
        if (!model.main) continue;
        for (const Settings& settings : in_single()) {
            INFO(model.file << " " << name_of(precision_names, settings.precision));
            test::require_agreement(load_scene(folder + "/" + model.file), model.objects, 64, 100, settings);
        }
    }
}

TEST_CASE("device and reference agree in single precision on rays that methods fail on", "[agreement]") {
    using oracle::Kind;
    for (const Kind kind : {Kind::tgc, Kind::tor, Kind::ehy, Kind::eto, Kind::hyp, Kind::superell, Kind::metaball}) {
        std::vector<Ray> rays;
        const Scene scene = test::scene_of(kind, rays);
        for (Settings settings : in_single()) {
            INFO(static_cast<int>(kind) << " " << name_of(precision_names, settings.precision));
            Renderer device(scene, {"all"}, settings);
            settings.reference = true;
            settings.device.clear();
            Renderer reference(scene, {"all"}, settings);
            // From afar, coordinates of the world in float put solids outside their boxes: the device's hierarchy does
            // not see those there.
            const std::vector<Ray> asked = settings.precision == Precision::single ? rays : test::near_only(rays);
            test::require_same(device.shoot(asked), reference.shoot(asked));
        }
    }
}
