// The device and the reference agree to the last bit: every channel of every pixel, every partition of every ray,
// whatever the view and however small the tiles.
#include <bit>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "pipeline/every_type.hpp"
#include "pipeline/same_answers.hpp"
#include "pipeline/scenes.hpp"

using namespace csgrt;
using test::on_device;
using test::require_agreement;

namespace {

// What an OpenCL compiler takes for each program is most of the time here, so by default a scene has its own only if it brings two
// types of solids or more that no program of few types had; the others share that of every type. `all`: each its own.
void require_scenes(bool all) {
    const auto files = test::scene_files();
    if (files.empty()) WARN("CSGRT_SCENES names no folder of scenes: nothing compared");
    std::uint32_t seen = 0;
    int own = 0;
    for (const std::string& file : files) {
        INFO(file);
        Scene scene = load_scene(file);
        std::vector<std::string> objects;
        const std::uint32_t types = compile(scene).solid_types;
        if (all || std::popcount(types & ~seen) >= 2) {
            seen |= types;
            ++own;
        } else {
            scene = test::with_every_type(std::move(scene), objects);
        }
        require_agreement(scene, objects, 96, 500);
    }
    if (!files.empty()) CHECK(own >= 2);
}

}  // namespace

TEST_CASE("device and reference agree on our scenes", "[agreement]") { require_scenes(false); }

TEST_CASE("device and reference agree on our scenes, each with its own program", "[.long][agreement]") { require_scenes(true); }

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
