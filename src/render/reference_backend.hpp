// Reference backend: draws pictures and traces lists by the CPU reference.
#pragma once

#include "reference/reference.hpp"
#include "render/backend.hpp"

namespace csgrt {

/// The backend draws and traces by the CPU reference, for comparison and where there is no device.
class ReferenceBackend final : public Backend {
public:
    explicit ReferenceBackend(std::shared_ptr<const ModelInUse> model) { set_model(std::move(model)); }

    void set_model(std::shared_ptr<const ModelInUse> model) override {
        if (model == model_) return;
        reference_.emplace(model->scene, *model->kernels);
        model_ = std::move(model);
    }
    bool is_reference() const override { return true; }

    void prepare(bool) override {}
    void render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) override;
    void trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch& watch) override;
    std::string name() const override { return "reference"; }
    void report(Statistics& statistics) const override;
    std::string method(bool) const override { return "every solid near the ray, unique lists"; }

private:
    std::shared_ptr<const ModelInUse> model_;
    std::optional<Reference> reference_;
    ReferenceCounts counts_;
};

}  // namespace csgrt
