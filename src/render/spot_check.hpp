// What devices draw and shoot, traced by the CPU reference as well: some batches of it, bit by bit.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/batch.hpp"
#include "reference/reference.hpp"
#include "render/backend.hpp"

namespace csgrt {

class SpotCheck {
public:
    /// The first batch is looked at, and every n-th after it, n being Settings::check; none if that is 0. The settings
    /// must outlive this.
    explicit SpotCheck(const Settings& settings) : settings_(settings) {}

    /// The next batches are another scene's.
    void forget_scene() { reference_.reset(); }

    /// Throws Error (device_fault) that names the first pixel and channel, or the first ray, whose bits differ;
    /// (interrupted) if `watch` says so. `batches`: those of a call that `device` has answered.
    void look_at(const CompiledScene& scene, const PreparedFrame& frame, const FrameMemory& memory,
                 const std::vector<RayBatch>& batches, const std::string& device, Watch& watch);
    void look_at(const CompiledScene& scene, const kernel::Frame& frame, const RayList& rays, const RowTaker& taker,
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
