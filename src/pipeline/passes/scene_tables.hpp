// The compiled scene on the device.
#pragma once

#include <tuple>

#include "compile/compiled_scene.hpp"
#include "compile/host_kernels.hpp"
#include "device/program.hpp"

namespace csgrt {

/// One buffer a table. Kernels take them in groups, each of which is one macro there (kernels/shared/scene_args.h).
class SceneTables {
public:
    SceneTables(Device& device, const CompiledScene& scene, const HostKernels::Tables& tables);

    /// Whether another scene has the same solids in the same places.
    bool takes(const CompiledScene& scene) const;
    /// Such a scene's tables: copies those that differ. Waits.
    void take(const CompiledScene& scene, const HostKernels::Tables& tables);
    /// A frame's lights, as its kernels read them. Waits.
    void set_lights(const std::vector<std::byte>& lights);

    const Buffer& nodes() const { return nodes_; }  ///< the scene's hierarchy
    auto geometry() const { return std::tie(solids_, reals_, planes_, words_, inner_nodes_); }  ///< GEOMETRY_ARGS
    auto regions() const { return std::tie(starts_, trees_); }                                  ///< REGION_ARGS
    auto appearance() const { return std::tie(materials_, lights_, display_); }                 ///< APPEARANCE_ARGS
    /// EVALUATION_ARGS: of the geometry, evaluation needs the solids' records alone.
    auto evaluation() const { return std::tie(solids_, starts_, trees_); }

private:
    CompiledScene scene_;  ///< whose tables these are
    Buffer solids_, reals_, planes_, words_, inner_nodes_, nodes_, starts_, trees_, materials_, lights_, display_;
};

}  // namespace csgrt
