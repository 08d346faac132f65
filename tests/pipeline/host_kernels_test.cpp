// All five kernels as C++ in exactly sized buffers against the reference: under the sanitizers this finds what a device
// would do in silence.
#include <cstring>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "pipeline/host_kernels.hpp"
#include "pipeline/scenes.hpp"
#include "reference/reference.hpp"

using namespace csgrt;

TEST_CASE("the kernels, run on the host, draw what the reference draws", "[kernels]") {
    const auto files = test::scene_files();
    if (files.empty()) WARN("CSGRT_SCENES names no folder of scenes: nothing compared");
    for (const std::string& file : files) {
        INFO(file);
        const Scene scene = load_scene(file);
        const CompiledScene compiled = compile(scene);
        const auto kernels = make_double_kernels(compiled, Quartic::bracketed);
        for (const double perspective : {0.0, 40.0}) {
            View view;
            view.width = 50;  // not a multiple of the block
            view.height = 37;
            view.camera = scene.camera;
            view.camera.perspective = perspective;
            const PreparedFrame prepared = prepare_frame(compiled, view);
            const test::HostRun run = test::run_kernels(compiled, prepared);
            ReferenceCounts counts;
            const std::vector<kernel::Pixel> expected = Reference(compiled, *kernels, 1).render(prepared, nullptr, counts);
            CHECK(2 * run.offsets.back().segments == counts.hits);
            std::size_t different = 0;
            for (std::uint32_t i = 0; i < run.pixels.size(); ++i) {
                const kernel::pixel_position at = kernel::pixel_of(i, prepared.frame.width, prepared.frame.height);
                if (!at.inside) continue;
                different += std::memcmp(&run.pixels[i], &expected[at.y * prepared.frame.width + at.x], sizeof(kernel::Pixel)) != 0;
            }
            CHECK(different == 0);
        }
    }
}
