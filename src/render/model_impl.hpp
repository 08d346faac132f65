// Model implementation: the data of a Model. The data do not change, except for parts that are made when they are first
// needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <csgrt/model.hpp>

#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/compiled_scene.hpp"
#include "pipeline/passes/native_tracer.hpp"
#include "rays/calls.hpp"
#include "reference/reference.hpp"
#include "scene/names.hpp"

namespace csgrt {

/// The tracer of a compiled scene on the caller's thread. Any thread may call it.
class CallerTracer {
public:
    /// Refers to the scene, which must outlive it. `tolerance`: millimetres.
    CallerTracer(const CompiledScene& scene, double tolerance) : scene_(scene), tolerance_(tolerance) {}
    /// Traces a list and puts its rows into the receiver.
    void trace(const RayList& list, RowReceiver& receiver) const;

private:
    /// The tracer of native kernels; null: this processor has no such kernels.
    const NativeTracer* native() const;
    const Reference& reference() const;

    const CompiledScene& scene_;
    double tolerance_;
    mutable std::once_flag has_native_, has_reference_;
    mutable std::optional<NativeTracer> native_;
    mutable std::unique_ptr<ReferenceKernels> kernels_;
    mutable std::optional<Reference> reference_;
};

/// The input of a Model.
struct ModelSource {
    std::shared_ptr<const Scene> scene;  ///< without its appearances, lights, ambient light and background
    std::vector<Look> looks;
    std::vector<Light> lights;
    double ambient;
    Vec3 background;
    std::vector<std::string> objects;
    Settings settings;

    /// Copies the members below into a scene.
    void put_appearance(Scene& to) const {
        to.looks = looks;
        to.lights = lights;
        to.ambient = ambient;
        to.background = background;
    }
};

/// What is at a path, for one scene and its regions. Any thread.
class PathIndex {
public:
    const Names& names(const Scene& scene) const;
    /// The index of a region; -1: none has the path.
    std::int32_t region(const std::vector<RegionInfo>& regions, const std::string& path) const;

private:
    mutable std::once_flag has_names_, has_regions_;
    mutable std::optional<Names> names_;
    mutable std::unordered_map<std::string_view, std::int32_t> regions_;
};

/// The scene, its compiled forms, and the tracers of the caller's thread. If pictures do not show some regions, there
/// are two more compiled forms, in which only the shown regions or only the ghosts claim; they share nearly all tables.
struct Model::Impl final : ListTracer {
    ModelSource source;
    CompiledScene scene;  ///< the form in which all regions claim
    double tolerance;     ///< millimetres, in double precision
    double compile_ms;    ///< the time of compiling the scene
    std::optional<CompiledScene> some_shown, some_ghosts;
    PathIndex paths;

    /// Compiles the scene. Throws Error (scene, usage).
    explicit Impl(ModelSource of);
    /// Takes a scene that is compiled already, and derives the forms for regions' states from it.
    Impl(ModelSource of, CompiledScene made, const Impl& before);

    /// The scene in which the regions of `which` claim.
    const CompiledScene& of(ClaimingRegions which) const {
        return which == ClaimingRegions::shown && some_shown ? *some_shown
               : which == ClaimingRegions::ghosts            ? *some_ghosts
                                                             : scene;
    }
    bool has_ghosts() const { return some_ghosts.has_value(); }

    void trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims) const override {
        (claims == ClaimingRegions::shown && some_shown ? *shown_ : *all_).trace(list, receiver);
    }
    /// Calls work(tracer), which computes on the caller's thread.
    template <class Work>
    void call(const Work& work) const {
        const FloatingPoint own;
        const AllowedThreads alone(1);
        work(*this);
    }

private:
    void find_states();

    std::optional<CallerTracer> all_, shown_;
};

/// Throws Error (usage) for a setting that is not a finite number.
void check_numbers(const Settings& settings);
/// The tolerance of the settings, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
