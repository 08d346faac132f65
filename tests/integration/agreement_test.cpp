// The device and the reference agree to the last bit: every channel of every pixel, every partition of every ray,
// whatever the view and however small the batches.
#include <csgrt/csgrt.hpp>

#include "stress/families.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "integration/every_type.hpp"
#include "integration/same_answers.hpp"
#include "sanitized.hpp"
#include "integration/scenes.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::on_device;
using test::require_agreement;

namespace {

/// `all`: each with its own program (FewPrograms), as the sanitizers' native device has them without a compiler.
void require_scenes(bool all) {
    const auto files = test::scene_files();
    test::FewPrograms programs;
    for (const std::string& file : files) {
        INFO(file);
        std::vector<std::string> objects;
        Scene scene = load_scene(file);
        if (!all) scene = programs.of(std::move(scene), objects);
        require_agreement(scene, objects, test::sanitized ? 32 : 96, test::tries(500));
    }
    if (!files.empty() && !all) CHECK(programs.own() >= 2);
}

}  // namespace

TEST_CASE("device and reference agree on our scenes", "[agreement][promise:bits]") { require_scenes(test::sanitized); }

TEST_CASE("device and reference agree on our scenes, each with its own program", "[.long][agreement][promise:bits]") {
    require_scenes(true);
}

TEST_CASE("a ray whose segments do not fit the memory budget is an error, not a crash", "[agreement]") {
    const auto files = test::scene_files();
    if (files.empty()) return;
    Settings settings = on_device();
    settings.max_memory = 20'000;
    test::failure(Status::out_of_memory, [&] {
        Renderer(load_scene(files.front()), {}, settings).render({.width = 64, .height = 64, .camera = {}});
        SUCCEED("it fits");
    });
}

// Of whose leaves most are solids that are taken away: they start no term, and first hits looked for them among those
// that do.
TEST_CASE("device and reference agree on a tree that is walked from covered leaf to covered leaf",
          "[agreement][promise:bits][promise:booleans]") {
    const stress::StressScene made = stress::make("deep_trees", 1);
    REQUIRE(compile(made.scene, made.objects).has_large_terms);
    require_agreement(made.scene, made.objects, 48, 500);
}
