// Spot check: the CPU reference also traces some batches of the devices' pictures and lists. The results are compared
// bit by bit.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/batch.hpp"
#include "reference/reference.hpp"
#include "render/backend.hpp"

namespace csgrt {

/// The check compares batches with the reference. A difference of one bit fails the call (Settings::check).
class SpotCheck {
public:
    /// Checks the first batch and every n-th batch after it; n is Settings::check, and 0 means no batch. The settings
    /// must outlive the object.
    explicit SpotCheck(const Settings& settings) : settings_(settings) {}

    bool is_on() const { return settings_.check != 0; }
    /// Forgets the scene: the next batches are of another scene.
    void forget_scene() { reference_.reset(); }

    /// Throws Error (device_fault) that names the first pixel and channel, or the first ray, whose bits differ; Error
    /// (interrupted) if `watch` ends the work. `batches`: the batches of a call on `device`.
    void compare(const CompiledScene& scene, const PreparedFrame& frame, const FrameMemory& memory,
                 const std::vector<RayBatch>& batches, const std::string& device, Watch& watch);
    void compare(const CompiledScene& scene, const kernel::Frame& frame, const RayList& rays, const RowReceiver& given,
                 const std::vector<RayBatch>& batches, const std::string& device, Watch& watch);

private:
    std::vector<std::uint32_t> rays_of(const std::vector<RayBatch>& batches);
    const Reference& reference(const CompiledScene& scene);

    const Settings& settings_;
    std::uint64_t batches_ = 0;  ///< number of batches of all calls
    std::unique_ptr<ReferenceKernels> kernels_;
    std::optional<Reference> reference_;
};

}  // namespace csgrt
