// Spot check: the CPU reference traces some batches of the devices' pictures and lists, too, and compares them bit by
// bit.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/batch.hpp"
#include "reference/reference.hpp"
#include "render/backend.hpp"

namespace csgrt {

/// Compares batches with the reference. A difference of one bit fails the call (Settings::check).
class SpotCheck {
public:
    /// Checks the first batch, and every n-th after it, n being Settings::check; none if it is 0. The settings must
    /// outlive the object.
    explicit SpotCheck(const Settings& settings) : settings_(settings) {}

    /// Forgets the scene: the next batches are another's.
    void forget_scene() { reference_.reset(); }

    /// Throws Error (device_fault) that names the first pixel and channel, or the first ray, whose bits differ;
    /// (interrupted) if `watch` says so. `batches`: those of a call that `device` has answered.
    void compare(const CompiledScene& scene, const PreparedFrame& frame, const FrameMemory& memory,
                 const std::vector<RayBatch>& batches, const std::string& device, Watch& watch);
    void compare(const CompiledScene& scene, const kernel::Frame& frame, const RayList& rays, const RowReceiver& given,
                 const std::vector<RayBatch>& batches, const std::string& device, Watch& watch);

private:
    std::vector<std::uint32_t> rays_of(const std::vector<RayBatch>& batches);
    const Reference& reference(const CompiledScene& scene);

    const Settings& settings_;
    std::uint64_t batches_ = 0;  ///< of all calls
    std::unique_ptr<ReferenceKernels> kernels_;
    std::optional<Reference> reference_;
};

}  // namespace csgrt
