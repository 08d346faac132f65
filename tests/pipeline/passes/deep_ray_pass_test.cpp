// Deep rays in small groups, and in many launches, against the reference; and without memory for them.
#include "pipeline/passes/deep_rays.hpp"

#include "catch.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/passes/on_device.hpp"
#include "pipeline/passes/partitions.hpp"
#include "rays/frame.hpp"

using namespace csgrt;

namespace {

struct Shot {
    explicit Shot(const Scene& scene) : on(scene), pass(on.device, on.compiled, *on.records, on.settings) {
        on.batch.rays = Buffer(on.device, "rays", on.records->rays(test::records_of(rays)));
        prepared.frame.ray_count = count();
        on.batch.frame = Buffer(on.device, "frame", on.records->frame(prepared.frame));
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(rays.size()); }
    std::optional<PartitionSizes> trace() {
        TimedKernels timed;
        return pass.trace_counted(input(), timed);
    }
    PartitionPass::Input input() { return {on.tables, on.batch, Work::rays, count()}; }
    std::vector<RayPartitions> answers() { return test::answers_of(pass, input()); }
    std::vector<RayPartitions> expected() {
        const auto to_run = make_kernels_to_run(on.compiled, on.settings);
        ReferenceCounts counts;
        return test::answers_of(Reference(on.compiled, *to_run), prepared.frame, rays, counts);
    }

    test::OnDevice on;
    PartitionPass pass;
    std::vector<Ray> rays = test::rays_along_grid();
    PreparedFrame prepared = prepare_rays(on.compiled, count());
};

}  // namespace

TEST_CASE("deep rays have the same answers in groups of any size and in any number of launches") {
    Shot shot(test::deep_parts(3, 400, 40));
    const std::vector<RayPartitions> expected = shot.expected();
    const std::uint32_t usual_rays = shot.pass.deep_rays().rays_at_a_time,
                        usual_boundaries = shot.pass.deep_rays().boundaries_a_launch;
    for (const auto& [rays, boundaries] :
         {std::pair{usual_rays, usual_boundaries}, {7u, usual_boundaries}, {1u, 100u}, {usual_rays, 1u}, {64u, 37u}}) {
        INFO(rays << " rays at a time, " << boundaries << " ends a launch");
        shot.pass.deep_rays().rays_at_a_time = rays;
        shot.pass.deep_rays().boundaries_a_launch = boundaries;
        REQUIRE(shot.trace());
        test::require_same(shot.answers(), expected);
    }
}

TEST_CASE("deep rays that do not fit the memory are told, and those that fit one by one are traced") {
    Shot shot(test::deep_parts(4, 400, 40));
    REQUIRE(shot.trace());
    const std::vector<RayPartitions> expected = shot.answers();
    const auto offsets = [&] { return shot.pass.read(shot.count()).offsets; }();
    DeepRayPass& deep = shot.pass.deep_rays();
    const std::uint64_t whole = deep.held();
    REQUIRE(whole > 0);
    deep.release();
    CHECK(deep.held() == 0);
    const std::uint64_t available = shot.on.device.available();
    CHECK_FALSE(deep.prepare(offsets, available));
    CHECK_FALSE(deep.prepare(offsets, available - 2'000));
    REQUIRE(deep.prepare(offsets, available - whole / 4));
    CHECK(deep.held() <= whole / 4);
    REQUIRE(deep.prepare(offsets, 0));
    CHECK(deep.held() == whole);
}
