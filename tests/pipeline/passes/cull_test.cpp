// What tiles of a picture may see: the device against the same kernel compiled for the host.
#include "device/compiling_device.hpp"
#include "pipeline/passes/cull.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <csgrt/renderer.hpp>

#include "stress/parts.hpp"
#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "kernels/host_kernels.hpp"
#include "reference/reference.hpp"
#include "stress/build.hpp"

using namespace csgrt;

namespace {

struct Culled {
    std::vector<unsigned char> costs;
    std::vector<std::vector<kernel::TileNode>> lists;
};

Culled lists_of(std::vector<unsigned char> costs, std::span<const kernel::TileNode> nodes) {
    Culled culled{std::move(costs), {}};
    for (std::size_t tile = 0; tile < culled.costs.size(); ++tile) {
        const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(tile * LISTED_NODES);
        const auto end =
            std::find_if(begin, begin + LISTED_NODES, [](const kernel::TileNode& e) { return e.node == NONE; });
        culled.lists.emplace_back(begin, end);
    }
    return culled;
}

Culled cull_on_device(const CompiledScene& compiled, const kernel::Frame& frame) {
    const Settings settings = test::on_compiling_device();
    const auto records = make_converter(compiled, settings);
    Device device(settings.device);
    const SceneTables scene(device, compiled, records->tables());
    const Program program(device, assemble_program({CullPass::file}),
                          program_options(device, ProgramNeeds(compiled), settings));
    CullPass kernel_0(device, program);
    BatchBuffers batch(device);
    batch.frame = Buffer(device, "frame", records->frame(frame));
    wait_for(kernel_0.launch(scene, batch, frame));
    const std::uint32_t tiles = frame.ray_count / tile_rays;
    const auto tally = batch.report.read<std::uint8_t>(BatchBuffers::report_bytes({0, frame.ray_count}));
    CHECK(std::all_of(tally.begin(), tally.begin() + sizeof(kernel::BatchReport) + tiles,
                      [](std::uint8_t byte) { return byte == 0; }));
    return lists_of(batch.costs.read<unsigned char>(tiles),
                    batch.tile_nodes.read<kernel::TileNode>(tiles * LISTED_NODES));
}

Culled cull_on_host(const CompiledScene& compiled, kernel::Frame frame) {
    frame.rows = 0;  // no tally to clear
    test::HostTiles tiles = test::cull(compiled, frame);
    return lists_of(std::move(tiles.costs), tiles.lists);
}

/// The most nodes of a tile.
std::size_t require_same(const CompiledScene& compiled, const View& view) {
    const PreparedFrame prepared = prepare_frame(compiled, view);
    kernel::Frame frame = prepared.frame;
    frame.ray_count = static_cast<std::uint32_t>(prepared.rays);
    frame.rows = frame.screen.bottom - frame.screen.top;
    const Culled on_host = cull_on_host(compiled, frame), on_device = cull_on_device(compiled, frame);
    REQUIRE(on_host.lists.size() == on_device.lists.size());
    CHECK(on_host.costs == on_device.costs);
    std::size_t differing = 0, most = 0;
    for (std::size_t tile = 0; tile < on_host.lists.size(); ++tile) {
        // An entry is a lower bound, which comes of distances in float. OpenCL lets a GPU round their divisions by 2.5
        // units in the last place, which is that much of the scene's size, not of the entry, a difference. Which nodes
        // are listed does not depend on it, nor does any pixel.
        const auto same = [&](const kernel::TileNode& a, const kernel::TileNode& b) {
            const double allowed = test::is_processor() ? 0 : 4 * 0x1p-23 * 2 * compiled.radius;
            return a.node == b.node && (a.entry == b.entry || std::abs(double{a.entry} - b.entry) <= allowed);
        };
        differing += !std::ranges::equal(on_host.lists[tile], on_device.lists[tile], same);
        most = std::max(most, on_host.lists[tile].size());
    }
    CHECK(differing == 0);
    return most;
}

}  // namespace

TEST_CASE("tiles see the same on a device and on the host") {
    for (const std::uint32_t parts : {1u, 20u, 3000u}) {
        INFO(parts << " parts");
        const CompiledScene compiled = compile(stress::scene_of_parts(parts), {});
        View view;
        view.width = 203;  // tiles that no group of work-items is filled by
        view.height = 93;
        view.every_partition = false;
        for (const double perspective : {0, 40}) {
            view.camera.perspective = perspective;
            const std::size_t most = require_same(compiled, view);
            CHECK((parts == 3000) == (most == LISTED_NODES - 1));  // no room for all that a tile meets
        }
    }
}

TEST_CASE("tiles see the same of a scene of one solid, and of an unbounded one") {
    for (const bool bounded : {true, false}) {
        Scene scene;
        scene.objects.push_back(Solid{"half", Half{{{0, 0, 1}, 0}}, {}});
        scene.objects.push_back(Solid{"ball", stress::ball({0, 0, 0}, 3), {}});
        scene.top = bounded ? std::vector<std::string>{"ball"} : std::vector<std::string>{"ball", "half"};
        View view{.width = 50, .height = 50, .every_partition = false};
        CHECK(require_same(compile(scene, {}), view) == 1);
    }
}
