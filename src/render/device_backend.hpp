// Devices as a backend: those that draw at once, and those that take over when their kernels are compiled.
#pragma once

#include "render/backend.hpp"
#include "render/device_takeover.hpp"
#include "render/spot_check.hpp"

namespace csgrt {

class DeviceBackend final : public Backend {
public:
    /// `search_ms`: what it took to find the plan's devices. The scene, the kernels and the settings must outlive it.
    /// Throws Error.
    DeviceBackend(DevicePlan plan, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings,
                  double search_ms);

    void prepare(bool every_partition) override;
    void render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) override;
    void trace(const kernel::Frame& frame, const RayList& rays, RowSink& sink, Watch& watch) override;
    void check(const kernel::Frame& frame, const RayList& rays, const Partitions& answer, Fields fields,
               Watch& watch) override;
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

    double search_ms_;
    SpotCheck spot_check_;
    DeviceTakeover takeover_;
    DeviceGroup* drawer_ = nullptr;  ///< of the next call
    PipelineCounts counts_;
    double build_ms_in_call_ = 0;
};

}  // namespace csgrt
