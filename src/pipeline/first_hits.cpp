#include "pipeline/first_hits.hpp"

#include "kernel_host/kernels.hpp"

namespace csgrt {
namespace {

std::vector<std::string> defines(const Device& device, const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> all = defines_of(device, scene, settings);
    all.push_back("CSGRT_PRIVATE_ENDS");
    constexpr std::size_t of_caches = 1u << 18;  // nodes of a scene that is larger than they are
    if (in_packets(device, settings) && scene.nodes.size() > of_caches) all.push_back("CSGRT_FETCH");
    if (scene.solids.size() > 32) all.push_back("CSGRT_FEW=64u");  // measured: docs/experiments/gpu-kernels.md
    return all;
}

}  // namespace

FirstHits::FirstHits(Device& device, const CompiledScene& scene, const Settings& settings, bool by_lines)
    : device_(device),
      rays_an_item_(in_packets(device, settings) ? packet_rays : 1),
      program_(device,
               assemble_program({Cull::file(by_lines), rays_an_item_ == 1 ? "first_hits_ray.h" : "first_hits_packet.h",
                                 "first_hits.cl"}),
               defines(device, scene, settings),
               settings.precision != Precision::double_),
      cull_(device, program_, by_lines),
      first_hits_(program_.kernel("first_hits")) {}

TimedKernels FirstHits::launch(const SceneBuffers& s, TileBuffers& tile, const Buffer& picture, std::uint32_t rays) {
    tile.overflown.reserve(rays * ray_bytes);
    TimedKernels timed;
    add_events(timed, &PipelineCounts::first_hits,
               first_hits_.launch_in_parts(rays / rays_an_item_, uneven_group(device_), tile.frame, s.solids, s.reals, s.planes,
                                           s.plane_refs, s.words, s.inner_nodes, s.nodes, s.regions, s.starts, s.leaves, s.trees,
                                           s.materials, s.lights, tile.lists, tile.rays, tile.tally, tile.overflown, picture));
    return timed;
}

}  // namespace csgrt
