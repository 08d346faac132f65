// PoCL compiles the kernels with kernels/shared/builtins.h in place of its own declarations; a function that is missing
// there would cost every start two builds.
#include <string>
#include <vector>

#include "base/laboratory.hpp"
#include "catch.hpp"
#include "device/choice.hpp"
#include "device/program.hpp"
#include "integration/every_type.hpp"
#include "pipeline/passes/program_options.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

void require_own_declarations(const std::vector<Settings>& all) {
    const std::vector<FoundDevice> found = find_devices().devices;
    Device device(found[choose_device(infos_of(found), "cpu", Kernels::compiled_by_device)]);
    if (test::sanitized) return;  // it is PoCL that works here: three programs of all types of solids
    if (!is_pocl(device.info()) || !device.info().driver.starts_with("3.")) {
        WARN("the processor's driver is not PoCL 3: nothing seen");
        return;
    }
    Scene own;
    std::vector<std::string> objects;
    own.objects.push_back(Solid{"ball", Ell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}});
    own.top = {"ball"};
    const CompiledScene scene = compile(test::with_every_type(own, objects), objects);
    for (const Settings& settings : all) {
        const bool is_single = settings.precision != Precision::double_;
        INFO((is_single ? "single" : "double"));
        std::vector<std::string> defines = program_options(device, ProgramNeeds(scene), settings);
        CHECK(std::erase(defines, "CSGRT_PACKETS") == !is_single);  // with them last
        const auto require_own = [&](const std::vector<std::string>& files) {
            INFO(files.back());
            const Program program(device, assemble_program(files), defines, is_single);
            CHECK(program.has_own_declarations());
            CHECK(program.build_log() == "");
        };
        std::vector<std::string> exact = {"0_cull_tiles.cl",     "1_count_segments.cl", "scan.cl",
                                          "2_store_segments.cl", "2_rays_in_faces.cl",  "3_weave.cl",
                                          "4_evaluate.cl",       "5_shade.cl"};
        require_own(exact);
        require_own({"tile_list.cl"});
        defines.push_back("CSGRT_PRIVATE_BOUNDARIES");
        require_own({"0_cull_tiles.cl", "shading/first_hits_ray.h", "first_hits.cl"});
        defines.push_back("CSGRT_PACKETS");
        if (is_single) continue;
        require_own({"0_cull_tiles.cl", "packet/first_hits_packet.h", "first_hits.cl"});
        std::erase(defines, "CSGRT_PRIVATE_BOUNDARIES");
        exact.insert(exact.begin() + 1, "1_packet_candidates.cl");
        require_own(exact);
    }
}

}  // namespace

TEST_CASE("kernels use no function of OpenCL C that builtins.h lacks", "[promise:bits]") {
    require_own_declarations({Settings{}});
}

TEST_CASE("kernels in single precision use no function of OpenCL C that builtins.h lacks", "[.pocl][promise:bits]") {
    require_own_declarations({{.precision = Precision::single}, with_methods({.single_world = true})});
}

TEST_CASE("a source with a function that builtins.h lacks is built with the driver's declarations") {
    const std::vector<FoundDevice> found = find_devices().devices;
    Device device(found[choose_device(infos_of(found), "cpu", Kernels::compiled_by_device)]);
    const Program program(device, "__kernel void turn(__global float* x) { x[0] = cos(x[0]); }");
    CHECK_FALSE(program.has_own_declarations());
    CHECK(program.build_log() == "");
    program.kernel("turn");
}
