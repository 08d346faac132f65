// What a Model holds. Nothing of it changes, but for what is made when it is first needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/model.hpp>

#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/compiled_scene.hpp"
#include "pipeline/passes/native_tracer.hpp"
#include "reference/reference.hpp"
#include "render/list_calls.hpp"

namespace csgrt {

/// Traces rays through a compiled scene on the caller's thread. Any thread.
class CallerTracer {
public:
    /// The scene must outlive it. `tolerance`: millimetres.
    CallerTracer(const CompiledScene& scene, double tolerance) : scene_(scene), tolerance_(tolerance) {}
    /// Puts the rows of a list.
    void trace(const RayList& list, RowTaker& taker) const;

private:
    /// Null: this processor has none.
    const NativeTracer* native() const;
    const Reference& reference() const;

    const CompiledScene& scene_;
    double tolerance_;
    mutable std::once_flag has_native_, has_reference_;
    mutable std::optional<NativeTracer> native_;
    mutable std::unique_ptr<ReferenceKernels> kernels_;
    mutable std::optional<Reference> reference_;
};

/// What a Model is made of.
struct ModelSource {
    std::shared_ptr<const Scene> scene;  ///< but for its looks, lights, ambient light and background
    std::vector<Look> looks;
    std::vector<Light> lights;
    double ambient;
    Vec3 background;
    std::vector<std::string> objects;
    Settings settings;

    /// Gives a scene what stands beside it here.
    void put_looks(Scene& to) const {
        to.looks = looks;
        to.lights = lights;
        to.ambient = ambient;
        to.background = background;
    }
};

struct Model::Impl {
    ModelSource source;
    CompiledScene scene;  ///< all regions claim
    double tolerance;     ///< millimetres, in double precision
    double compile_ms;    ///< to compile it
    std::optional<CompiledScene> some_shown, some_ghosts;

    /// Compiles. Throws Error (scene, usage).
    explicit Impl(ModelSource of);
    /// Of tables that are made, of which it derives those of the regions' states.
    Impl(ModelSource of, CompiledScene made, const Impl& before);

    /// Where the regions claim that `which` is about.
    const CompiledScene& of(Claims which) const {
        return which == Claims::shown && some_shown ? *some_shown : which == Claims::ghosts ? *some_ghosts : scene;
    }
    bool has_ghosts() const { return some_ghosts.has_value(); }

    /// Calls work(trace), which computes on the caller's thread.
    template <class Work>
    void call(const Work& work) const {
        const FloatingPoint own;
        const AllowedThreads alone(1);
        work([this](const RayList& list, RowTaker& taker, Claims claims) {
            (claims == Claims::shown && some_shown ? *shown_ : *all_).trace(list, taker);
        });
    }

private:
    void find_states();

    std::optional<CallerTracer> all_, shown_;
};

/// Throws Error (usage) for a setting that is no finite number.
void check_numbers(const Settings& settings);
/// The tolerance that the settings ask for, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
