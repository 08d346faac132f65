#include "pipeline/passes/scene_tables.hpp"

namespace csgrt {

SceneTables::SceneTables(Device& device, const CompiledScene& scene, const HostKernels::Tables& tables)
    : solids_(device, "solids", tables.solids),
      reals_(device, "solids' parameters", tables.reals),
      planes_(device, "planes", tables.planes),
      words_(device, "solids' parts", scene.words),
      inner_nodes_(device, "bounding volumes of solids' parts", tables.inner_nodes),
      nodes_(device, "bounding volumes", tables.nodes),
      starts_(device, "solids' terms", scene.starts),
      trees_(device, "trees", scene.trees),
      materials_(device, "materials", scene.materials),
      lights_(device, "lights") {}

void SceneTables::set_lights(const std::vector<std::byte>& lights) {
    lights_.reserve(lights.size());
    if (!lights.empty()) lights_.upload(lights);
}

}  // namespace csgrt
