// What a Model holds. Nothing of it changes, but for what is made when it is first needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include <csgrt/model.hpp>

#include "compile/compiled_scene.hpp"
#include "pipeline/passes/native_tracer.hpp"
#include "reference/reference.hpp"

namespace csgrt {

struct Model::Impl {
    CompiledScene scene;
    std::string title;
    double tolerance = 0;   ///< millimetres, in double precision
    double compile_ms = 0;  ///< to compile it

    /// For calls on the caller's thread; null: this processor has none.
    const NativeTracer* tracer() const;
    const Reference& reference() const;

private:
    mutable std::once_flag has_tracer_, has_reference_;
    mutable std::optional<NativeTracer> tracer_;
    mutable std::unique_ptr<ReferenceKernels> kernels_;
    mutable std::optional<Reference> reference_;
};

/// The tolerance that the settings ask for, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
