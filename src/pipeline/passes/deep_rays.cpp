#include "pipeline/passes/deep_rays.hpp"

#include <algorithm>

#include "pipeline/passes/program_options.hpp"

namespace csgrt {
namespace kernel {
#include "../kernels/boolean/status_tree.h"
#include "../kernels/shared/capacity.h"
}  // namespace kernel

namespace {
constexpr cl_uint field_in_boundary = 0, field_next = 2;  // of kernel::PartitionNode
}  // namespace

DeepRayPass::Tree::Tree(Device& device, const StatusTree& tree, std::uint32_t regions)
    : links(device, "status tree", tree.links),
      outside(device, "status outside", tree.outside),
      first_leaves(device, "solids' places in the status tree", tree.first_leaves),
      leaves(device, "leaves of the status tree", tree.leaves),
      cluster_words(static_cast<std::uint32_t>(tree.outside.size())),
      words(cluster_words + kernel::words_of_set(regions)) {}

// Processors trace few rays at a time, so that the rays' status fits their caches.
DeepRayPass::DeepRayPass(Device& device, const Program& program, const CompiledScene& scene)
    : rays_at_a_time(device.info().type == "cpu" ? 256 : 65'536),
      device_(device),
      scene_(&scene),
      sort_blocks_(program.kernel("sort_deep_blocks")),
      merge_runs_(program.kernel("merge_deep_runs")),
      clear_status_(program.kernel("clear_status")),
      sweep_(program.kernel("sweep_deep_rays")),
      rays_(device, "deep rays"),
      segments_(device, "segments of deep rays"),
      status_(device, "status of deep rays") {}

bool DeepRayPass::has_tree(std::uint64_t spoken_for) {
    if (tree_) return true;
    const StatusTree& made = LateStatusTree::of(*scene_);
    std::uint64_t words = 0;
    for (const auto* list : {&made.links, &made.outside, &made.first_leaves, &made.leaves}) words += list->size();
    if (words * sizeof(std::uint32_t) + spoken_for > device_.available()) return false;
    tree_.emplace(device_, made, static_cast<std::uint32_t>(scene_->regions.size()));
    return true;
}

bool DeepRayPass::prepare(const std::vector<kernel::RayCount>& offsets, std::uint64_t spoken_for) {
    listed_.clear();
    groups_.clear();
    most_ends_ = 0;
    kernel::DeepRay next{};
    next.open = next.last = NONE;
    for (std::uint32_t ray = 0; ray + 1 < offsets.size(); ++ray) {
        const std::uint32_t segments = offsets[ray + 1].segments - offsets[ray].segments;
        if (segments <= DEEP_SEGMENTS) continue;
        next.ray = ray;
        listed_.push_back(next);
        next.block += (2 * segments + DEEP_BLOCK - 1) / DEEP_BLOCK;
        next.segment += segments;
        most_ends_ = std::max(most_ends_, 2 * segments);
    }
    if (listed_.empty()) return true;
    listed_.push_back(next);
    if (!has_tree(spoken_for)) return false;

    segments_.release();  // they are allocated for these rays below
    status_.release();
    const std::uint64_t list_bytes = listed_.size() * sizeof(kernel::DeepRay);
    const std::uint64_t available = device_.available() + rays_.size();
    if (list_bytes + spoken_for > available) return false;
    const std::uint64_t room = available - list_bytes - spoken_for;
    const std::uint64_t status_bytes = std::uint64_t{SIDES} * tree_->words * sizeof(std::uint32_t);
    std::uint64_t most_segment_bytes = 0;
    std::uint32_t most_rays = 0;
    for (std::uint32_t first = 0; first + 1 < listed_.size();) {
        Group group{first, 0, 0};
        for (std::uint32_t ray = first; ray + 1 < listed_.size() && group.count < rays_at_a_time; ++ray) {
            const std::uint64_t segment_bytes =
                std::uint64_t{listed_[ray + 1].segment - listed_[first].segment} * sizeof(kernel::DeepSegment);
            const std::uint64_t more_segment_bytes = std::max(most_segment_bytes, segment_bytes),
                                more_status_bytes = std::max(most_rays, group.count + 1) * status_bytes;
            if (more_segment_bytes > device_.max_buffer() || more_status_bytes > device_.max_buffer() ||
                more_segment_bytes + more_status_bytes > room)
                break;
            most_segment_bytes = more_segment_bytes;
            most_rays = std::max(most_rays, ++group.count);
            group.most_boundaries =
                std::max(group.most_boundaries, 2 * (listed_[ray + 1].segment - listed_[ray].segment));
        }
        if (group.count == 0) return false;
        groups_.push_back(group);
        first += group.count;
    }
    rays_.reserve(list_bytes);
    rays_.upload(listed_);
    segments_.reserve(most_segment_bytes);
    status_.reserve(most_rays * status_bytes);
    return true;
}

// The last merge writes the order into the nodes' `next`.
void DeepRayPass::sort(PartitionMemory& memory, TimedKernels& timed) {
    const cl_uint count = static_cast<cl_uint>(listed_.size() - 1), blocks = listed_.back().block;
    const auto add = [&](Event event) { timed.emplace_back(&PipelineCounts::weave, std::move(event)); };
    cl_uint field = field_next;
    for (std::uint64_t run = DEEP_BLOCK; run < most_ends_; run *= 2) field ^= field_next ^ field_in_boundary;
    add(sort_blocks_.launch(blocks, work_group, rays_, count, blocks, memory.offsets(), memory.boundaries(),
                            memory.partitions(), field));
    for (cl_uint run = DEEP_BLOCK; run < most_ends_; run *= 2) {
        add(merge_runs_.launch(blocks, work_group, rays_, count, blocks, memory.offsets(), memory.boundaries(),
                               memory.partitions(), field, run));
        field ^= field_next ^ field_in_boundary;
    }
}

void DeepRayPass::launch(const BatchBuffers& batch, Work work, PartitionMemory& memory, TimedKernels& timed) {
    if (groups_.empty()) return;
    sort(memory, timed);
    const cl_uint words = static_cast<cl_uint>(status_.size() / sizeof(std::uint32_t));
    const auto add = [&](Event event) { timed.emplace_back(&PipelineCounts::evaluate, std::move(event)); };
    add(clear_status_.launch(words, work_group, tree_->outside, tree_->cluster_words, tree_->words, words, status_));
    for (const Group& group : groups_) {
        for (std::uint32_t boundaries = 0; boundaries < group.most_boundaries; boundaries += boundaries_a_launch)
            add(sweep_.launch(group.count, divergent_group(device_), batch.frame, batch.rays, batch.numbers(work),
                              rays_, group.first, cl_uint{listed_[group.first].segment}, group.count, memory.offsets(),
                              memory.boundaries(), memory.partitions(), segments_, status_, tree_->cluster_words,
                              static_cast<cl_uint>(scene_->regions.size()), tree_->links, tree_->first_leaves,
                              tree_->leaves, cl_uint{boundaries_a_launch}, memory.ray_tallies()));
        device_.flush();
    }
}

void DeepRayPass::release() {
    for (Buffer* buffer : {&rays_, &segments_, &status_}) buffer->release();
    groups_.clear();
}

}  // namespace csgrt
