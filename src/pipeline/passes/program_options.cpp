#include "pipeline/passes/program_options.hpp"

#include <algorithm>

#include "base/laboratory.hpp"
#include "device/discovery.hpp"

namespace csgrt {
namespace {

/// Does the scene have lights with a direction or a beam, glow, or regions that no picture shows?
bool has_shaped_lights(const CompiledScene& scene) {
    const auto is_shaped = [](const kernel::LightRecord& light) { return light.w == 0 || light.beam; };
    const auto glows = [](const kernel::MaterialRecord& material) { return material.glow != 0; };
    return scene.rank_ends[RANK_HIDDEN] > scene.rank_ends[RANK_AIR] ||
           std::any_of(scene.lights.begin(), scene.lights.end(), is_shaped) ||
           std::any_of(scene.materials.begin(), scene.materials.end(), glows);
}

}  // namespace

std::size_t divergent_group(const Device& device) { return device.info().type == "cpu" ? 1 : work_group; }

bool traces_packets(const Device& device, const Settings& settings) {
    return device.info().type == "cpu" && settings.precision == Precision::double_;
}

ProgramNeeds::ProgramNeeds(const CompiledScene& scene)
    : solid_types(scene.solid_types), large_terms(scene.has_large_terms), shaped_lights(has_shaped_lights(scene)) {}

bool draws(const Device& device, const ProgramNeeds& one, const ProgramNeeds& other) {
    return is_native(device.info()) || one.covers(other);
}

std::vector<std::string> program_options(const Device& device, const ProgramNeeds& needs, const Settings& settings) {
    const Laboratory& methods = laboratory(settings);
    std::vector<std::string> options = {"CSGRT_SOLIDS=" + std::to_string(needs.solid_types) + "u",
                                        "CSGRT_QUARTIC=" + std::to_string(static_cast<int>(methods.quartic))};
    if (settings.precision == Precision::single && !methods.single_world) options.push_back("CSGRT_EYE_RELATIVE");
    if (methods.contraction) options.push_back("CSGRT_CONTRACT");
    if (traces_packets(device, settings)) options.push_back("CSGRT_PACKETS");
    if (needs.large_terms) options.push_back("CSGRT_LARGE_TERMS");
    if (needs.shaped_lights) options.push_back("CSGRT_SHAPED_LIGHTS");
    return options;
}

}  // namespace csgrt
