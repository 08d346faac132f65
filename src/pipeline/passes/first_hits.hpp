// The first hits of a batch, in one kernel. Nothing is stored but the picture.
#pragma once

#include "pipeline/passes/cull.hpp"

namespace csgrt {

class FirstHits {
public:
    FirstHits(Device& device, const CompiledScene& scene, const Settings& settings);

    /// Draws the batch's rays, whose tiles were culled before, into `picture`. Does not wait.
    TimedKernels launch(const SceneBuffers& scene, BatchBuffers& batch, const Buffer& picture, std::uint32_t rays);

    Cull& cull() { return cull_; }
    static constexpr std::uint64_t ray_bytes = 4;  ///< of the batch's buffers that it needs itself, at most

private:
    Device& device_;
    std::uint32_t rays_an_item_;
    Program program_;
    Cull cull_;
    Kernel first_hits_;
};

}  // namespace csgrt
