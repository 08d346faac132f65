// The way in which pixels come from a GPU, on any device: it makes the same picture as from a processor.
#include "pipeline/picture_reader.hpp"

#include <csgrt/renderer.hpp>

#include "bench/parts.hpp"
#include "catch.hpp"
#include "pipeline/known_picture.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/same_answers.hpp"
#include "reference/reference.hpp"

using namespace csgrt;

TEST_CASE("lines make the picture, whatever was there before and however many tiles there are") {
    Scene scene = bench::scene_of_parts(20);
    scene.background = {0.2, 0, 0.4};
    const bool every_partition = GENERATE(false, true);
    const std::uint64_t room = GENERATE(std::uint64_t{0}, std::uint64_t{800'000}, std::uint64_t{5'000});  // beside the scene's
    const bool is_known = GENERATE(false, true);  // the picture's memory, to the device
    INFO("every partition: " << every_partition << ", room " << room << ", known: " << is_known);
    const Settings settings = test::on_device();
    Renderer renderer(scene, {}, settings);
    const CompiledScene compiled = compile(scene, {});
    const auto kernels = make_kernels(compiled, settings.precision, settings.quartic);
    Device first(settings.device);
    const Pipeline needs(first, compiled, *kernels, settings);
    Device device(settings.device, room ? first.allocated() + room : 0);
    Pipeline pipeline(device, compiled, *kernels, settings, Readback::lines);

    Framebuffer framebuffer;
    std::vector<std::vector<float>> pixels;
    std::vector<std::uint8_t> drawn;
    std::vector<float> background;
    std::uint32_t most_tiles = 0;
    KnownPicture known;
    for (const double azimuth : {35.0, 80.0, 200.0}) {
        View view;
        view.width = 77;
        view.height = 61;
        view.camera.azimuth = azimuth;
        view.every_partition = every_partition;
        renderer.render(view, framebuffer);
        const Image& image = framebuffer.image();
        std::vector<ChannelPlane> planes;
        if (pixels.empty()) {
            pixels.assign(image.channels.size(), std::vector<float>(77 * 61, -1));
            drawn.assign(10 * 8, 1);
            background.assign(image.channels.size(), 0);
            background[0] = 0.2f;
            background[2] = 0.4f;
            background[4] = std::numeric_limits<float>::infinity();
        }
        for (std::size_t p = 0; p < pixels.size(); ++p) planes.push_back({pixels[p].data(), background[p]});
        if (is_known && azimuth == 80) {  // what there is stays there
            REQUIRE(known.add(device, planes, pixels[0].size()));
            REQUIRE(known.is_known_to(device));
            REQUIRE_FALSE(known.is_known_to(first));
        }
        const PreparedFrame prepared = prepare_frame(compiled, view, renderer.statistics().tolerance);
        PipelineCounts counts;
        const RenderTarget target{.planes = planes, .drawn = drawn, .known = &known};
        pipeline.render(prepared, {0, prepared.rays}, [] { return RayRange{}; }, target, nullptr, counts);
        pipeline.finish();
        most_tiles = std::max(most_tiles, counts.tiles);
        Image packed = image;
        packed.channels = pixels;
        test::require_same(packed, image);
        const auto blocks = static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), 1));
        CHECK(blocks > 5);
        if (room == 0 || room > 100'000) CHECK(blocks < drawn.size() / 2);  // single rays mark theirs, whatever they show
    }
    CHECK((most_tiles > 1) == (room > 0));

    View none;  // no channel at all: of first hits there are no counts
    none.width = none.height = 40;
    none.every_partition = false;
    none.channels = channel::counts;
    const PreparedFrame prepared = prepare_frame(compiled, none, renderer.statistics().tolerance);
    std::vector<std::uint8_t> blocks(25, 1);
    PipelineCounts counts;
    const RenderTarget nothing{.planes = {}, .drawn = blocks};
    pipeline.render(prepared, {0, prepared.rays}, [] { return RayRange{}; }, nothing, nullptr, counts);
    pipeline.finish();
    CHECK(renderer.render(none).channels.empty());
}
