// The device and the reference agree to the last bit on BRL-CAD's models; and so does what the models become.
#include <filesystem>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "integration/every_type.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;
using test::require_agreement;
using test::require_same;
using test::with_every_type;

TEST_CASE("device and reference agree on BRL-CAD's models", "[agreement][promise:bits]") {
    for (const test::Model& model : test::models_there()) {
        INFO(model.file);
        Scene scene = load_scene(model.file);
        std::vector<std::string> objects = model.objects;
        if (!model.main) scene = with_every_type(std::move(scene), objects);
        require_agreement(scene, objects, model.main ? 64 : 24, 200);
    }
}

TEST_CASE("the scene of every type has every type", "[agreement][promise:solids]") {
    if (test::folder("CSGRT_SCENES").empty()) return;
    std::vector<std::string> objects;
    const Scene scene = with_every_type(load_scene(test::folder("CSGRT_SCENES") + "/onion.json"), objects);
    CHECK(compile(scene, objects).solid_types == (1u << SOLID_TYPES) - 1);
}

TEST_CASE("device and reference agree on BRL-CAD's models, 512 x 512", "[.long][agreement][promise:bits]") {
    for (const test::Model& model : test::models_there()) {
        INFO(model.file);
        require_agreement(load_scene(model.file), model.objects, 512, 20000);
    }
}

TEST_CASE("a model gives the same picture from .asc, from .g and from the .json that they become",
          "[agreement][promise:round-trip]") {
    const std::string converted = (std::filesystem::temp_directory_path() / "csgrt_converted.json").string();
    const auto picture = [](const Scene& scene, const std::vector<std::string>& objects) {
        Settings settings{.reference = true};
        return Renderer(scene, objects, settings).render({.width = 24, .height = 24, .camera = scene.camera});
    };
    for (const test::Model& model : test::models_there()) {
        INFO(model.file);
        const Scene text = load_scene(model.file),
                    binary = load_scene(model.file.substr(0, model.file.size() - 3) + "g");
        const Image expected = picture(text, model.objects);
        require_same(picture(binary, model.objects), expected);
        for (const Scene* scene : {&text, &binary}) {
            save_scene(*scene, converted);
            require_same(picture(load_scene(converted), model.objects), expected);
        }
    }
    std::filesystem::remove(converted);
}
