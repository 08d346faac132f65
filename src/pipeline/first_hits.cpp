#include "pipeline/first_hits.hpp"

#include "kernel_host/kernels.hpp"

namespace csgrt {
namespace {

std::vector<std::string> defines(const Device& device, const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> all = defines_of(device, scene, settings);
    all.push_back("CSGRT_PRIVATE_ENDS");
    constexpr std::size_t of_caches = 1u << 18;  // nodes of a scene that is larger than they are
    if (in_packets(device, settings) && scene.nodes.size() > of_caches) all.push_back("CSGRT_PREFETCH");
    if (scene.solids.size() > 32) all.push_back("CSGRT_FEW=64u");  // measured: bench/NOTES.md
    return all;
}

}  // namespace

FirstHits::FirstHits(Device& device, const CompiledScene& scene, const Settings& settings)
    : device_(device),
      rays_an_item_(in_packets(device, settings) ? packet_rays : 1),
      program_(device,
               assemble_program({Cull::file, rays_an_item_ == 1 ? "shading/first_hits_ray.h" : "packet/first_hits_packet.h",
                                 "first_hits.cl"}),
               defines(device, scene, settings),
               settings.precision != Precision::double_),
      cull_(device, program_),
      first_hits_(program_.kernel("first_hits")) {}

TimedKernels FirstHits::launch(const SceneBuffers& s, BatchBuffers& batch, const Buffer& picture, std::uint32_t rays) {
    batch.overflown.reserve(rays * ray_bytes);
    TimedKernels timed;
    timed.emplace_back(&PipelineCounts::first_hits,
               first_hits_.launch(rays / rays_an_item_, uneven_group(device_), batch.frame, s.solids, s.reals, s.planes,
                                           s.plane_refs, s.words, s.inner_nodes, s.nodes, s.regions, s.starts, s.leaves, s.trees,
                                           s.materials, s.lights, batch.lists, batch.rays, batch.tally, batch.overflown, picture));
    return timed;
}

}  // namespace csgrt
