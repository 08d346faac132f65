// The way in which pixels come from a GPU, on any device: it makes the same picture as from a processor.
#include "device/compiling_device.hpp"
#include "device/device_plan.hpp"
#include "pipeline/scheduling/pipeline.hpp"

#include <algorithm>
#include <thread>

#include <csgrt/renderer.hpp>

#include "stress/parts.hpp"
#include "catch.hpp"
#include "pipeline/passes/tile_list.hpp"
#include "pipeline/passes/first_hits.hpp"
#include "pipeline/readback/registered_memory.hpp"
#include "pipeline/scheduling/device_group.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "rays/frame.hpp"
#include "reference/reference.hpp"
#include "render/channel_table.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"

using namespace csgrt;

namespace {

/// All rays, so many at a time.
TakeRays ranges_of(std::uint64_t rays, std::uint64_t each) {
    return [=, first = std::uint64_t{0}]() mutable {
        const std::uint64_t begin = first;
        first = std::min(begin + each, rays);
        return RayNumbers{begin, first};
    };
}

/// Amounts of memory from `least` on: a few, or, with CSGRT_FINE (the label pocl), a quarter more each time.
std::vector<std::uint64_t> rooms(std::uint64_t least, std::uint64_t end) {
    std::vector<std::uint64_t> all;
    for (; least < end; least = std::getenv("CSGRT_FINE") ? least + least / 4 : least * (test::sanitized ? 8 : 3))
        all.push_back(least);
    return all;
}

}  // namespace

TEST_CASE("asynchronous: the picture is made, whatever was there before and however many batches there are") {
    Scene scene = stress::scene_of_parts(20);
    scene.background = {0.2, 0, 0.4};
    const bool every_partition = GENERATE(false, true);
    const std::uint64_t room =
        GENERATE(std::uint64_t{0}, std::uint64_t{800'000}, std::uint64_t{5'000});  // beside the scene's
    const bool is_known = GENERATE(false, true);  // the picture's memory, to the device
    INFO("every partition: " << every_partition << ", room " << room << ", known: " << is_known);
    const Settings settings = test::on_compiling_device();
    Renderer renderer(scene, {}, settings);
    const CompiledScene compiled = compile(scene, {});
    const auto records = make_converter(compiled, settings);
    Device first(settings.device);
    const Pipeline needs(first, compiled, *records, settings);
    Device device(settings.device, room ? first.allocated() + room : 0);
    Pipeline pipeline(device, compiled, *records, settings, Readback::asynchronous);

    Framebuffer framebuffer;
    Channels pixels;
    std::vector<std::uint8_t> drawn;
    std::vector<float> background;
    std::uint32_t most_batches = 0;
    std::optional<RegisteredMemory> registered;
    for (const double azimuth : {35.0, 80.0, 200.0}) {
        View view{.width = 77, .height = 61};
        view.camera.azimuth = azimuth;
        view.every_partition = every_partition;
        renderer.render(view, framebuffer);
        const Image& image = framebuffer.image();
        const PreparedFrame prepared = prepare_frame(compiled, view, renderer.statistics().tolerance);
        std::vector<ChannelMemory> planes;
        if (pixels.empty()) {
            pixels = Channels(77 * 61, std::vector<float>(image.channels.size(), -1));
            registered.emplace(pixels[0].data(), pixels.size() * pixels[0].size() * sizeof(float));
            drawn.assign(10 * 8, 1);
            background.assign(image.channels.size(), 0);
            std::ranges::copy(prepared.frame.background, background.begin());
            background[4] = std::numeric_limits<float>::infinity();
        }
        for (std::size_t p = 0; p < pixels.size(); ++p) planes.push_back({pixels[p].data(), background[p]});
        if (is_known && azimuth == 80) {  // what there is stays there
            registered->add(device);
            REQUIRE(registered->has(device));
            REQUIRE_FALSE(registered->has(first));
        }
        PipelineCounts counts;
        const RenderTarget target{.channels = planes, .covered = drawn, .registered = &*registered};
        pipeline.render(prepared, ranges_of(prepared.rays, prepared.rays), target, nullptr, counts);
        clear_around(prepared.frame, target);
        pipeline.finish();
        most_batches = std::max(most_batches, counts.batches);
        Image packed = image;
        packed.channels = pixels;
        test::require_same(packed, image);
        const auto tiles = static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), 1));
        CHECK(tiles > 5);
        if (room == 0 || room > 100'000)
            CHECK(tiles < drawn.size() / 2);  // single rays mark theirs, whatever they show
    }
    CHECK((most_batches > 1) == (room > 0));

    View none;  // no channel at all: of first hits there are no counts
    none.width = none.height = 40;
    none.every_partition = false;
    none.channels = channel::counts;
    const PreparedFrame prepared = prepare_frame(compiled, none, renderer.statistics().tolerance);
    std::vector<std::uint8_t> tiles(25, 1);
    PipelineCounts counts;
    const RenderTarget nothing{.channels = {}, .covered = tiles};
    pipeline.render(prepared, ranges_of(prepared.rays, prepared.rays), nothing, nullptr, counts);
    pipeline.finish();
    CHECK(renderer.render(none).channels.empty());
}

namespace {

/// An asynchronous pipeline, and the memory of a picture that it draws into.
struct Lined {
    /// `room`: bytes of device memory beside the scene's; 0: all that there is. `most_rays`: of a batch.
    explicit Lined(const Scene& scene, std::uint64_t room = 0, std::uint64_t most_rays = Pipeline::most_rays_drawn,
                   Readback readback = Readback::asynchronous)
        : renderer(scene, {}, settings),
          compiled(compile(scene, {})),
          records(make_converter(compiled, settings)),
          device(settings.device, room ? bytes_of_scene() + room : 0),
          pipeline(device, compiled, *records, settings, readback, most_rays) {}

    std::uint64_t bytes_of_scene() const {
        Device alone(settings.device);
        const Pipeline scene(alone, compiled, *records, settings);
        return alone.allocated();
    }

    PreparedFrame prepared(int width, int height) const {
        PreparedFrame frame = prepare_frame(compiled, {.width = width, .height = height, .every_partition = false});
        frame.edges = true;
        return frame;
    }

    std::vector<RayPartitions> trace(const kernel::Frame& frame, const std::vector<Ray>& rays) {
        PipelineCounts counts;
        Partitions answer;
        RowCollector sink(answer, all_fields, rays.size());
        pipeline.trace_list(frame, RayList(rays, {.all = whole_line}), ranges_of(rays.size(), rays.size()), sink,
                            nullptr, counts);
        return along_rays(answer);
    }

    /// Draws `width` x `height` pixels in ranges of `rays`. The same bits as the renderer's picture, unless `progress`
    /// interrupts it. With `edges`, the picture has edges if the counts say so.
    PipelineCounts draw(int width, int height, bool every_partition, std::uint64_t rays,
                        const Progress& progress = nullptr) {
        View view{.channels = channels};
        view.camera.azimuth = azimuth;
        view.width = width;
        view.height = height;
        view.every_partition = every_partition;
        view.camera.perspective = perspective;
        Image image = renderer.render(view);
        const std::size_t size = std::size_t(width) * std::size_t(height);
        Channels pixels(size, std::vector<float>(image.channels.size(), -1));
        PreparedFrame prepared = prepare_frame(compiled, view, renderer.statistics().tolerance);
        prepared.edges = edges;
        if (edges) prepared.frame.channels |= channel::distance | channel::normal | channel::ids;
        std::vector<ChannelMemory> planes;
        for (std::size_t p = 0; const ChannelSource& source : channel_table) {
            if (!(prepared.frame.channels & source.group)) continue;
            const bool is_wanted = p < pixels.size() && image.names[p] == source.name;
            planes.push_back({is_wanted ? pixels[p++].data() : nullptr,
                              source.value(kernel::background_pixel(&prepared.frame), compiled.display[0])});
        }
        std::vector<std::uint8_t> drawn((width + TILE - 1) / TILE * ((height + TILE - 1) / TILE), 1);
        const RenderTarget target{.channels = planes, .covered = drawn};
        PipelineCounts counts;
        std::uint64_t done = 0;
        const auto told = [&](std::uint64_t more) {
            done += more;
            if (progress && !progress(double(done) / double(prepared.rays)))
                throw Error(Status::interrupted, "interrupted");
        };
        try {
            pipeline.render(prepared, ranges_of(prepared.rays, rays), target, told, counts);
            CHECK(done == prepared.rays);
            clear_around(prepared.frame, target);
            pipeline.finish();
        } catch (...) {
            pipeline.abandon();
            throw;
        }
        if (counts.has_edges) {
            view.edges = true;
            image = renderer.render(view);
        }
        Image packed = image;
        packed.channels = pixels;
        test::require_same(packed, image);
        if (every_partition) {
            CHECK(counts.segments == renderer.statistics().segments);
            CHECK(counts.partitions_used == renderer.statistics().partitions_used);
            CHECK(counts.overlaps == renderer.statistics().overlaps);
        }
        return counts;
    }

    std::uint32_t channels = channel::all;
    double azimuth = 35, perspective = 0;
    bool edges = false;
    Settings settings = test::on_compiling_device();
    Renderer renderer;
    CompiledScene compiled;
    std::unique_ptr<RecordConverter> records;
    Device device;
    Pipeline pipeline;
};

}  // namespace

TEST_CASE("asynchronous: batches that run beside each other") {
    const bool every_partition = GENERATE(false, true);
    for (const std::uint64_t most_rays : {2048, 16'384}) {
        Lined lined(stress::scene_of_parts(20), 0, most_rays);
        for (const double azimuth : {35, 120}) {
            lined.azimuth = azimuth;
            CHECK(lined.draw(403, 361, every_partition, 1 << 20).batches > 3);
            lined.draw(250, 300, every_partition, 700 * tile_rays);
        }
    }
}

TEST_CASE("asynchronous: few channels, of batches that run beside each other, in little memory") {
    const Scene scene = stress::scene_of_parts(20);
    for (const std::uint64_t room : rooms(200'000, 5'000'000)) {
        INFO("room " << room);
        Lined lined(scene, room, 4096);
        lined.channels = channel::distance;
        lined.draw(400, 400, false, 1 << 20);
    }
}

// Batches without deep rays are queued into the buffers at hand; one that has some is traced again, counted.
TEST_CASE("asynchronous: deep rays beside others, in little memory and in much", "[.pocl]") {
    const Scene scene = test::nested_balls(300, {Operator::xor_}, test::Form::list);
    const int width = test::sanitized ? 70 : 140, height = test::sanitized ? 60 : 120;
    std::uint64_t retried = 0;
    for (const std::uint64_t room : {0, 3'000'000, 700'000}) {
        INFO("room " << room);
        Lined lined(scene, room, 1024);
        retried += lined.draw(width, height, true, 1 << 20).retried;
        lined.draw(width, height, false, 1 << 20);
    }
    CHECK(retried > 0);
}

TEST_CASE("a picture in place after a list of rays, in little memory") {
    const test::ByOpenCl lists;
    const Scene scene = stress::scene_of_parts(20);
    for (const std::uint64_t room : rooms(60'000, 3'000'000)) {
        INFO("room " << room);
        Lined lined(scene, room, Pipeline::most_rays_drawn, Readback::by_device);
        const std::vector<Ray> rays = test::random_rays(lined.renderer.model().bounds(), 20'000);
        const PreparedFrame prepared = prepare_rays(lined.compiled, 20'000, lined.renderer.statistics().tolerance);
        lined.trace(prepared.frame, rays);
        lined.draw(300, 300, false, 1 << 20);
    }
}

TEST_CASE("asynchronous: parts of a frame one after the other") {
    Lined lined(stress::scene_of_parts(20));
    const bool every_partition = GENERATE(false, true);
    for (const std::uint64_t tiles : {7, 40, 1000}) lined.draw(203, 161, every_partition, tiles * tile_rays);
}

TEST_CASE("asynchronous: a picture of several copies, each put as it comes") {
    Lined lined(stress::scene_of_parts(20));
    lined.draw(700, 500, false, 1 << 20);
    lined.draw(900, 800, true, 1 << 20);
}

TEST_CASE("asynchronous: a larger frame after one that was interrupted") {
    Lined lined(stress::scene_of_parts(20));
    const bool every_partition = GENERATE(false, true);
    int told = 0;
    CHECK_THROWS_AS(lined.draw(90, 80, every_partition, 30 * tile_rays, [&](double) { return ++told < 3; }), Error);
    lined.draw(300, 250, every_partition, 200 * tile_rays);
    CHECK_THROWS_AS(lined.draw(300, 250, every_partition, 200 * tile_rays, [](double) { return false; }), Error);
    lined.draw(40, 50, every_partition, 10 * tile_rays);
}

TEST_CASE("asynchronous: frames that are interrupted while batches are queued, and others at once") {
    Lined lined(stress::scene_of_parts(20), 0, 16'384);
    for (int i = 0; i < 12; ++i) {
        lined.azimuth = 30 * i;
        int told = 0;
        CHECK_THROWS_AS(lined.draw(400, 250 + 8 * i, false, 1 << 20, [&](double) { return ++told < 1 + i % 3; }),
                        Error);
        lined.azimuth += 100;
        lined.draw(400, 180 + 8 * i, false, 1 << 20);
    }
}

TEST_CASE("asynchronous: every partition of batches that need more than those before") {
    Scene scene = stress::scene_of_parts(20);
    for (int i = 0; i < 40; ++i) {  // a pile that a side shows one in front of the other
        Solid ball{"pile" + std::to_string(i), stress::ball({20.0 + 3 * i, 0, 0}, 2), {}};
        scene.top.push_back(ball.name);
        scene.objects.push_back(std::move(ball));
    }
    Lined lined(scene, 0, 8192);
    std::uint32_t again = 0, batches = 0;
    for (const double azimuth : {90.0, 88.0, 0.0, 1.0, 0.0, 0.0, 90.0}) {
        INFO("azimuth " << azimuth);
        lined.azimuth = azimuth;
        const PipelineCounts counts = lined.draw(403, 361, true, 1 << 20);
        CHECK(counts.batches > 2);
        batches += counts.batches;
        again += counts.retried;
        lined.draw(250, 300, true, 300 * tile_rays);
    }
    CHECK(again > 0);
    CHECK(again < batches / 4);
    lined.azimuth = 0;
    CHECK(lined.draw(403, 361, true, 1 << 20).retried == 0);  // there is room for all by now
}

TEST_CASE("asynchronous: every partition of batches that need more than those before, in little memory") {
    const Scene scene = stress::scene_of_parts(20);
    std::uint32_t again = 0;
    for (const std::uint64_t room : rooms(500'000, 40'000'000)) {
        INFO("room " << room);
        Lined lined(scene, room, 4096);
        for (const double azimuth : {35, 120, 90}) {
            lined.azimuth = azimuth;
            again += lined.draw(203, 161, true, 1 << 20).retried;
        }
    }
    CHECK(again > 0);
}

namespace {

/// 70 balls one in another, and what all of them hold as a region: more than a ray has room for while none is claimed.
void add_shells(Scene& scene, const Vec3& center, double radius, double apart) {
    std::vector<Tree> shells;
    for (int i = 0; i < 70; ++i) {
        const std::string name = "shell" + std::to_string(i);
        scene.objects.push_back(Solid{name, stress::ball(center, radius - apart * i), {}});
        shells.push_back(stress::leaf(name));
    }
    Combination core;
    core.name = "core";
    core.tree = stress::operate(Operator::intersection, shells);
    core.region = true;
    scene.objects.push_back(core);
    scene.top.push_back("core");
}

void add_ball(Scene& scene, const std::string& name, const Vec3& center, double radius) {
    scene.objects.push_back(Solid{name, stress::ball(center, radius), {}});
    scene.top.push_back(name);
}

/// How many of the tiles of such a picture's first hits are listed in parts, counted by entries.
std::size_t count_parts(const Lined& lined, int width, int height) {
    View view{.width = width, .height = height, .every_partition = false};
    view.camera.azimuth = lined.azimuth;
    PreparedFrame prepared = prepare_frame(lined.compiled, view, lined.renderer.statistics().tolerance);
    const auto rays = static_cast<std::uint32_t>(prepared.rays);
    prepared.frame.ray_count = rays;
    prepared.frame.rows = prepared.frame.screen.bottom - prepared.frame.screen.top;
    Device device(lined.settings.device);
    FirstHitPass first_hits(device, lined.compiled, lined.settings);
    const SceneTables scene(device, lined.compiled, lined.records->tables());
    BatchBuffers batch(device);
    TileListPass list(device);
    list.build();
    batch.frame = Buffer(device, "frame", lined.records->frame(prepared.frame));
    wait_for(first_hits.cull().launch(scene, batch, prepared.frame));
    for (const Event& event : list.list({0, rays}, batch, TileListPass::most_in_parts(device))) wait_for(event);
    const auto entries = batch.tiles.read<std::uint32_t>(batch.report.read<kernel::BatchReport>(1).front().entries);
    return static_cast<std::size_t>(
        std::ranges::count_if(entries, [](std::uint32_t entry) { return entry >> PART_SHIFT > 0; }));
}

}  // namespace

TEST_CASE("asynchronous: rays that have no room") {
    const int width = test::sanitized ? 103 : 203, height = test::sanitized ? 81 : 161;
    Scene scene;
    add_shells(scene, {0, 0, 0}, 20, 0.1);
    add_ball(scene, "ball", {0, 30, 0}, 9);
    Lined lined(scene);
    for (const std::uint64_t tiles : {9, 60, 1000})
        CHECK(lined.draw(width, height, false, tiles * tile_rays).segments > 0);  // which the exact way alone counts
    for (const std::uint64_t room : rooms(400'000, 40'000'000)) {                 // beside batches that run
        INFO("room " << room);
        Lined beside(scene, room, test::sanitized ? 1024 : 4096);
        CHECK(beside.draw(width, height, false, 1 << 20).segments > 0);
    }
}

TEST_CASE("asynchronous: edges of a picture whose surfaces stay on the device") {
    Lined lined(stress::scene_of_parts(20));
    lined.edges = true;
    for (const std::uint32_t channels :
         {channel::display, channel::color, channel::color | channel::display, channel::all | channel::display})
        for (const double perspective : {0, 40}) {
            lined.channels = channels;
            lined.perspective = perspective;
            CHECK(lined.pipeline.draws_edges(lined.prepared(203, 161)));
            CHECK(lined.draw(203, 161, false, 1 << 20).has_edges);
            CHECK_FALSE(lined.draw(203, 161, false, 100 * tile_rays).has_edges);
        }
    Lined poor(stress::scene_of_parts(20), 200'000);
    CHECK_FALSE(poor.pipeline.draws_edges(poor.prepared(203, 161)));
    poor.edges = true;
    poor.channels = channel::display;
    CHECK_FALSE(poor.draw(203, 161, false, 1 << 20).has_edges);
    Scene shells;
    add_shells(shells, {0, 0, 0}, 20, 0.1);
    Lined overflows(shells);
    overflows.edges = true;
    overflows.channels = channel::display;
    CHECK_FALSE(overflows.draw(203, 161, false, 1 << 20).has_edges);
}

TEST_CASE("asynchronous: few tiles with more to see than all others, whose rays come in parts") {
    Scene scene;
    for (int i = 0; i < 300; ++i)  // a heap of some pixels, off the middle of an empty picture
        add_ball(scene, "ball" + std::to_string(i), {40 + 0.3 * (i % 7), 0.3 * (i / 7 % 7), 0.3 * (i / 49)},
                 0.1 + 0.0003 * i);
    add_ball(scene, "left", {-100, 0, 0}, 1);
    add_ball(scene, "right", {100, 0, 0}, 1);
    const bool has_shells = GENERATE(false, true);
    if (has_shells) add_shells(scene, {41, 1, 5}, 3, 0.02);
    Lined lined(scene);
    std::size_t listed = 0;
    for (const double azimuth : {35, 100, 170}) {
        INFO("azimuth " << azimuth);
        lined.azimuth = azimuth;
        listed += count_parts(lined, 203, 161);
        const PipelineCounts whole = lined.draw(203, 161, false, 1 << 20);
        const PipelineCounts parts = lined.draw(205, 170, false, 30 * tile_rays);
        CHECK(whole.batches == 1);
        CHECK(parts.batches > 1);
        CHECK((whole.segments > 0) == has_shells);
        CHECK((parts.segments > 0) == has_shells);
    }
    if (TileListPass::most_in_parts(lined.device) >= 8)
        CHECK(listed >= 8);  // one processor alone may find them too many
}

TEST_CASE("asynchronous: whole lines of a wide picture, in little memory and in much") {
    const test::ByOpenCl lists;
    const Scene scene = stress::scene_of_parts(20);
    const bool every_partition = GENERATE(false, true);
    for (const std::uint64_t room : rooms(30'000, 6'000'000)) {
        INFO("every partition: " << every_partition << ", room " << room);
        Lined lined(scene, room);
        lined.draw(1000, 24, every_partition, 1 << 20);
        const std::vector<Ray> rays = test::random_rays(lined.renderer.model().bounds(), 300);
        const PreparedFrame prepared = prepare_rays(lined.compiled, 300, lined.renderer.statistics().tolerance);
        test::require_same(lined.trace(prepared.frame, rays), lined.renderer.shoot(rays));
    }
}

TEST_CASE("asynchronous: parts of one device's picture, a frame like the last one, and one that sees nothing") {
    Lined lined(stress::scene_of_parts(20));
    DeviceGroup pipelines(plan_devices(lined.settings).first, lined.compiled, *lined.records, lined.settings,
                          Readback::asynchronous);
    View view{.width = 1600, .height = 1000};
    view.camera.view_size = lined.compiled.radius;  // from edge to edge
    view.channels = channel::color | channel::ids;
    Channels pixels(1600 * 1000, std::vector<float>{0, 0, 0, 1, 0, 0});
    std::vector<ChannelMemory> planes;
    for (std::size_t p = 0; p < pixels.size(); ++p) planes.push_back({pixels[p].data(), pixels[p][0]});
    std::vector<std::uint8_t> drawn(200 * 125);
    for (const bool every_partition : {false, true})
        for (const bool sees : {true, false, true}) {
            if (test::sanitized && every_partition) continue;
            INFO("every partition: " << every_partition << ", sees: " << sees);
            view.every_partition = every_partition;
            view.camera.center = sees ? std::optional<Vec3>() : Vec3{0, 1e9, 0};
            Image image = lined.renderer.render(view);
            const PreparedFrame prepared = prepare_frame(lined.compiled, view, lined.renderer.statistics().tolerance);
            CHECK((prepared.rays > 0) == sees);
            Watch watch;
            PipelineCounts counts;
            pipelines.render(prepared, {.channels = planes, .covered = drawn}, &watch, counts);
            CHECK(watch.done() == (sees ? 1 : 0));
            if (sees && !every_partition) CHECK(counts.batches > 1);
            Image packed = image;
            packed.channels = pixels;
            test::require_same(packed, image);
            CHECK((std::count(drawn.begin(), drawn.end(), 0) < std::ptrdiff_t(drawn.size())) == sees);
        }
    int calls = 0;
    const auto end_at_second = [&](double) { return ++calls < 2; };
    const auto draw_when_ended = [&](Watch& watch) {
        while (!*watch.stop()) std::this_thread::yield();
        PipelineCounts counts;
        pipelines.render(prepare_frame(lined.compiled, view), {.channels = planes, .covered = drawn}, &watch, counts);
    };
    CHECK_THROWS_AS(Watch::over(end_at_second, draw_when_ended), Error);
}
