// Every partition of work lists that were made by hand: pixels, and rays as they come, against the reference; and what
// is written if the buffers at hand hold too little.
#include "pipeline/passes/partitions.hpp"

#include <algorithm>
#include <bit>

#include "catch.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/passes/on_device.hpp"
#include "rays/frame.hpp"

using namespace csgrt;

TEST_CASE("the partition pass draws the pixels that are listed") {
    test::OnDevice on(stress::scene_of_parts(200), test::small_view(true));
    PartitionPass pass(on.device, on.compiled, *on.records, on.settings);
    const std::uint32_t rays = kernel::tiles_across(on.frame.screen) * kernel::tiles_down(on.frame.screen) * tile_rays;
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < 300; ++i) list.push_back(i * 7919u % rays);  // in no order
    on.start(Work::pixels, list);
    Buffer picture(on.device, "picture", 3 * list.size() * sizeof(float));
    const PartitionPass::Input input{on.tables, on.batch, Work::pixels, on.frame.ray_count};
    TimedKernels timed;
    const auto needed = pass.trace_counted(input, timed);
    REQUIRE(needed);
    CHECK(needed->candidates >= needed->total.segments / 2);
    pass.shade(input, picture, timed);
    const std::vector<float> drawn = picture.read<float>(3 * list.size());
    const std::vector<kernel::Pixel> expected = on.expected();
    std::size_t hits = 0, segments = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto pixel = on.pixel_of(list[i]);
        if (!pixel) continue;
        INFO("ray " << list[i]);
        REQUIRE(std::bit_cast<std::uint32_t>(drawn[i]) == std::bit_cast<std::uint32_t>(expected[*pixel].z));
        REQUIRE(std::bit_cast<std::uint32_t>(drawn[list.size() + i]) == expected[*pixel].region);
        hits += expected[*pixel].region > 0;
        segments += expected[*pixel].depth;
    }
    CHECK(hits > 20);
    CHECK(needed->total.segments == segments);
}

TEST_CASE("the partition pass answers rays as they come") {
    test::OnDevice on(stress::scene_of_parts(200));
    PartitionPass pass(on.device, on.compiled, *on.records, on.settings);
    const std::vector<Ray> rays = test::random_rays(on.compiled.bounds, 200);
    PreparedFrame prepared = prepare_rays(on.compiled, 200);
    prepared.frame.ray_count = 200;
    on.batch.frame = Buffer(on.device, "frame", on.records->frame(prepared.frame));
    on.batch.rays = Buffer(on.device, "rays", on.records->rays(test::records_of(rays)));
    TimedKernels timed;
    const PartitionPass::Input input{on.tables, on.batch, Work::rays, 200};
    REQUIRE(pass.trace_counted(input, timed));
    const auto to_run = make_kernels_to_run(on.compiled, on.settings);
    ReferenceCounts counts;
    test::require_same(test::answers_of(pass, input),
                       test::answers_of(Reference(on.compiled, *to_run), prepared.frame, rays, counts));
    CHECK(counts.partitions > 100);
}

TEST_CASE("kernels that are queued into too little memory write nothing, and report what the rays need") {
    test::OnDevice on(stress::scene_of_parts(200), test::small_view(true));
    PartitionPass pass(on.device, on.compiled, *on.records, on.settings);
    const std::uint32_t across = kernel::tiles_across(on.frame.screen),
                        tiles = across * kernel::tiles_down(on.frame.screen);
    on.frame.ray_count = tiles * tile_rays;
    on.frame.rows = on.frame.screen.bottom - on.frame.screen.top;
    on.batch.frame = Buffer(on.device, "frame", on.records->frame(on.frame));
    wait_for(pass.cull().launch(on.tables, on.batch, on.frame));
    const std::vector<std::uint32_t> seen = CullPass::seen({0, tiles * tile_rays}, on.batch);
    REQUIRE(seen.size() > 4);
    on.start(Work::tiles, seen);
    const PartitionPass::Input input{on.tables, on.batch, Work::tiles, on.frame.ray_count};
    TimedKernels timed;
    const auto needed = pass.trace_counted(input, timed);  // buffers are as large as the rays need from now on
    REQUIRE(needed);
    PipelineCounts counts;
    pass.add_sizes(*needed, on.frame.ray_count, counts);
    const auto capacity = pass.capacity_for(on.frame.ray_count);
    REQUIRE(capacity);
    CHECK(needed->fit(*capacity));

    const std::size_t pixels = std::size_t{kernel::width_of(on.frame.screen)} * on.frame.rows;
    for (const int lacking : {0, 1, 2, 3}) {  // nothing, candidates, segments, words
        INFO("lacking " << lacking);
        PartitionSizes given = *capacity;
        if (lacking == 1) given.candidates = needed->candidates - 1;
        if (lacking == 2) given.total.segments = needed->total.segments - 1;
        if (lacking == 3) given.total.words = needed->total.words - 1;
        on.frame.candidate_capacity = given.candidates;
        on.frame.segment_capacity = given.total.segments;
        on.frame.word_capacity = given.total.words;
        on.start(Work::tiles, seen);
        Buffer picture(on.device, "picture", 3 * pixels * sizeof(float));
        picture.queue_fill(std::bit_cast<std::uint32_t>(-1.0f), picture.size());
        pass.trace_queued(input, given, timed);
        pass.shade(input, picture, timed);
        const std::vector<float> drawn = picture.read<float>(pixels);
        const auto report = on.batch.report.read<kernel::BatchReport>(1).front();
        CHECK(report.candidates == needed->candidates);
        const auto written = std::count_if(drawn.begin(), drawn.end(), [](float z) { return z != -1; });
        if (lacking == 0) {
            CHECK(report.total.segments == needed->total.segments);
            CHECK(report.total.words == needed->total.words);
            CHECK(written > 100);
        } else {
            CHECK_FALSE(PartitionSizes{report.candidates, report.total}.fit(given));
            CHECK(written == 0);
        }
    }
}
