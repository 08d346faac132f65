// The first hits of a tile, in one kernel. Nothing is stored but the picture.
#pragma once

#include "pipeline/cull.hpp"

namespace csgrt {

class FirstHits {
public:
    FirstHits(Device& device, const CompiledScene& scene, const Settings& settings);

    /// Draws the tile's rays, whose blocks were culled before. Does not wait.
    void launch(const SceneBuffers& scene, TileBuffers& tile, std::uint32_t rays);
    /// Has what overflown() tells copied; see QueuedRead.
    void fetch() { read_.fetch(); }
    /// The numbers of those that hold more segments at a time than the kernel does: their pixels are not drawn. Waits.
    std::vector<std::uint32_t> overflown(PipelineCounts& counts);

    Cull& cull() { return cull_; }
    static constexpr std::uint64_t ray_bytes = 4;  ///< that it needs itself, at most
    std::uint64_t held() const { return overflown_.size() + cull_.held(); }
    void release();  ///< gives all its memory back

private:
    Device& device_;
    std::uint32_t rays_an_item_;
    Program program_;
    Cull cull_;
    Kernel first_hits_;
    Buffer overflows_, overflown_;
    QueuedRead read_;  // overflows_
    Event event_;
};

}  // namespace csgrt
