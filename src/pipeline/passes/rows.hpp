// Row pass (kernel 6): writes the rows of a list's batch, which kernels 1 to 4 have traced.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compile/records/converter.hpp"
#include "device/program.hpp"
#include "pipeline/passes/scene_tables.hpp"
#include "pipeline/counts.hpp"
#include "rays/overlaps.hpp"

namespace csgrt {

/// The pass launches kernel 6, and copies its arrays to the host while the next batch is traced.
class RowPass {
public:
    /// Takes the kernels of kernels/6_rows.cl from `program`. All arguments must outlive the pass.
    RowPass(Device& device, const Program& program, const CompiledScene& scene, const RecordConverter& records);

    ~RowPass() { cancel(); }

    void set_scene(const CompiledScene& scene, const RecordConverter& records) {
        scene_ = &scene;
        records_ = &records;
    }

    /// The buffers that the kernels read, of the batch that was traced last.
    struct Input {
        const Buffer &frame, &rays, &offsets, &boundaries, &nodes, &bits;
        std::uint64_t first;  ///< number of the batch's first ray in the list
        std::uint32_t count;
    };
    /// Counts the rays' rows; the caller scans the counts. Returns null if there is not enough memory.
    const Buffer* count(const Input& input, TimedKernels& timed);
    /// Writes the rows. `total`: the sum of the counts. Returns false if there is not enough memory.
    bool write(const Input& input, const kernel::RayCount& total, Fields fields, const SceneTables& scene,
               TimedKernels& timed);
    /// Whether overlaps are wanted and exist. Then their claimants have to be found by a kernel (the next two
    /// functions), and those of deep rays by the host.
    bool has_overlaps() const { return fields_.overlaps && total_.words > 0; }
    /// Counts the claims of each overlap; the caller scans the overlaps() counts. Returns null if there is not enough
    /// memory.
    const Buffer* count_claimants(const Input& input, const SceneTables& scene, TimedKernels& timed);
    /// Lists the claimants. `claims`: the sum of the counts. Returns false if there is not enough memory.
    bool list_claimants(const Input& input, std::uint32_t claims, const SceneTables& scene, TimedKernels& timed);
    /// Starts to copy the rows. To be called when their kernels are done. `deep`: the deep rays, if there are overlaps.
    void start_copy(SomeRays deep);
    /// Waits for the rows whose copy was started last, and returns them. They are valid until the next copy.
    RowView wait();
    /// Drops the rows.
    void cancel() noexcept;
    /// Whether a copy was started, and wait() was not called since.
    bool is_underway() const { return is_underway_; }

    /// The number of overlapping partitions in the batch whose rows were written last.
    std::uint32_t overlaps() const { return total_.words; }

    std::uint64_t held() const;
    void release();

private:
    /// The arrays' numbers, in RowView's order.
    enum Column { regions, in, out, in_solids, out_solids, in_normals, out_normals };
    static constexpr std::size_t columns = 7;
    std::size_t row_bytes(std::size_t column) const;
    bool is_wanted(std::size_t column, Fields fields) const;
    bool reserve(const std::vector<std::pair<Buffer*, std::uint64_t>>& wanted);
    template <class T>
    const T* column(std::size_t number, std::vector<T>& converted) const;
    std::byte* staged(std::size_t array) const {
        return static_cast<std::byte*>(staging_->data()) + places_in_staging_[array];
    }
    void take_overlaps();

    Device& device_;
    const CompiledScene* scene_;
    const RecordConverter* records_;
    Kernel count_rows_, write_rows_, describe_rows_, count_claimants_, list_claimants_;
    Buffer places_, bounds_, overlap_records_, claim_places_, claimants_, claimant_counts_;
    std::vector<Buffer> columns_;          ///< by Column
    std::optional<PinnedMemory> staging_;  ///< of all arrays, one after the other
    std::vector<Event> copies_;
    std::vector<std::size_t> places_in_staging_;  ///< of the rays' places, the columns, and the overlaps' four arrays
    SomeRays deep_;
    kernel::RayCount total_{};
    std::uint32_t claims_ = 0;
    Fields fields_;
    std::uint64_t first_ = 0;
    std::uint32_t rays_ = 0;
    bool is_underway_ = false;
    RowMemory memory_;
};

}  // namespace csgrt
