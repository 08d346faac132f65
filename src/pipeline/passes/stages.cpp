#include "pipeline/passes/stages.hpp"

#include <algorithm>

namespace csgrt {

SceneBuffers::SceneBuffers(Device& device, const CompiledScene& scene, const HostKernels::Tables& tables)
    : solids(device, "solids", tables.solids),
      reals(device, "solids' parameters", tables.reals),
      planes(device, "planes", tables.planes),
      plane_refs(device, "references to planes", scene.plane_refs),
      words(device, "solids' parts", scene.words),
      inner_nodes(device, "bounding volumes of solids' parts", tables.inner_nodes),
      starts(device, "solids' regions", scene.starts),
      leaves(device, "solids' leaves", scene.leaves),
      regions(device, "regions", scene.regions),
      trees(device, "trees", scene.trees),
      materials(device, "materials", scene.materials),
      nodes(device, "bounding volumes", tables.nodes),
      lights(device, "lights") {}

std::size_t uneven_group(const Device& device) { return device.info().type == "cpu" ? 1 : work_group; }

PipelineCounts& PipelineCounts::operator+=(const PipelineCounts& other) {
    hits += other.hits;
    segments += other.segments;
    partitions_used += other.partitions_used;
    partitions_allocated += other.partitions_allocated;
    overlaps += other.overlaps;
    segment_bytes += other.segment_bytes;
    partition_bytes += other.partition_bytes;
    batches += other.batches;
    drawn_again += other.drawn_again;
    count_hits += other.count_hits;
    scan += other.scan;
    store_segments += other.store_segments;
    weave += other.weave;
    evaluate += other.evaluate;
    shade += other.shade;
    cull_tiles += other.cull_tiles;
    first_hits += other.first_hits;
    return *this;
}

void add_times(const TimedKernels& timed, PipelineCounts& counts) {
    for (const auto& [time, kernel] : timed) counts.*time += milliseconds(kernel);
}

bool in_packets(const Device& device, const Settings& settings) {
    return device.info().type == "cpu" && settings.precision == Precision::double_;
}

/// Lights that are not plain points, that glow, or that are regions which no picture shows.
static bool has_shaped_lights(const CompiledScene& scene) {
    const auto is_shaped = [](const kernel::LightRecord& light) { return light.w == 0 || light.beam; };
    const auto glows = [](const kernel::MaterialRecord& material) { return material.glow != 0; };
    return scene.rank_ends[RANK_HIDDEN] > scene.rank_ends[RANK_AIR] ||
           std::any_of(scene.lights.begin(), scene.lights.end(), is_shaped) ||
           std::any_of(scene.materials.begin(), scene.materials.end(), glows);
}

std::vector<std::string> defines_of(const Device& device, const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> defines = {"CSGRT_SOLIDS=" + std::to_string(scene.solid_types) + "u",
                                        "CSGRT_QUARTIC=" + std::to_string(static_cast<int>(settings.quartic))};
    if (settings.precision == Precision::single) defines.push_back("CSGRT_EYE_RELATIVE");
    if (settings.contraction) defines.push_back("CSGRT_CONTRACT");
    if (in_packets(device, settings)) defines.push_back("CSGRT_PACKETS");
    if (scene.has_large_terms) defines.push_back("CSGRT_LARGE_TERMS");
    if (has_shaped_lights(scene)) defines.push_back("CSGRT_SHAPED_LIGHTS");
    return defines;
}

}  // namespace csgrt
