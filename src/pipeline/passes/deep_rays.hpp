// Deep-ray pass: makes the partitions of a batch's deep rays and finds their claims, in place of kernels 3 and 4.
//
//   sort blocks -> merge, merge, ... -> sweep, sweep, ... of some rays -> ... of the next rays
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/regions/status_tree.hpp"
#include "device/queued.hpp"
#include "pipeline/counts.hpp"
#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/partition_memory.hpp"

namespace csgrt {

/// The pass sorts and sweeps the deep rays of a batch, in groups that fit the memory. The time of a ray of n segments
/// grows as n log n; with kernels 3 and 4 it would grow as n^2 or more.
class DeepRayPass {
public:
    /// Takes the kernels of kernels/3_deep_rays.cl from `program`. The scene must outlive the pass.
    DeepRayPass(Device& device, const Program& program, const CompiledScene& scene);

    /// Lists the deep rays, by the sums of the rays' counts, and reserves memory for them. Returns false if there is
    /// not enough memory. `spoken_for`: bytes that other buffers will need. The scene's status tree is made for the
    /// first deep ray of all.
    bool prepare(const std::vector<kernel::RayCount>& offsets, std::uint64_t spoken_for);
    /// Queues the kernels, after kernels 2 to 4. Does not wait.
    void launch(const BatchBuffers& batch, Work work, PartitionMemory& memory, TimedKernels& timed);

    /// Sets another scene for the next rays.
    void set_scene(const CompiledScene& scene) {
        scene_ = &scene;
        tree_.reset();
    }

    /// The deep rays that were listed last.
    std::span<const kernel::DeepRay> rays() const {
        return std::span(listed_).first(listed_.empty() ? 0 : listed_.size() - 1);
    }

    std::uint64_t held() const { return rays_.size() + segments_.size() + status_.size(); }
    void release();

    std::uint32_t rays_at_a_time;                ///< at most
    std::uint32_t boundaries_a_launch = 16'384;  ///< boundaries of a ray: on any device a fraction of a second

private:
    /// The scene's status tree on the device.
    struct Tree {
        Tree(Device& device, const StatusTree& tree, std::uint32_t regions);
        Buffer links, outside, first_leaves, leaves;
        std::uint32_t cluster_words,
            words;  ///< words of a ray's status: only the clusters' functions; and with the set of regions
    };
    /// Rays that are swept side by side.
    struct Group {
        std::uint32_t first, count, most_boundaries;
    };
    /// Makes the status tree, if it is not made yet. Returns false if the device has not enough memory now.
    bool has_tree(std::uint64_t spoken_for);
    void sort(PartitionMemory& memory, TimedKernels& timed);

    Device& device_;
    const CompiledScene* scene_;
    Kernel sort_blocks_, merge_runs_, clear_status_, sweep_;
    std::optional<Tree> tree_;
    Buffer rays_, segments_, status_;
    std::vector<kernel::DeepRay> listed_;  ///< and one more entry, for the sums
    std::vector<Group> groups_;
    std::uint32_t most_ends_ = 0;
};

}  // namespace csgrt
