// How large batches become, by numbers alone.
#include "pipeline/scheduling/memory_plan.hpp"

#include "catch.hpp"
#include "pipeline/passes/partition_memory.hpp"

using namespace csgrt;

namespace {

constexpr std::uint64_t mebibyte = 1u << 20, gibibyte = 1u << 30;

FrameShape shape(std::uint32_t across, std::uint32_t down, bool every_partition) {
    return {.tiles_across = across, .tiles_down = down, .pixel_bytes = 52, .every_partition = every_partition};
}

}  // namespace

TEST_CASE("a frame that fits is one batch") {
    const DeviceMemory memory{.available = 8 * gibibyte, .held = 0, .max_buffer = 2 * gibibyte};
    for (const bool every : {false, true})
        CHECK(plan_memory(shape(128, 128, every), memory, 2, 1u << 22).batch_rays == 1u << 20);
    CHECK(plan_memory(shape(1024, 1024, true), memory, 2, 1u << 22).batch_rays == 1u << 22);  // the caller's limit
}

TEST_CASE("a batch takes a quarter of the memory, what the pipeline holds already included") {
    const FrameShape frame = shape(1024, 1024, true);
    const std::uint64_t most = ~std::uint64_t{0};
    const MemoryPlan free =
        plan_memory(frame, {.available = 400 * mebibyte, .held = 0, .max_buffer = gibibyte}, 2, most);
    const MemoryPlan held =
        plan_memory(frame, {.available = 100 * mebibyte, .held = 300 * mebibyte, .max_buffer = gibibyte}, 2, most);
    CHECK(free.batch_rays == held.batch_rays);
    CHECK(free.batch_rays == 100 * mebibyte / free.ray_bytes);
    // One batch more underway: its pixels, its list and its rays' counts.
    const MemoryPlan alone =
        plan_memory(frame, {.available = 400 * mebibyte, .held = 0, .max_buffer = gibibyte}, 1, most);
    CHECK(free.ray_bytes - alone.ray_bytes == 52 + 4 + PartitionMemory::ray_bytes);
    CHECK(alone.batch_rays > free.batch_rays);
}

TEST_CASE("no batch has more than a buffer holds, and the least has one ray") {
    const FrameShape frame = shape(64, 64, false);
    const MemoryPlan plan =
        plan_memory(frame, {.available = gibibyte, .held = 0, .max_buffer = 64 * 1024}, 1, 1u << 22);
    CHECK(plan.batch_rays * plan.ray_bytes <= 64 * 1024);
    CHECK((plan.batch_rays + 1) * plan.ray_bytes > 64 * 1024);
    CHECK(plan_memory(frame, {.available = 10, .held = 0, .max_buffer = gibibyte}, 1, 1u << 22).batch_rays == 1);
    CHECK(plan_memory(shape(0, 0, false), {.available = gibibyte, .held = 0, .max_buffer = gibibyte}, 1, 1u << 22)
              .batch_rays == 1);
    CHECK(rays_fitting({.available = 1000 * gibibyte, .held = 0, .max_buffer = 1000 * gibibyte}, 8) == 1u << 24);
}

TEST_CASE("a batch's own buffers grow with its tiles") {
    const std::uint64_t one = batch_bytes(shape(8, 8, true), {0, tile_rays}, 500);
    const std::uint64_t nine = batch_bytes(shape(8, 8, true), {64, 9 * tile_rays}, 500);
    CHECK(one > 500 + sizeof(kernel::BatchReport));
    CHECK(nine - one >= 8 * (LISTED_NODES * sizeof(kernel::TileNode) + 1 + 4));
    CHECK(batch_bytes(shape(8, 8, false), {0, tile_rays}, 500) == one + 4 * tile_rays);  // rays that may overflow
}
