// The CPU reference as a backend.
#pragma once

#include "reference/reference.hpp"
#include "render/backend.hpp"

namespace csgrt {

class ReferenceBackend final : public Backend {
public:
    /// Both must outlive it.
    ReferenceBackend(const CompiledScene& scene, const ReferenceKernels& kernels) : reference_(scene, kernels) {}

    void prepare(bool) override {}
    void render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) override;
    void trace(const kernel::Frame& frame, const RayList& rays, RowSink& sink, Watch& watch) override;
    std::string name() const override { return "reference"; }
    void report(Statistics& statistics) const override;
    std::string method(bool) const override { return "every solid near the ray, unique lists"; }

private:
    Reference reference_;
    ReferenceCounts counts_;
};

}  // namespace csgrt
