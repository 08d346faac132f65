// Rays of many segments against the reference, which sorts and evaluates each partition by itself.
#include "integration/deep_scenes.hpp"
#include "integration/same_answers.hpp"
#include "kernel_host/kernels.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace csgrt::kernel {
#include "../kernels/shared/capacity.h"
}  // namespace csgrt::kernel

namespace {

constexpr std::uint32_t most = DEEP_SEGMENTS;

void require_answers(const Scene& scene, const std::vector<Ray>& rays, std::size_t least_overlaps = 0,
                     bool air = false) {
    Settings settings = test::on_device(), by_reference = settings;
    settings.air = by_reference.air = air;
    by_reference.reference = true;
    by_reference.device.clear();
    Renderer reference(scene, {}, by_reference), device(scene, {}, settings);
    const auto expected = reference.shoot(rays);
    test::require_same(device.shoot(rays), expected);
    CHECK(device.statistics().segments == reference.statistics().segments);
    CHECK(device.statistics().partitions_used == reference.statistics().partitions_used);
    CHECK(device.statistics().overlaps == reference.statistics().overlaps);
    CHECK(device.statistics().overlaps >= least_overlaps);
    CHECK(device.statistics().segments > rays.size() * most / 2);  // or few of them were deep
}

}  // namespace

TEST_CASE("device and reference agree on nested balls, whatever operators join them",
          "[agreement][promise:bits][promise:booleans]") {
    const std::vector<Operator> alternating = {Operator::difference, Operator::xor_, Operator::union_,
                                               Operator::intersection};
    for (const auto& ops : {std::vector{Operator::xor_}, {Operator::union_}, {Operator::difference}, alternating}) {
        for (const test::Form form : {test::Form::list, test::Form::left, test::Form::right}) {
            if (form == test::Form::list && ops.size() > 1) continue;
            const Scene scene = test::nested_balls(2 * most, ops, form);
            INFO("operators " << ops.size() << ", form " << static_cast<int>(form));
            test::require_agreement(scene, {}, 16, 60);
        }
    }
}

TEST_CASE("device and reference agree on rays just below and just above what is deep", "[agreement]") {
    for (const std::uint32_t count : {most - 1, most, most + 1, most + 2})
        test::require_agreement(test::nested_balls(count, {Operator::xor_}, test::Form::list), {}, 16, 60);
}

TEST_CASE("device and reference agree on coincident copies", "[agreement]") {
    for (const Operator op : {Operator::xor_, Operator::union_, Operator::difference})
        test::require_agreement(test::nested_balls(3 * most, {op}, test::Form::list, 3 * most), {}, 16, 60);
    test::require_agreement(test::nested_balls(3 * most, {Operator::xor_}, test::Form::list, 5), {}, 16, 60);
}

TEST_CASE("device and reference agree on deep rays through many regions, in their faces and along their edges",
          "[agreement]") {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        INFO("seed " << seed);
        const Scene scene = test::deep_parts(seed, 3 * most, seed % 2 ? 200 : 12);
        std::vector<Ray> rays = test::rays_along_grid();
        for (const Ray& ray : test::random_rays({{0, 0, 0}, {90, 8, 8}}, 100)) rays.push_back(ray);
        require_answers(scene, rays, 100, seed % 3 == 0);
    }
}

TEST_CASE("device and reference agree on pictures of deep parts", "[agreement]") {
    test::require_agreement(test::deep_parts(7, 3 * most, 60), {}, 32, 40);
}

TEST_CASE("device and reference agree on deep rays in single precision", "[.pocl][agreement]") {
    Settings settings = test::on_compiling_device();
    settings.precision = Precision::single;
    test::require_agreement(test::nested_balls(2 * most, {Operator::xor_}, test::Form::list), {}, 16, 60, settings);
}
