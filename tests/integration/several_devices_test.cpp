// Several devices share a frame, or a list of rays: the same bits as from one. In a process of its own, which PoCL
// shows the processor twice (POCL_DEVICES).
#include "catch.hpp"

#include <atomic>

#include <csgrt/csgrt.hpp>

#include "device/device_plan.hpp"
#include "pipeline/scheduling/device_group.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "reference/reference.hpp"

using namespace csgrt;

namespace {

/// The numbers under which PoCL shows the processor.
std::vector<std::string> pocl_numbers() {
    std::vector<std::string> numbers;
    const std::vector<DeviceInfo> found = devices();
    for (std::size_t i = 0; i < found.size(); ++i)
        if (is_pocl(found[i])) numbers.push_back(std::to_string(i));
    REQUIRE(numbers.size() == 2);
    return numbers;
}
std::string one_pocl() { return pocl_numbers()[0]; }
std::string both_pocls() { return pocl_numbers()[0] + "," + pocl_numbers()[1]; }

}  // namespace

TEST_CASE("two devices give what one gives", "[.two_devices][promise:bits]") {
    const std::string folder = test::folder("CSGRT_SCENES");
    REQUIRE(!folder.empty());
    for (const char* file : {"/operators.json", "/overlap.json"}) {
        INFO(file);
        const Scene scene = load_scene(folder + file);
        Settings settings{.device = one_pocl()};
        Renderer one(scene, {}, settings);
        settings.device = both_pocls();
        Renderer two(scene, {}, settings);
        CHECK(two.statistics().device == one.statistics().device + " + " + one.statistics().device);
        for (const bool every : {false, true}) {
            View view;
            view.width = 203;  // tiles at the edges, and parts that begin within a row
            view.height = 157;
            view.every_partition = every;
            test::require_same(one.render(view), two.render(view));
            CHECK(one.statistics().segments == two.statistics().segments);
            CHECK(one.statistics().partitions_used == two.statistics().partitions_used);
            CHECK(two.statistics().batches > 2);
        }
        const std::vector<Ray> rays = test::random_rays(one.model().bounds(), 3000);
        test::require_same(one.shoot(rays), two.shoot(rays));
        CHECK(one.statistics().ends == two.statistics().ends);
    }
}

TEST_CASE("a native device shares a frame with another", "[.two_devices]") {
    const Scene scene = load_scene(test::folder("CSGRT_SCENES") + "/overlap.json");
    Settings settings{.device = one_pocl()};
    Renderer one(scene, {}, settings);
    settings.device = "native," + one_pocl();
    Renderer two(scene, {}, settings);
    View view{.width = 203, .height = 157};
    test::require_same(one.render(view), two.render(view));
    CHECK(two.statistics().device.find(" + " + one.statistics().device) != std::string::npos);
}

TEST_CASE("two devices: an interrupted frame, and the next one", "[.two_devices]") {
    const std::string folder = test::folder("CSGRT_SCENES");
    std::atomic<bool> go_on{false};
    std::atomic<int> told{0};
    double last = 0;
    Settings settings{.device = both_pocls()};
    settings.progress = [&](double fraction) {
        ++told;
        last = std::max(last, fraction);
        return go_on || told < 2;
    };
    Renderer renderer(load_scene(folder + "/overlap.json"), {}, settings);
    View view;
    view.width = view.height = 512;  // takes longer than 20 ms
    CHECK_THROWS_AS(renderer.render(view), Error);
    go_on = true;
    renderer.render(view);
    CHECK(last == 1);
}

TEST_CASE("two devices read a picture back asynchronously", "[.two_devices]") {
    // Its memory is registered to them, or not.
    const bool is_registered = GENERATE(false, true);
    const Scene scene = load_scene(test::folder("CSGRT_SCENES") + "/overlap.json");
    Settings settings{.device = one_pocl()};
    Renderer one(scene, {}, settings);
    settings.device = both_pocls();
    const CompiledScene compiled = compile(scene, {});
    const auto records = make_converter(compiled, settings);
    DeviceGroup two(plan_devices(settings).first, compiled, *records, settings, Readback::asynchronous);
    View view{.width = 301, .height = 257, .channels = channel::color | channel::ids};
    Channels pixels(301 * 257, std::vector<float>(6));
    std::vector<ChannelMemory> planes;
    const PreparedFrame any = prepare_frame(compiled, view, one.statistics().tolerance);
    for (std::size_t p = 0; p < 6; ++p) planes.push_back({pixels[p].data(), p < 4 ? any.frame.background[p] : 0});
    std::vector<std::uint8_t> drawn(38 * 33, 1);
    std::shared_ptr<RegisteredMemory> registered;
    std::uint64_t registered_bytes = 0;
    for (const bool every : {false, true, false})
        for (const double azimuth : {35.0, 100.0}) {
            view.every_partition = every;
            view.camera.azimuth = azimuth;
            PipelineCounts counts;
            two.render(prepare_frame(compiled, view, one.statistics().tolerance),
                       {.channels = planes, .covered = drawn, .registered = registered.get()}, nullptr, counts);
            if (is_registered && !registered) {
                const std::uint64_t before = two.device_bytes();
                registered = two.register_memory(planes, pixels[0].size());
                registered_bytes = two.device_bytes() - before;
                CHECK(registered_bytes == 2 * 6 * pixels[0].size() * sizeof(float));
            }
            CHECK(counts.batches > 2);
            const Image image = one.render(view);
            Image packed = image;
            packed.channels = pixels;
            test::require_same(packed, image);
        }
    if (!is_registered) return;
    const std::uint64_t before = two.device_bytes();
    registered.reset();
    two.register_memory({}, 0);
    const std::uint64_t left = before - two.device_bytes();
    CHECK(left == registered_bytes);
}
