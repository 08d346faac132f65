// The first hits of a tile, in two kernels: cull blocks -> first hits. Nothing is stored but the picture.
#pragma once

#include "pipeline/stages.hpp"

namespace csgrt {

class FirstHits {
public:
    FirstHits(Device& device, const CompiledScene& scene, const Settings& settings);

    /// Draws the tile's rays; waits. Returns the numbers of those that hold more segments at a time than the kernel does:
    /// their pixels are not drawn.
    std::vector<std::uint32_t> run(const SceneBuffers& scene, TileBuffers& tile, std::uint32_t rays, PipelineCounts& counts);

    static constexpr std::uint64_t ray_bytes = 5;  ///< that it needs itself, at most
    std::uint64_t held() const { return blocks_.size() + overflown_.size(); }
    void release();  ///< gives all its memory back

private:
    Device& device_;
    Program program_;
    Kernel cull_blocks_, first_hits_;
    Buffer blocks_, overflows_, overflown_;
};

}  // namespace csgrt
