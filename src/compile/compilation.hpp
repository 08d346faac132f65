// Compilation: the steps from a scene to its compiled form, with what lies between them, so that after an edit only the
// changed part goes through them again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/bounds/instance_bounds.hpp"
#include "compile/bvh/space.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/half_spaces.hpp"
#include "compile/pack_scene.hpp"
#include "scene/edit_scene.hpp"
#include "scene/faults/validate.hpp"

namespace csgrt {

/// A compiled scene, and the data from which it was made. One thread at a time.
class Compilation {
public:
    /// Validates and compiles `objects` of `scene` (empty: its top objects). `most_kept`: of more instances it keeps
    /// nothing. Throws Error (scene) with every finding.
    Compilation(std::shared_ptr<const Scene> scene, const std::vector<std::string>& objects,
                const CompileOptions& options, std::size_t most_kept);
    Compilation(const Compilation&) = delete;

    const CompiledScene& compiled() const { return compiled_; }
    const std::shared_ptr<const Scene>& scene() const { return scene_; }
    const Names& names() const { return names_; }
    /// The objects that it renders, by the caller's names or as the scene's top objects.
    const std::vector<std::string>& roots() const { return roots_; }
    bool is_kept() const { return is_kept_; }
    /// Whether with() gave up half way, so that nothing more can be asked of this compilation.
    bool is_spent() const { return is_spent_; }

    /// Compiles the scene with `changes`, to the bits of a scene compiled anew. `before`: a compiled form with the
    /// changes `of_before`; the result has its appearance. Nothing: the scene has to be compiled anew. This is so where
    /// a part could change other parts: the model's sphere changes, there are half-spaces or lights, meshes move,
    /// instances become equal, a solid is beyond a limit, or a shell between solids is lost; and if a removed part is
    /// back, or had a warning.
    std::optional<CompiledScene> with(const SceneChanges& changes, const CompiledScene& before,
                                      const SceneChanges& of_before);

private:
    bool take_out(const SceneChanges& changes, std::vector<std::uint32_t>& regions);
    bool place(const SceneChanges& changes, const ChangedMembers& moved, std::vector<std::uint32_t>& regions);
    bool number(const std::vector<std::uint32_t>& moved);
    void pack();
    void add_different(const MemberMatrices& a, const MemberMatrices& b, ChangedMembers& found) const;

    std::shared_ptr<const Scene> scene_;
    Names names_;
    std::vector<std::string> roots_;
    SceneChanges changes_;  ///< of the scene
    Validated validated_;
    FlatScene flat_;
    std::optional<InstanceBounds> measured_;
    Clipped clipped_;
    std::vector<std::uint32_t> instances_;  ///< all that no change has removed, ascending
    std::vector<std::uint32_t> order_;      ///< the same, as solids are numbered
    std::vector<kernel::SolidRecord> terms_;
    std::optional<ScenePacker> packer_;
    std::vector<Warning> warnings_;  ///< of the steps before packing
    bool is_kept_ = false;           ///< packer_ can lay out more than once
    bool is_local_ = true;           ///< a part can be compiled by itself
    bool is_spent_ = false;
    CompiledScene compiled_;
};

}  // namespace csgrt
