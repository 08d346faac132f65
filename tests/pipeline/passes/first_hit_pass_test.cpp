// First hits of a list of tiles that was made by hand, pixel by pixel against the reference.
#include "pipeline/passes/first_hits.hpp"

#include <bit>

#include "catch.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/passes/on_device.hpp"

using namespace csgrt;

TEST_CASE("the first-hit pass draws the tiles that are listed, in the order of the list") {
    test::OnDevice on(stress::scene_of_parts(200), test::small_view(false));
    FirstHitPass pass(on.device, on.compiled, on.settings);
    // All tiles of the screen are culled; half of those that see anything are drawn.
    const std::uint32_t tiles = kernel::tiles_across(on.frame.screen) * kernel::tiles_down(on.frame.screen);
    on.frame.first_ray = 0;
    on.frame.ray_count = tiles * tile_rays;
    on.batch.frame = Buffer(on.device, "frame", on.records->frame(on.frame));
    wait_for(pass.cull().launch(on.tables, on.batch, on.frame));
    const std::vector<std::uint32_t> seen = CullPass::seen({0, tiles * tile_rays}, on.batch);
    REQUIRE(seen.size() > 9);
    std::vector<std::uint32_t> list;  // every other one, from the last to the first
    for (std::size_t i = seen.size(); i >= 2; i -= 2) list.push_back(seen[i - 1]);
    on.start(Work::tiles, list);
    on.batch.report.reserve(sizeof(kernel::BatchReport));
    on.batch.report.queue_fill(0, sizeof(kernel::BatchReport));
    Buffer picture(on.device, "picture", 3 * on.frame.ray_count * sizeof(float));
    PipelineCounts counts;
    add_times(pass.launch(on.tables, on.batch, picture, on.frame.ray_count), counts);
    CHECK(counts.first_hits > 0);
    CHECK(on.batch.report.read<kernel::BatchReport>(1).front().overflows == 0);

    const std::vector<float> drawn = picture.read<float>(3 * on.frame.ray_count);
    const std::vector<kernel::Pixel> expected = on.expected();
    std::size_t hits = 0;
    for (std::uint32_t i = 0; i < on.frame.ray_count; ++i) {
        const auto pixel = on.pixel_of(list[i / tile_rays] * tile_rays + i % tile_rays);
        if (!pixel) continue;
        INFO("ray " << i << " of the batch, pixel " << *pixel);
        REQUIRE(std::bit_cast<std::uint32_t>(drawn[i]) == std::bit_cast<std::uint32_t>(expected[*pixel].z));
        REQUIRE(std::bit_cast<std::uint32_t>(drawn[on.frame.ray_count + i]) == expected[*pixel].region);
        REQUIRE(std::bit_cast<std::uint32_t>(drawn[2 * on.frame.ray_count + i]) == expected[*pixel].solid);
        hits += expected[*pixel].region > 0;
    }
    CHECK(hits > 20);
}
