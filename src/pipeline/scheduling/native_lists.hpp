// Native lists: traces a list of rays, batch by batch, on all threads with the native device's kernels.
#pragma once

#include "device/device.hpp"
#include "pipeline/passes/native_tracer.hpp"
#include "pipeline/scheduling/device_passes.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// Native lists trace lists on all threads of the host. Each thread takes the next batch of the list and traces it with
/// the NativeTracer.
class NativeLists {
public:
    /// Refers to the arguments, which must outlive the object.
    NativeLists(const native::Level& level, const CompiledScene& scene, const Device& device)
        : device_(device), tracer_(level, scene, device.budget()) {}

    /// Puts the rows of a range of the list into the receiver.
    void trace(const kernel::Frame& frame, const RayList& list, const RayNumbers& range, RowReceiver& receiver,
               const ReportDone& report_done, PipelineCounts& counts) const;

private:
    const Device& device_;
    NativeTracer tracer_;
};

}  // namespace csgrt
