// What a Model holds. Nothing of it changes, but for what is made when it is first needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include <csgrt/model.hpp>

#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/compiled_scene.hpp"
#include "pipeline/passes/native_tracer.hpp"
#include "reference/reference.hpp"
#include "render/list_calls.hpp"

namespace csgrt {

struct Model::Impl {
    CompiledScene scene;
    std::string title;
    double tolerance = 0;   ///< millimetres, in double precision
    double compile_ms = 0;  ///< to compile it

    /// Calls work(trace), which computes on the caller's thread.
    template <class Work>
    void call(const Work& work) const {
        const FloatingPoint own;
        const AllowedThreads alone(1);
        work([this](const RayList& list, RowTaker& taker) { trace(list, taker); });
    }

private:
    void trace(const RayList& list, RowTaker& taker) const;
    /// Null: this processor has none.
    const NativeTracer* tracer() const;
    const Reference& reference() const;
    mutable std::once_flag has_tracer_, has_reference_;
    mutable std::optional<NativeTracer> tracer_;
    mutable std::unique_ptr<ReferenceKernels> kernels_;
    mutable std::optional<Reference> reference_;
};

/// The tolerance that the settings ask for, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
