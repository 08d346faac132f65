// Model implementation: the data of a Model. The data do not change, except for parts that are made when they are first
// needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/model.hpp>

#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/compilation.hpp"
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

/// The last two compilations of a Model and of the Models that edits make of it: they share them. With the second, an
/// edit of a Model from before an edit that compiled anew is quick, too. A thread that finds them locked compiles
/// without them: no thread waits, nor does a child of fork().
struct KeptCompilation {
    std::mutex mutex;
    std::unique_ptr<Compilation> of, other;  ///< null: none is kept

    /// Makes `of` the compilation of a scene. False: none is kept.
    bool take(const std::shared_ptr<const Scene>& scene) {
        if (other != nullptr && other->scene() == scene) std::swap(of, other);
        return of != nullptr && of->scene() == scene;
    }
};

/// The input of a Model.
struct ModelSource {
    std::shared_ptr<const Scene> scene;  ///< without its appearances, lights, ambient light and background
    SceneChanges changes = {};           ///< of the scene, kept beside it
    std::vector<Look> looks = {};
    std::vector<Light> lights = {};
    double ambient = 0;
    Vec3 background = {};
    std::vector<std::string> objects;
    Settings settings;
    std::shared_ptr<KeptCompilation> kept;

    /// Copies the members above into a scene, from `looks` to `background`.
    void put_appearance(Scene& to) const {
        to.looks = looks;
        to.lights = lights;
        to.ambient = ambient;
        to.background = background;
    }
};

/// The scene, its compiled form, and the tracers of the caller's thread. If pictures do not show some regions, there
/// are two more forms, in which only the shown regions or only the ghosts claim. They share nearly all tables, and
/// exist as long as a Renderer or a tracer uses them: a Model that is kept for undo has none.
struct Model::Impl final : ListTracer {
    ModelSource source;
    CompiledScene scene;  ///< the form in which all regions claim
    double tolerance;     ///< millimetres, in double precision
    double compile_ms;    ///< the time of compiling the scene

    /// Compiles the scene. Throws Error (scene, usage).
    explicit Impl(ModelSource of);
    /// Takes a scene that is compiled already.
    Impl(ModelSource of, CompiledScene made, const Impl& before);

    /// The scene in which the regions of `which` claim.
    static std::shared_ptr<const CompiledScene> of(const std::shared_ptr<const Impl>& model, ClaimingRegions which) {
        const bool are_all = which == ClaimingRegions::all || (which == ClaimingRegions::shown && model->shows_all());
        if (are_all) return {model, &model->scene};
        return model->claimed(which == ClaimingRegions::shown ? State::shown : State::ghost);
    }
    bool shows_all() const { return !has(State::ghost) && !has(State::hidden); }
    bool has(State state) const;
    /// The names of the source's scene with its changes, found when they are first needed. Any thread.
    const Names& names() const;

    void trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims) const override;
    /// Calls work(tracer), which computes on the caller's thread.
    template <class Work>
    void call(const Work& work) const {
        const FloatingPoint own;
        const AllowedThreads alone(1);
        work(*this);
    }

private:
    std::shared_ptr<const CompiledScene> claimed(State by) const;

    std::optional<CallerTracer> all_;
    mutable std::once_flag has_names_;
    mutable std::shared_ptr<const Scene> named_scene_;
    mutable std::optional<Names> names_;
    mutable std::mutex mutex_;  ///< guards the next member
    mutable std::weak_ptr<const CompiledScene> claimed_[2];
    mutable std::once_flag has_shown_;
    mutable std::shared_ptr<const CompiledScene> shown_scene_;  ///< of the tracer
    mutable std::optional<CallerTracer> shown_;
};

/// Throws Error (usage) for a setting that is not a finite number.
void check_numbers(const Settings& settings);
/// The tolerance of the settings, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
