// What blocks of a picture may see: found by one work-item a block, as on processors, and by several, as on GPUs.
#include "device/compiling_device.hpp"
#include "pipeline/cull.hpp"

#include <algorithm>

#include <csgrt/renderer.hpp>

#include "bench/parts.hpp"
#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "reference/reference.hpp"
#include "stress/build.hpp"

using namespace csgrt;

namespace {

struct Culled {
    std::vector<unsigned char> costs;
    std::vector<std::vector<kernel::BlockNode>> lists;
};

Culled cull(const CompiledScene& compiled, const PreparedFrame& prepared, bool together) {
    const Settings settings = test::on_compiling_device();
    const auto kernels = make_kernels(compiled, settings.precision, settings.quartic);
    Device device(settings.device);
    const SceneBuffers scene(device, compiled, kernels->tables());
    const Program program(device, assemble_program({Cull::file(together)}), defines_of(device, compiled, settings));
    Cull kernel_0(device, program, together);
    TileBuffers tile(device);
    kernel::Frame frame = prepared.frame;
    frame.ray_count = static_cast<std::uint32_t>(prepared.rays);
    frame.lines = together ? frame.window.bottom - frame.window.top : 0;
    tile.frame = Buffer(device, "frame", kernels->frame(frame));
    for (const Event& event : kernel_0.launch(scene, tile, frame)) wait_for(event);
    const std::uint32_t blocks = frame.ray_count / block_rays;
    Culled culled{tile.costs.read<unsigned char>(blocks), {}};
    const auto nodes = tile.lists.read<kernel::BlockNode>(blocks * LISTED_NODES);
    for (std::uint32_t block = 0; block < blocks; ++block) {
        const auto begin = nodes.begin() + block * LISTED_NODES;
        const auto end = std::find_if(begin, begin + LISTED_NODES, [](const kernel::BlockNode& e) { return e.node == NONE; });
        culled.lists.emplace_back(begin, end);
    }
    if (together) {
        const auto tally = tile.tally.read<std::uint8_t>(Tile{0, frame.ray_count}.tally_bytes());
        CHECK(std::all_of(tally.begin(), tally.begin() + sizeof(kernel::TileTally) + blocks, [](std::uint8_t byte) { return byte == 0; }));
    }
    return culled;
}

/// The most nodes of a block.
std::size_t require_same(const CompiledScene& compiled, const View& view) {
    const PreparedFrame prepared = prepare_frame(compiled, view);
    const Culled alone = cull(compiled, prepared, false), together = cull(compiled, prepared, true);
    REQUIRE(alone.lists.size() == together.lists.size());
    CHECK(alone.costs == together.costs);
    std::size_t differing = 0, most = 0;
    for (std::size_t block = 0; block < alone.lists.size(); ++block) {
        const auto same = [](const kernel::BlockNode& a, const kernel::BlockNode& b) { return a.node == b.node && a.entry == b.entry; };
        differing += !std::ranges::equal(alone.lists[block], together.lists[block], same);
        most = std::max(most, alone.lists[block].size());
    }
    CHECK(differing == 0);
    return most;
}

}  // namespace

TEST_CASE("blocks see the same, whether one work-item looks or several") {
    for (const std::uint32_t parts : {1u, 20u, 3000u}) {
        INFO(parts << " parts");
        const CompiledScene compiled = compile(bench::scene_of_parts(parts), {});
        View view;
        view.width = 203;  // blocks that no group of work-items is filled by
        view.height = 93;
        view.every_partition = false;
        for (const double perspective : {0, 40}) {
            view.camera.perspective = perspective;
            const std::size_t most = require_same(compiled, view);
            CHECK((parts == 3000) == (most == LISTED_NODES - 1));  // no room for all that a block meets
        }
    }
}

TEST_CASE("blocks see the same of a scene of one solid, and of an unbounded one") {
    for (const bool bounded : {true, false}) {
        Scene scene;
        scene.objects.push_back(Solid{"half", Half{{{0, 0, 1}, 0}}, {}});
        scene.objects.push_back(Solid{"ball", stress::ball({0, 0, 0}, 3), {}});
        scene.top = bounded ? std::vector<std::string>{"ball"} : std::vector<std::string>{"ball", "half"};
        View view;
        view.width = view.height = 50;
        view.every_partition = false;
        CHECK(require_same(compile(scene, {}), view) == 1);
    }
}
