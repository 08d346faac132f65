// Device backend: draws on devices that need no compiler, and on other devices once their kernels are compiled.
#pragma once

#include <mutex>

#include "render/backend.hpp"
#include "render/device_takeover.hpp"
#include "render/spot_check.hpp"

namespace csgrt {

/// The backend draws and traces on a group of devices. While a GPU's kernels are compiled, a native device answers
/// calls; later calls use the GPU.
class DeviceBackend final : public Backend {
public:
    /// Sets up the plan's devices. `search_ms`: the time that finding them took. The settings must outlive the backend.
    /// Throws Error.
    DeviceBackend(DevicePlan plan, std::shared_ptr<const ModelInUse> model, const Settings& settings, double search_ms);

    /// Sets the model. Devices get it when they are next used.
    void set_model(std::shared_ptr<const ModelInUse> model) override;
    void prepare(bool every_partition) override;
    bool draws_edges(const PreparedFrame& frame) const override {
        return !spot_check_.is_on() && drawer_ && drawer_->draws_edges(frame);  // the reference draws none
    }
    bool has_drawn_edges() const override { return counts_.has_edges; }
    void render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) override;
    void trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch& watch) override;
    void check(const kernel::Frame& frame, const RayList& rays, const RowReceiver& receiver, Watch& watch) override;
    std::string name() const override { return group().name(); }
    void report(Statistics& statistics) const override;
    std::string method(bool every_partition) const override;
    double build_ms_in_call() const override { return build_ms_in_call_; }
    std::string awaited() const override { return takeover_.awaited(); }
    std::optional<std::string> take_fault() override { return takeover_.take_fault(); }

private:
    const DeviceGroup& group() const { return drawer_ ? *drawer_ : takeover_.present(); }
    template <class Call>
    void counted(const Call& call);

    void adapt(DeviceGroup& group) const;
    std::shared_ptr<const ModelInUse> model() const {
        const std::lock_guard lock(mutex_);
        return model_;
    }

    mutable std::mutex mutex_;
    std::shared_ptr<const ModelInUse> model_;  ///< the takeover's job reads it, too
    double search_ms_;
    SpotCheck spot_check_;
    std::uint64_t* retried_;  ///< Laboratory::retried
    DeviceTakeover takeover_;
    DeviceGroup* drawer_ = nullptr;  ///< the group for the next call
    PipelineCounts counts_;
    double build_ms_in_call_ = 0;
};

}  // namespace csgrt
