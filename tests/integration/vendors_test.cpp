// Every device that is there gives the reference's bits: native ones of each level, and those of whatever OpenCL
// drivers are installed. Minutes a device: ctest -C Long -L opencl-vendors (docs/drivers.md). CSGRT_DEVICE names one to
// test alone.
#include "catch.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <csgrt/csgrt.hpp>

#include "device/choice.hpp"
#include "integration/every_type.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "stress/families.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr int picture_size = 128;
constexpr std::uint64_t seeds = 3;  // of each family

int compare_models(const Settings& settings) {
    const std::vector<test::Model> few = models_there(true);
    for (const test::Model& model : few) {
        INFO(model.file);
        require_agreement(load_scene(model.file), model.objects, picture_size, 1000, settings);
    }
    REQUIRE((few.empty() || few.size() == 6));
    return static_cast<int>(few.size());
}

int compare_scenes(const Settings& settings) {
    const std::vector<std::string> files = scene_files();
    FewPrograms programs;
    for (const std::string& file : files) {
        INFO(file);
        std::vector<std::string> objects;
        const Scene scene = programs.of(load_scene(file), objects);
        require_agreement(scene, objects, picture_size, 1000, settings);
    }
    return static_cast<int>(files.size());
}

/// The rays that a stress scene is made for, and its pictures.
void require_stress(const stress::StressScene& made, const Settings& settings) {
    Settings by_reference{.reference = true, .air = made.air};
    Settings by_device = settings;
    by_device.air = made.air;
    Renderer reference(made.scene, made.objects, by_reference), device(made.scene, made.objects, by_device);
    require_same(device.shoot(made.rays), reference.shoot(made.rays));
    for (const bool every : {true, false}) {
        View view{.width = 48, .height = 48, .every_partition = every};
        require_same(device.render(view), reference.render(view));
    }
}

int compare_stress(const Settings& settings) {
    int count = 0;
    for (const std::string& family : stress::families()) {
        for (std::uint64_t i = 0; i < seeds; ++i, ++count) {
            INFO("stress " << family << ' ' << 7 * i + 1);
            require_stress(stress::make(family, 7 * i + 1), settings);
        }
    }
    return count;
}

std::string name_of(std::size_t number, const DeviceInfo& device) {
    return std::to_string(number) + ": " + device.name + " (" + device.platform + ", driver " + device.driver + ")";
}

}  // namespace

TEST_CASE("every driver that is installed can be used", "[.vendors][promise:devices]") {
    std::vector<std::string> notes;
    devices(&notes);
    for (const std::string& note : notes) FAIL_CHECK(note);
}

TEST_CASE("every device gives the reference's bits", "[.vendors][promise:bits]") {
    const std::vector<DeviceInfo> all = devices();
    REQUIRE_FALSE(all.empty());
    const char* name_of_one = std::getenv("CSGRT_DEVICE");
    for (std::size_t number = 0; number < all.size(); ++number) {
        if (name_of_one && number != choose_device(all, name_of_one)) continue;
        // One that differs does not keep the others from their turn.
        DYNAMIC_SECTION(name_of(number, all[number])) {
            const std::string name = name_of(number, all[number]);
            if (!all[number].fp64) {
                std::printf("%s: left out, for it has no double precision\n", name.c_str());
                return;
            }
            std::printf("%s: begins\n", name.c_str());
            std::fflush(stdout);
            using clock = std::chrono::steady_clock;
            const auto start = clock::now();
            const auto seconds = [start] { return std::chrono::duration<double>(clock::now() - start).count(); };
            Settings settings{.device = std::to_string(number), .wait_for_device = true};
            const int models = compare_models(settings);
            const double until_scenes = seconds();
            const int scenes = compare_scenes(settings);
            const double until_stress = seconds();
            const int stress = compare_stress(settings);
            std::printf("%s: the same bits of %d models (%.0f s), %d scenes (%.0f s) and %d stress scenes (%.0f s)\n",
                        name.c_str(), models, until_scenes, scenes, until_stress - until_scenes, stress,
                        seconds() - until_stress);
            std::fflush(stdout);
        }
    }
}
