// Deep-ray pass: the partitions of a batch's deep rays, and their claims, in place of kernels 3 and 4.
//
//   sort blocks -> merge, merge, ... -> sweep, sweep, ... of some rays -> ... of the next rays
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compile/regions/status_tree.hpp"
#include "device/queued.hpp"
#include "pipeline/counts.hpp"
#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/partition_memory.hpp"

namespace csgrt {

/// Sorts and sweeps the deep rays of a batch, in groups that fit the memory. The time of a ray of n segments grows as n
/// log n, where kernels 3 and 4 need n^2 and more.
class DeepRayPass {
public:
    /// Takes the kernels of kernels/3_deep_rays.cl from `program`. The scene must outlive the pass.
    DeepRayPass(Device& device, const Program& program, const CompiledScene& scene);

    /// Lists the deep rays among those whose sums of counts are given, and makes room for them. False: there is not
    /// enough memory. `spoken_for`: bytes that others will take. The first deep ray of all has the scene's status tree
    /// made.
    bool prepare(const std::vector<kernel::RayCount>& offsets, std::uint64_t spoken_for);
    /// Queues the kernels, after kernels 2 to 4. Does not wait.
    void launch(const BatchBuffers& batch, Work work, PartitionMemory& memory, TimedKernels& timed);

    /// Takes another scene for the next rays.
    void set_scene(const CompiledScene& scene) {
        scene_ = &scene;
        tree_.reset();
    }

    std::uint64_t held() const { return rays_.size() + segments_.size() + status_.size(); }
    void release();

    std::uint32_t rays_at_a_time;          ///< at most
    std::uint32_t ends_a_launch = 16'384;  ///< of a ray: then a launch takes a fraction of a second on any device

private:
    /// The scene's status tree on the device.
    struct Tree {
        Tree(Device& device, const StatusTree& tree, std::uint32_t regions);
        Buffer links, outside, first_leaves, leaves;
        std::uint32_t cluster_words, words;  ///< words of a ray's status: functions of clusters; and all, with the set
                                             ///< of regions
    };
    /// Rays that are swept side by side.
    struct Group {
        std::uint32_t first, count, most_ends;
    };
    /// Makes the status tree, if it is not made yet. False: the device has no room for it now.
    bool has_tree(std::uint64_t spoken_for);
    void sort(PartitionMemory& memory, TimedKernels& timed);

    Device& device_;
    const CompiledScene* scene_;
    Kernel sort_blocks_, merge_runs_, clear_status_, sweep_;
    std::optional<Tree> tree_;
    Buffer rays_, segments_, status_;
    std::vector<kernel::DeepRay> listed_;  ///< and one more, for the sums
    std::vector<Group> groups_;
    std::uint32_t most_ends_ = 0;
};

}  // namespace csgrt
