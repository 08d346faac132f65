// A GPU takes over from the native device between two frames: the same bits before and after. PoCL stands for the GPU.
#include "render/device_takeover.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <future>
#include <thread>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "cli/held_renderer.hpp"
#include "compile/records/converter.hpp"
#include "integration/same_answers.hpp"
#include "stress/parts.hpp"

using namespace csgrt;
using namespace std::chrono_literals;

namespace {

constexpr const char* pocl = "Portable Computing Language";
constexpr auto longest_wait = 240s;  // for PoCL to compile, under a sanitizer, too

std::vector<FoundDevice> pocl_devices() {
    std::vector<FoundDevice> found = find_devices().devices;
    std::erase_if(found, [](const FoundDevice& device) { return device.info.platform != pocl; });
    if (found.size() > 1) found.resize(1);
    return found;
}

bool can_take_over() {
    if (!pocl_devices().empty() && !find_native_devices().empty()) return true;
    WARN("no native device, or no PoCL: skipped");
    return false;
}

View view_from(double azimuth, bool every_partition) {
    View view{.width = 83, .height = 61};
    view.camera.azimuth = azimuth;
    view.every_partition = every_partition;
    return view;
}

/// What a takeover needs of a Renderer.
struct Compiled {
    Scene scene = stress::scene_of_parts(20);
    CompiledScene compiled = compile(scene, {});
    Settings settings;
    std::unique_ptr<RecordConverter> records = make_converter(compiled, settings);

    DevicePlan plan(std::function<std::vector<FoundDevice>()> find_next, bool is_default = true) const {
        DevicePlan made;
        made.first = {find_native_devices().at(0)};
        made.find_next = std::move(find_next);
        made.next = "gpu";
        made.is_default = is_default;
        return made;
    }
    DeviceTakeover::SetUp set_up() const {
        return [this](const std::vector<FoundDevice>& devices) {
            const Readback readback = is_native(devices.at(0).info) ? Readback::by_device : Readback::asynchronous;
            return std::make_unique<DeviceGroup>(devices, compiled, *records, settings, readback);
        };
    }
};

void wait_for_job(const DeviceTakeover& takeover) {
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    while (!takeover.awaited().empty() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
    REQUIRE(takeover.awaited().empty());
}

}  // namespace

TEST_CASE("frames before, while and after a GPU takes over have the same bits", "[promise:devices]") {
    if (!can_take_over()) return;
    const Scene scene = stress::scene_of_parts(20);
    Settings settings{.device = "native"};
    Renderer native(scene, {}, settings);
    const std::string gpu_name = pocl_devices()[0].info.name, native_name = native.statistics().device;
    const bool by_name = GENERATE(false, true);
    const PretendedGpu gpu(pocl);
    settings.device = by_name ? "gpu" : "";
    Renderer renderer(scene, {}, settings);
    CHECK(renderer.statistics().device == native_name);
    const std::vector<Ray> rays = test::random_rays(native.model().bounds(), 300);
    Framebuffer framebuffer;
    for (const bool every : {true, false}) {
        INFO("every partition " << every);
        const Image expected[] = {native.render(view_from(35, every)), native.render(view_from(100, every))};
        int natively = 0, by_gpu = 0;
        const auto end = std::chrono::steady_clock::now() + longest_wait;
        for (int frame = 0; by_gpu < 4 && std::chrono::steady_clock::now() < end; ++frame) {
            renderer.render(view_from(frame % 2 ? 100 : 35, every), framebuffer);
            test::require_same(framebuffer.image(), expected[frame % 2]);
            CHECK(framebuffer.image().attributes == expected[frame % 2].attributes);
            const std::string& device = renderer.statistics().device;
            REQUIRE((device == native_name || device == gpu_name));
            CHECK((device == native_name || natively == frame - by_gpu));  // it does not go back
            ++(device == gpu_name ? by_gpu : natively);
            if (device == native_name) std::this_thread::sleep_for(20ms);  // which the compiler needs more
        }
        CHECK(natively > 0);
        REQUIRE(by_gpu == 4);
        CHECK(renderer.statistics().awaited_device.empty());
    }
    test::require_same(renderer.shoot(rays), native.shoot(rays));
    CHECK(renderer.statistics().device == gpu_name);
    CHECK(renderer.device_warnings().empty());
}

TEST_CASE("where an edit brings a new type of solid, the native device draws until the GPU's kernels know it") {
    if (!can_take_over()) return;
    const std::string gpu_name = pocl_devices()[0].info.name;
    const PretendedGpu gpu(pocl);
    Settings settings{.device = "gpu", .wait_for_device = true};
    const View view = view_from(35, false);
    Scene scene;
    scene.objects.push_back(Solid{"ball", Ell{{}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {}});
    scene.objects.push_back(Combination{.name = "part.r", .tree = tree("ball"), .region = true});
    const auto with_ring = [](const csgrt::Model& model) {
        return Edit(model)
            .add(Solid{"ring", Tor{{}, {0, 0, 1}, 20, 3}, {}})
            .add("part.r", Operator::union_, "ring")
            .commit();
    };
    const csgrt::Model ball(scene), ring = with_ring(ball);
    Settings on_native{.device = "native"};
    Renderer native(ring, on_native);
    const Image expected = native.render(view);
    Renderer waits(ball, settings);
    waits.set_model(ring);
    test::require_same(waits.render(view), expected);
    CHECK(waits.statistics().device == gpu_name);
    settings.wait_for_device = false;
    Renderer renderer(ball, settings);
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    while (renderer.statistics().device != gpu_name && std::chrono::steady_clock::now() < end) renderer.render(view);
    REQUIRE(renderer.statistics().device == gpu_name);
    while (!renderer.statistics().awaited_device.empty() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(20ms);
    renderer.set_model(Edit(ball).set_color("/part.r", {1, 0, 0}).commit());
    renderer.render(view);
    CHECK(renderer.statistics().device == gpu_name);  // which needs nothing new
    renderer.set_model(ring);
    test::require_same(renderer.render(view), expected);
    CHECK(renderer.statistics().device == native.statistics().device);
    while (renderer.statistics().device != gpu_name && std::chrono::steady_clock::now() < end)
        test::require_same(renderer.render(view), expected);
    CHECK(renderer.statistics().device == gpu_name);
}

TEST_CASE("who waits for a GPU has it from the first frame on", "[promise:devices]") {
    if (!can_take_over()) return;
    const std::string gpu_name = pocl_devices()[0].info.name;
    const Scene scene = stress::scene_of_parts(5);
    const PretendedGpu gpu(pocl);
    for (const char* choice : {"", "gpu"}) {
        INFO("device " << choice);
        Settings settings{.device = choice, .wait_for_device = true};
        Renderer renderer(scene, {}, settings);
        CHECK(renderer.statistics().device == gpu_name);
        for (const bool every : {false, true}) {
            renderer.render(view_from(35, every));
            CHECK(renderer.statistics().device == gpu_name);
            CHECK(renderer.statistics().awaited_device.empty());
        }
    }
}

TEST_CASE("a GPU that fails is a warning, and an error of who named it", "[promise:failures]") {
    if (!can_take_over()) return;
    const Scene scene = stress::scene_of_parts(5);
    const PretendedGpu gpu(pocl, true);
    Settings settings;
    const auto wait = [](Renderer& renderer) {
        const auto end = std::chrono::steady_clock::now() + longest_wait;
        while (!renderer.statistics().awaited_device.empty() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(1ms);
    };
    for (const bool waits : {false, true}) {
        INFO("waits " << waits);
        settings.wait_for_device = waits;
        Renderer renderer(scene, {}, settings);
        wait(renderer);
        for (int frame = 0; frame < 2; ++frame) {
            const Image image = renderer.render(view_from(35, false));
            CHECK(renderer.statistics().device.starts_with("native"));
            REQUIRE(renderer.device_warnings().size() == 1);
            CHECK(renderer.device_warnings().front().reason.find("clCreateContext") != std::string::npos);
            CHECK(image.attributes.count("csgrt:warnings") == !renderer.model().warnings().empty());
        }
    }
    settings.wait_for_device = false;
    settings.device = "gpu";
    Renderer named(scene, {}, settings);
    wait(named);
    for (int call = 0; call < 2; ++call) {
        CHECK_THROWS_WITH(named.render(view_from(35, false)), ContainsSubstring("clCreateContext"));
        CHECK_THROWS_WITH(named.shoot({{{0, 0, 0}, {1, 0, 0}}}), ContainsSubstring("clCreateContext"));
    }
    settings.wait_for_device = true;
    CHECK_THROWS_WITH(Renderer(scene, {}, settings), ContainsSubstring("clCreateContext"));
}

TEST_CASE("the first devices draw what the next have no kernels for yet") {
    if (!can_take_over()) return;
    const Compiled model;
    DeviceTakeover takeover(
        model.plan(pocl_devices), model.set_up(), [](DeviceGroup&) {}, false);
    const std::uint64_t first = takeover.present().number();
    wait_for_job(takeover);  // found and set up, while no call wanted kernels
    CHECK(takeover.drawer(true, model.compiled).number() == first);
    wait_for_job(takeover);
    const std::uint64_t next = takeover.drawer(true, model.compiled).number();
    CHECK(next != first);
    CHECK(takeover.drawer(false, model.compiled).number() == first);
    CHECK(takeover.drawer(false, model.compiled).name().starts_with("native"));
    wait_for_job(takeover);
    CHECK(takeover.drawer(false, model.compiled).number() == next);
    CHECK(takeover.drawer(true, model.compiled).number() == next);
}

TEST_CASE("where no device is found the first ones go on, and nothing was wrong") {
    if (!can_take_over()) return;
    const Compiled model;
    for (const bool waits : {false, true}) {
        std::atomic<int> searches{0};
        DeviceTakeover takeover(
            model.plan([&] {
                ++searches;
                return std::vector<FoundDevice>{};
            }),
            model.set_up(), [](DeviceGroup&) {}, waits);
        wait_for_job(takeover);
        for (const bool every : {true, false, true})
            CHECK(takeover.drawer(every, model.compiled).name().starts_with("native"));
        CHECK(!takeover.take_fault());
        CHECK(searches == 1);
    }
}

TEST_CASE("a fault of drivers is told once, or thrown at every call") {
    if (!can_take_over()) return;
    const Compiled model;
    const auto fail = []() -> std::vector<FoundDevice> {
        throw Error(Status::device_fault, "the driver is broken\nin many words");
    };
    DeviceTakeover by_default(
        model.plan(fail), model.set_up(), [](DeviceGroup&) {}, false);
    wait_for_job(by_default);
    CHECK(by_default.drawer(true, model.compiled).name().starts_with("native"));
    CHECK(by_default.take_fault() == "the GPU cannot be used, the processor draws: the driver is broken");
    CHECK(!by_default.take_fault());
    CHECK(by_default.drawer(false, model.compiled).name().starts_with("native"));

    DeviceTakeover by_name(
        model.plan(fail, false), model.set_up(), [](DeviceGroup&) {}, false);
    wait_for_job(by_name);
    for (const bool every : {true, false})
        CHECK_THROWS_WITH(by_name.drawer(every, model.compiled), Catch::Matchers::StartsWith("the driver is broken"));
    CHECK(!by_name.take_fault());
}

TEST_CASE("a takeover goes when its job has ended, which begins nothing more") {
    if (!can_take_over()) return;
    const Compiled model;
    std::promise<void> begun, found;
    std::atomic<bool> is_gone{false};
    std::atomic<int> set_ups{0};
    auto takeover = std::make_unique<DeviceTakeover>(
        model.plan([&begun, wait = found.get_future().share()] {
            begun.set_value();
            wait.wait();
            return pocl_devices();
        }),
        [&](const std::vector<FoundDevice>& devices) {
            ++set_ups;
            return model.set_up()(devices);
        },
        [](DeviceGroup&) {}, false);
    CHECK(takeover->drawer(true, model.compiled).name().starts_with("native"));
    CHECK(takeover->awaited() == "gpu");
    begun.get_future().wait();  // else it may be left before it begins, and is not waited for
    std::thread leaving([&] {
        takeover.reset();
        is_gone = true;
    });
    std::this_thread::sleep_for(50ms);
    CHECK(!is_gone);
    found.set_value();
    leaving.join();
    CHECK(set_ups == 1);  // the native device
}

TEST_CASE("a Renderer goes while kernels are compiled, and leaves nothing running") {
    if (!can_take_over()) return;
    const PretendedGpu gpu(pocl);
    for (int i = 0; i < 3; ++i) {
        Renderer renderer(stress::scene_of_parts(5), {}, {});
        if (i > 0) renderer.render(view_from(35, i == 1));
    }
}

// In a process of its own, which ends here, with kernels not kept by PoCL, so that they take a second to compile.
TEST_CASE("a command whose picture is drawn does not wait for a compiler", "[.left_at_once]") {
    if (!can_take_over()) {
        std::printf("SKIPPED: no native device, or no PoCL\n");
        return;
    }
    const PretendedGpu gpu(pocl);
    std::atexit([] { std::printf("handlers ran\n"); });
    {
        cli::HeldRenderer renderer(Renderer(stress::scene_of_parts(5)));
        renderer->render(view_from(35, true));
        CHECK(!renderer->statistics().awaited_device.empty());
    }
    std::printf("the picture is drawn\n");
    cli::end_process(0);
    std::printf("it did not end\n");
}

TEST_CASE("a process that awaits no compiler ends as usual") {
    if (find_native_devices().empty()) return;
    Settings settings{.device = "native"};
    {
        cli::HeldRenderer renderer(Renderer(stress::scene_of_parts(5), {}, settings));
        renderer->render(view_from(35, true));
    }
    CHECK(cli::end_process(7) == 7);
}
