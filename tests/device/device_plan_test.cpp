// Who draws by default, and who when somebody is asked for.
#include "device/device_plan.hpp"

#include <algorithm>
#include <filesystem>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "cli/command.hpp"
#include "device/choice.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;

namespace {

constexpr const char* pocl = "Portable Computing Language";

bool has_pocl() {
    const std::vector<FoundDevice> found = find_devices().devices;
    const bool has =
        std::any_of(found.begin(), found.end(), [](const FoundDevice& device) { return device.info.platform == pocl; });
    if (!has) WARN("no PoCL: skipped");
    return has;
}

bool has_native() {
    if (!find_native_devices().empty()) return true;
    WARN("no native device: skipped");
    return false;
}

Settings with_device(const std::string& device) { return {.device = device}; }

}  // namespace

#ifdef __linux__
TEST_CASE("a GPU may be there where a driver has a file to reach it by", "[device]") {
    const command_test::Folder empty;
    CHECK(!may_have_gpu(empty / "nothing"));
    CHECK(!may_have_gpu(empty / ""));
    for (const char* file : {"nvidiactl", "nvidia0", "kfd", "dxg", "dri/renderD128", "dri/renderD130"}) {
        INFO(file);
        const command_test::Folder folder;
        std::filesystem::create_directory(folder / "dri");
        folder.write("dri/card0", "");  // a screen, and nothing that computes
        CHECK(!may_have_gpu(folder / ""));
        folder.write(file, "");
        CHECK(may_have_gpu(folder / ""));
    }
}
#endif

TEST_CASE("without a GPU the native device draws, and nobody takes over", "[device]") {
    if (!has_native() || may_have_gpu()) return;
    const DevicePlan plan = plan_devices({});
    REQUIRE(plan.first.size() == 1);
    CHECK(plan.first[0].info.name == find_native_devices()[0].info.name);
    CHECK(!plan.find_next);
    CHECK(plan.next.empty());
}

TEST_CASE("where a GPU may be the native device draws until one is found", "[device]") {
    if (!has_native()) return;
    {
        const PretendedGpu none("no such platform");
        const DevicePlan plan = plan_devices({});
        CHECK(is_native(plan.first.at(0).info));
        CHECK(plan.is_default);
        CHECK(plan.next == "gpu");
        REQUIRE(plan.find_next);
        CHECK(plan.find_next().empty());
    }
    if (!has_pocl()) return;
    const PretendedGpu gpu(pocl);
    const std::vector<FoundDevice> next = plan_devices({}).find_next();
    REQUIRE(next.size() == 1);
    CHECK(next[0].info.platform == pocl);
    for (const char* choice : {"gpu", "gpus", "pocl", "native,gpu", "native,0"}) {
        INFO(choice);
        Settings settings = with_device(choice);
        const DevicePlan plan = plan_devices(settings);
        CHECK(is_native(plan.first.at(0).info));
        CHECK(!plan.is_default);
        REQUIRE(plan.find_next);
        CHECK(plan.find_next().back().info.platform == pocl);
        CHECK(plan.next.ends_with(next[0].info.name));
        settings.wait_for_device = true;
        const DevicePlan waiting = plan_devices(settings);
        CHECK(waiting.first.back().info.platform == pocl);
        CHECK(!waiting.find_next);
    }
    Settings single;
    single.precision = Precision::single;
    CHECK(plan_devices(single).first.at(0).info.platform == pocl);
    CHECK(!plan_devices(single).find_next);
}

TEST_CASE("a processor that is named draws itself, and a name that is none is refused", "[device]") {
    CHECK_THROWS_AS(plan_devices(with_device("no such device")), Error);
    CHECK_THROWS_AS(plan_devices(with_device("native-no-such-level")), Error);
    if (has_pocl()) {
        const DevicePlan plan = plan_devices(with_device("pocl"));
        CHECK(plan.first.at(0).info.platform == pocl);
        CHECK(!plan.find_next);
    }
    if (!has_native()) return;
    for (const char* choice : {"native", "CPU", "Native"}) {
        INFO(choice);
        const DevicePlan plan = plan_devices(with_device(choice));
        CHECK(plan.first.at(0).info.name == find_native_devices()[0].info.name);
        CHECK(!plan.find_next);
    }
    Settings single = with_device("native");
    single.precision = Precision::single;
    CHECK_THROWS_WITH(plan_devices(single),
                      ContainsSubstring("double precision alone") && ContainsSubstring("--reference"));
}

TEST_CASE("without native devices OpenCL draws by default, and the reference where there is none", "[device]") {
    const NativeTable none(nullptr);
    CHECK(find_native_devices().empty());
    const Discovery found = find_devices();
    const DevicePlan plan = plan_devices({});
    CHECK(plan.is_default);
    CHECK(!plan.find_next);
    if (found.devices.empty()) {
        CHECK(plan.first.empty());
        CHECK(plan.notes.back() == "there is no OpenCL device with double precision");
    } else {
        CHECK(plan.first.at(0).info.name == found.devices[choose_device(infos_of(found.devices), "")].info.name);
    }
}

TEST_CASE("without any device the reference draws, and says so", "[.no_driver][promise:devices]") {
    const NativeTable none(nullptr);
    const Scene scene = load_scene(test::folder("CSGRT_SCENES") + "/operators.json");
    const View view{.width = 24, .height = 16, .camera = scene.camera};
    Renderer renderer(scene);
    CHECK(renderer.statistics().device == "reference");
    const Image image = renderer.render(view);
    REQUIRE(renderer.device_warnings().size() == 1);
    const std::string told = renderer.device_warnings().front().reason;
    CHECK(told.starts_with("no device draws but the CPU reference"));
    CHECK(told.ends_with("there is no OpenCL device with double precision"));
    CHECK(image.attributes.count("csgrt:warnings") == !renderer.model().warnings().empty());
    Settings settings{.reference = true};
    Renderer reference(scene, {}, settings);
    test::require_same(image, reference.render(view));
    CHECK(reference.device_warnings().empty());

    settings = {};
    for (const char* choice : {"native", "pocl", "0", "gpu"}) {
        settings.device = choice;
        CHECK_THROWS_AS(Renderer(scene, {}, settings), Error);
    }
    settings = {};
    settings.precision = Precision::single;
    CHECK_THROWS_WITH(Renderer(scene, {}, settings), ContainsSubstring("pocl-opencl-icd"));
}

TEST_CASE("a picture without a GPU is drawn by the native device, which awaits nobody", "[device]") {
    if (!has_native() || may_have_gpu()) return;
    for (const char* choice : {"", "native", "cpu"}) {
        Renderer renderer(load_scene(test::folder("CSGRT_SCENES") + "/operators.json"), {}, with_device(choice));
        renderer.render({.width = 16, .height = 16, .camera = {}});
        CHECK(renderer.statistics().device.starts_with("native"));
        CHECK(renderer.statistics().awaited_device.empty());
        CHECK(renderer.device_warnings().empty());
    }
}
