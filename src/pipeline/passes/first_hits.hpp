// The first hits of a batch, in one kernel. Nothing is stored but the picture.
#pragma once

#include "pipeline/counts.hpp"
#include "pipeline/passes/cull.hpp"

namespace csgrt {

class FirstHitPass {
public:
    /// Compiles its kernels. Throws Error (device_fault).
    FirstHitPass(Device& device, const CompiledScene& scene, const Settings& settings);

    /// Draws the pixels of the batch's tiles, which are culled and listed, into `picture`. The report counts the rays
    /// whose segments found no place, which are listed in `overflown`: nothing is drawn of them. Does not wait.
    TimedKernels launch(const SceneTables& scene, BatchBuffers& batch, const Buffer& picture, std::uint32_t rays);

    /// Which of the native device's programs suits a scene (cmake/native_kernels.cmake).
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
