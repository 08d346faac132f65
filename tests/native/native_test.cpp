// The native device by itself; that it draws the reference's bits is the agreement tests' to see.
#include <algorithm>
#include <random>
#include <thread>

#include <csgrt/csgrt.hpp>

#include "base/laboratory.hpp"
#include "stress/parts.hpp"
#include "catch.hpp"
#include "device/program.hpp"
#include "kernel_host/kernels.hpp"
#include "integration/same_answers.hpp"

using namespace csgrt;

namespace {

bool have_native() {
    if (!find_native_devices().empty()) return true;
    WARN("no native device: nothing seen");
    return false;
}

/// What kernels/scan.cl says of a list, one entry after the other: sums that stay at COUNT_MAX.
std::vector<kernel::RayCount> sums_before(const std::vector<kernel::RayCount>& counts) {
    const auto plus = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{a} + b, COUNT_MAX));
    };
    std::vector<kernel::RayCount> sums;
    kernel::RayCount sum{};
    for (const kernel::RayCount& count : counts) {
        sums.push_back(sum);
        sum = {plus(sum.segments, count.segments), plus(sum.words, count.words)};
    }
    return sums;
}

}  // namespace

TEST_CASE("the native device's sums are those of one entry after the other", "[device]") {
    if (!have_native()) return;
    Device device("native");
    const Program program(device, "partitions");
    Kernel scan_blocks = program.kernel("scan_blocks"), scan_sums = program.kernel("scan_sums"),
           scan_add = program.kernel("scan_add");
    std::mt19937 random(7);
    const std::uint32_t most = GENERATE(1u, 70'000u);  // 200,000 times as much is more than 32 bits hold
    for (const std::uint32_t size : {1u, 63u, 1024u, 1025u, 200'000u}) {
        INFO(size << " entries of up to " << most);
        std::vector<kernel::RayCount> counts(size);
        for (auto& count : counts) {
            count.segments = static_cast<std::uint32_t>(random() % (most + 1));
            count.words = static_cast<std::uint32_t>(random() % 3);
        }
        const std::uint32_t tiles = (size + 1023) / 1024;
        Buffer entries(device, "counts", counts), sums(device, "sums", tiles * sizeof(kernel::RayCount));
        scan_blocks.launch(std::size_t{tiles} * 64, 64, entries, sums, size);
        scan_sums.launch(64, 64, sums, tiles);
        scan_add.launch(size, 64, entries, sums, size);
        const auto found = entries.read<kernel::RayCount>(size), expected = sums_before(counts);
        std::size_t different = 0;
        for (std::size_t i = 0; i < size; ++i)
            different += found[i].segments != expected[i].segments || found[i].words != expected[i].words;
        CHECK(different == 0);
    }
}

TEST_CASE("the native device has the kernels of the default method and says so of others",
          "[device][promise:devices]") {
    if (!have_native()) return;
    Device device("native");
    for (const Settings& other : {with_methods({.contraction = true}), Settings{.precision = Precision::single},
                                  with_methods({.single_world = true}), with_methods({.quartic = Quartic::ferrari})})
        CHECK_THROWS_WITH(Program(device, program_source(device.info(), other, "partitions", {})),
                          ContainsSubstring("the kernels that were compiled with csgrt, no others"));
    const Program program(device, "partitions");
    CHECK_THROWS_WITH(program.kernel("list_tiles"), ContainsSubstring("clCreateKernel (list_tiles)"));
    Kernel scan_sums = program.kernel("scan_sums");
    Buffer sums(device, "sums", 64);
    CHECK_THROWS_WITH(scan_sums.launch(64, 64, sums, cl_ulong{8}),
                      ContainsSubstring("clSetKernelArg (scan_sums, argument 1)"));
    CHECK_THROWS_WITH(scan_sums.launch(64, 0x100000, sums, cl_uint{8}),
                      ContainsSubstring("clEnqueueNDRangeKernel (scan_sums"));
}

TEST_CASE("the native device draws the same bits with any number of threads", "[device][promise:bits]") {
    if (!have_native()) return;
    const Scene scene = stress::scene_of_parts(60);
    Settings settings{.device = "native", .threads = 1};
    Renderer one(scene, {}, settings);
    const std::vector<Ray> rays = test::random_rays(one.model().bounds(), 2000);
    settings.threads = GENERATE(2u, 5u);
    Renderer several(scene, {}, settings);
    for (const bool every : {false, true}) {
        View view{.width = 203, .height = 157, .every_partition = every};
        test::require_same(one.render(view), several.render(view));
    }
    test::require_same(one.shoot(rays), several.shoot(rays));
}

TEST_CASE("native devices draw for several renderers at once", "[device][promise:models]") {
    if (!have_native()) return;
    const Scene scene = stress::scene_of_parts(60);
    Settings settings{.device = "native"};
    View view{.width = 150, .height = 150};
    const Image alone = Renderer(scene, {}, settings).render(view);
    std::vector<Image> images(3);
    std::vector<std::thread> threads;
    for (Image& image : images)
        threads.emplace_back([&] {
            Renderer renderer(scene, {}, settings);
            for (int frame = 0; frame < 3; ++frame) image = renderer.render(view);
        });
    for (std::thread& thread : threads) thread.join();
    for (const Image& image : images) test::require_same(image, alone);
}
