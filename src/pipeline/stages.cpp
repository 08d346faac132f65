#include "pipeline/stages.hpp"

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
      nodes(device, "bounding volumes", tables.nodes) {}

std::vector<std::string> defines_of(const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> defines = {
            "CSGRT_SOLIDS=" + std::to_string(scene.solid_types) + "u",
            "CSGRT_TREE_STACK=" + std::to_string(std::max(1u, scene.tree_stack)),
            "CSGRT_QUARTIC=" + std::to_string(static_cast<int>(settings.quartic))};
    if (settings.precision == Precision::single) defines.push_back("CSGRT_EYE_RELATIVE");
    if (settings.contraction) defines.push_back("CSGRT_CONTRACT");
    return defines;
}

}  // namespace csgrt
