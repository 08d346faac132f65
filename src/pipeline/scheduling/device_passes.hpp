// Device passes: the scene's tables on one device, and the passes that run a batch's kernels.
#pragma once

#include <functional>
#include <optional>

#include "compile/frame.hpp"
#include "pipeline/passes/first_hits.hpp"
#include "pipeline/passes/partitions.hpp"
#include "pipeline/passes/tile_list.hpp"
#include "pipeline/readback/picture.hpp"
#include "pipeline/scheduling/batch_source.hpp"
#include "pipeline/scheduling/memory_plan.hpp"

namespace csgrt {

/// A function that is called with the number of rays that were done. If it throws, the work ends.
using ReportDone = std::function<void(std::uint64_t rays)>;

/// The data that all batches of a frame share.
struct FrameJob {
    const kernel::Frame& frame;
    BatchSource& source;
    const RenderTarget& target;
    const ReportDone& report_done;
    PipelineCounts& counts;
    bool edges = false;  ///< PreparedFrame::edges

    FrameShape shape() const { return shape_of(frame, target.channels.size()); }
    /// Whether the frame's edges can be drawn when the batch is drawn.
    bool has_edges(const RayBatch& batch) const {
        return edges && batch.tiles() == shape().tiles_across * shape().tiles_down;
    }
    /// Reports that a batch is done.
    void report(const RayBatch& batch) const {
        ++counts.batches;
        counts.done.push_back(batch);
        if (report_done) report_done(batch.rays);
    }
};

/// The owner of a device's passes, which are compiled at their first use. All arguments must outlive it.
class DevicePasses {
public:
    DevicePasses(Device& device, const CompiledScene& scene, const RecordConverter& records, const Settings& settings);

    /// Sets another scene. Removes passes whose programs cannot draw this scene, and buffers with the tables of the
    /// last scene. Throws Error (out_of_memory, device_fault).
    void set_scene(const CompiledScene& scene, const RecordConverter& records);

    /// Whether the compiled programs can draw the scene.
    bool can_draw(const CompiledScene& scene) const { return draws(device, needs_, ProgramNeeds(scene)); }

    Device& device;
    const RecordConverter& records() const { return *records_; }
    std::optional<SceneTables> tables;

    FirstHitPass& first_hits();
    PartitionPass& partitions();
    TileListPass& tile_list();
    CullPass& cull(const kernel::Frame& frame) {
        return frame.every_partition ? partitions().cull() : first_hits().cull();
    }
    double build_ms() const { return build_ms_; }  ///< spent on compiling so far

    std::uint64_t held() const { return partitions_ ? partitions_->held() : 0; }
    void release() {
        if (partitions_) partitions_->release();
    }
    void cancel_tallies() noexcept {
        if (partitions_) partitions_->cancel_tallies();
    }

private:
    template <class Build>
    void timed_build(const Build& build);

    const CompiledScene* scene_;
    const RecordConverter* records_;
    ProgramNeeds needs_;  ///< of the passes' programs
    Settings settings_;
    std::optional<FirstHitPass> first_hits_;
    std::optional<PartitionPass> partitions_;
    TileListPass tile_list_;
    double build_ms_ = 0;
};

}  // namespace csgrt
