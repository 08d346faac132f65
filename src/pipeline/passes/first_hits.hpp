// First-hit pass: draws the first hits of a batch by one kernel, which stores only the picture.
#pragma once

#include "pipeline/counts.hpp"
#include "pipeline/passes/cull.hpp"

namespace csgrt {

/// The pass launches the kernel of first hits, in which each ray evaluates its events from front to back in private
/// memory, up to the first claim.
class FirstHitPass {
public:
    /// Compiles the kernels. Throws Error (device_fault).
    FirstHitPass(Device& device, const CompiledScene& scene, const Settings& settings);

    /// Draws the pixels of the batch's tiles, which are culled and listed, into `picture`. Rays with more segments at a
    /// time than the kernel holds are not drawn: the report counts these rays, and `overflown` lists them. Does not
    /// wait.
    TimedKernels launch(const SceneTables& scene, BatchBuffers& batch, const Buffer& picture, std::uint32_t rays);

    /// The native device's program for a scene (cmake/native_kernels.cmake).
    static const char* native_program(const CompiledScene& scene);

    CullPass& cull() { return cull_; }
    static constexpr std::uint64_t ray_bytes = sizeof(std::uint32_t);  ///< of `overflown`

private:
    Device& device_;
    std::uint32_t rays_an_item_;
    Program program_;
    CullPass cull_;
    Kernel first_hits_;
};

}  // namespace csgrt
