#include "pipeline/passes/first_hits.hpp"

namespace csgrt {
namespace {

/// Is the hierarchy larger than the processor's caches?
bool is_large(const CompiledScene& scene) { return scene.nodes.size() > 1u << 18; }

bool prefetches(const Device& device, const CompiledScene& scene, const Settings& settings) {
    return traces_packets(device, settings) && is_large(scene);
}

std::vector<std::string> options_of(const Device& device, const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> options = program_options(device, ProgramNeeds(scene), settings);
    options.push_back("CSGRT_PRIVATE_BOUNDARIES");
    if (prefetches(device, scene, settings)) options.push_back("CSGRT_PREFETCH");
    if (scene.solids.size() > 32) options.push_back("CSGRT_FEW=64u");  // measured: docs/experiments.md
    return options;
}

}  // namespace

FirstHitPass::FirstHitPass(Device& device, const CompiledScene& scene, const Settings& settings)
    : device_(device),
      rays_an_item_(traces_packets(device, settings) ? packet_rays : 1),
      program_(device,
               program_source(
                   device.info(), settings, native_program(scene),
                   {CullPass::file, rays_an_item_ == 1 ? "shading/first_hits_ray.h" : "packet/first_hits_packet.h",
                    "first_hits.cl"}),
               options_of(device, scene, settings), settings.precision != Precision::double_),
      cull_(device, program_),
      first_hits_(program_.kernel("first_hits")) {}

const char* FirstHitPass::native_program(const CompiledScene& scene) {
    return is_large(scene) ? "first_hits_prefetch" : "first_hits";
}

TimedKernels FirstHitPass::launch(const SceneTables& scene, BatchBuffers& batch, const Buffer& picture,
                                  std::uint32_t rays) {
    batch.overflown.reserve(rays * ray_bytes);
    TimedKernels timed;
    timed.emplace_back(&PipelineCounts::first_hits,
                       first_hits_.launch(rays / rays_an_item_, divergent_group(device_), batch.frame, scene.geometry(),
                                          scene.nodes(), scene.regions(), scene.appearance(), batch.tile_nodes,
                                          batch.tiles, batch.report, batch.overflown, picture));
    return timed;
}

}  // namespace csgrt
