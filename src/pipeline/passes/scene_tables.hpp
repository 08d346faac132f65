// Scene tables: the compiled scene on the device.
#pragma once

#include <tuple>

#include "compile/compiled_scene.hpp"
#include "compile/records/converter.hpp"
#include "device/program.hpp"

namespace csgrt {

/// One buffer a table. Kernels take the tables in groups; each group is a macro of kernels/shared/scene_args.h.
class SceneTables {
public:
    SceneTables(Device& device, const CompiledScene& scene, const RecordConverter::Tables& tables);

    /// Whether take() can take a scene: it has the same solids with the same transforms.
    bool takes(const CompiledScene& scene) const;
    /// Takes a scene for which takes() is true: copies the tables that differ. Waits.
    void take(const CompiledScene& scene, const RecordConverter::Tables& tables);
    /// Uploads a frame's lights, as the kernels' records. Returns when the upload is done.
    void set_lights(const std::vector<std::byte>& lights);

    /// Uploads a frame's ends (PreparedFrame), in the same way.
    void set_ends(const std::vector<float>& ends);

    const Buffer& nodes() const { return nodes_; }  ///< the scene's hierarchy
    const Buffer& starting() const { return starting_; }
    const Buffer& ends() const { return ends_; }
    auto geometry() const { return std::tie(solids_, reals_, planes_, words_, inner_nodes_); }  ///< GEOMETRY_ARGS
    auto regions() const { return std::tie(starts_, trees_); }                                  ///< REGION_ARGS
    auto appearance() const { return std::tie(materials_, lights_, display_); }                 ///< APPEARANCE_ARGS
    /// EVALUATION_ARGS: of the geometry, evaluation needs only the solids' records.
    auto evaluation() const { return std::tie(solids_, starts_, trees_); }

private:
    CompiledScene scene_;  ///< the scene of the tables
    Buffer solids_, reals_, planes_, words_, inner_nodes_, nodes_, starts_, trees_, materials_, lights_, display_,
        starting_, ends_;
};

}  // namespace csgrt
