// All five kernels as C++ in exactly sized buffers against the reference: under the sanitizers this finds what a device
// would do in silence.
#include <bit>
#include <cstring>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "kernels/host_kernels.hpp"
#include "integration/scenes.hpp"
#include "reference/reference.hpp"

using namespace csgrt;

TEST_CASE("the kernels, run on the host, draw what the reference draws", "[kernels][promise:bits]") {
    const auto files = test::scene_files();
    for (const std::string& file : files) {
        INFO(file);
        const Scene scene = load_scene(file);
        const CompiledScene compiled = compile(scene);
        const auto kernels = make_double_kernels(compiled, Quartic::bracketed);
        for (const double perspective : {0.0, 40.0}) {
            View view;
            view.width = 50;  // not a multiple of the tile
            view.height = 37;
            view.camera = scene.camera;
            view.camera.perspective = perspective;
            const PreparedFrame prepared = prepare_frame(compiled, view);
            const test::HostRun run = test::run_kernels(compiled, prepared);
            ReferenceCounts counts;
            const std::vector<kernel::Pixel> expected = Reference(compiled, *kernels).render(prepared, nullptr, counts);
            CHECK(2 * run.offsets.back().segments == counts.ends);
            const auto differing = [&](const std::vector<float>& picture, bool counted) {
                std::size_t different = 0;
                const std::size_t size = expected.size();
                for (std::size_t i = 0; i < size; ++i) {
                    const kernel::Pixel& p = expected[i];
                    const float values[] = {p.rgba[0],
                                            p.rgba[1],
                                            p.rgba[2],
                                            p.rgba[3],
                                            p.z,
                                            p.normal[0],
                                            p.normal[1],
                                            p.normal[2],
                                            std::bit_cast<float>(p.region),
                                            std::bit_cast<float>(p.solid),
                                            float(p.depth),
                                            float(p.partitions),
                                            float(p.overlap)};
                    for (std::size_t c = 0; c < (counted ? 13 : 10); ++c)
                        different += std::memcmp(&picture[c * size + i], &values[c], sizeof(float)) != 0;
                }
                return different;
            };
            CHECK(differing(run.picture, true) == 0);
            PreparedFrame first = prepared;
            first.frame.every_partition = 0;
            first.frame.channels &= ~CHANNEL_COUNTS;
            std::vector<float> picture;
            if (test::run_first_hits(compiled, first, picture) == 0) CHECK(differing(picture, false) == 0);
        }
    }
}
