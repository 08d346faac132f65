#include "pipeline/passes/scene_tables.hpp"

#include <span>

namespace csgrt {

SceneTables::SceneTables(Device& device, const CompiledScene& scene, const RecordConverter::Tables& tables)
    : scene_(scene),
      solids_(device, "solids", tables.solids),
      reals_(device, "solids' parameters", tables.reals),
      planes_(device, "planes", tables.planes),
      words_(device, "solids' parts", scene.words.get()),
      inner_nodes_(device, "bounding volumes of solids' parts", tables.inner_nodes),
      nodes_(device, "bounding volumes", tables.nodes),
      starts_(device, "solids' terms", scene.starts.get()),
      trees_(device, "trees", scene.trees.get()),
      materials_(device, "materials", scene.materials.get()),
      lights_(device, "lights"),
      display_(device, "bytes of a display", scene.display.get()) {}

bool SceneTables::takes(const CompiledScene& scene) const {
    return scene.reals.shares(scene_.reals) && scene.planes.shares(scene_.planes) && scene.words.shares(scene_.words) &&
           scene.inner_nodes.shares(scene_.inner_nodes) && scene.nodes.shares(scene_.nodes) &&
           scene.trees.shares(scene_.trees);
}

void SceneTables::take(const CompiledScene& scene, const RecordConverter::Tables& tables) {
    const auto replace = [](Buffer& buffer, const auto& values) {
        buffer.reserve(std::span(values).size_bytes());
        if (!values.empty()) buffer.upload(values.data(), std::span(values).size_bytes());
    };
    if (!scene.solids.shares(scene_.solids)) replace(solids_, tables.solids);
    if (!scene.starts.shares(scene_.starts)) replace(starts_, scene.starts.get());
    if (!scene.materials.shares(scene_.materials)) replace(materials_, scene.materials.get());
    if (!scene.display.shares(scene_.display)) replace(display_, scene.display.get());
    scene_ = scene;
}

void SceneTables::set_lights(const std::vector<std::byte>& lights) {
    lights_.reserve(lights.size());
    if (!lights.empty()) lights_.upload(lights);
}

}  // namespace csgrt
