#include "pipeline/passes/rows.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "pipeline/passes/program_options.hpp"

namespace csgrt {

RowPass::RowPass(Device& device, const Program& program, const CompiledScene& scene, const RecordConverter& records)
    : device_(device),
      scene_(&scene),
      records_(&records),
      count_rows_(program.kernel("count_rows")),
      write_rows_(program.kernel("write_rows")),
      describe_rows_(program.kernel("describe_rows")),
      count_claimants_(program.kernel("count_claimants")),
      list_claimants_(program.kernel("list_claimants")),
      places_(device, "places of rows"),
      bounds_(device, "rows' ends"),
      overlap_records_(device, "overlaps"),
      claim_places_(device, "places of claims"),
      claimants_(device, "claimants"),
      claimant_counts_(device, "numbers of claimants") {
    for (const char* name : {"rows' regions", "rows' begins", "rows' ends' distances", "rows' first solids",
                             "rows' last solids", "rows' first normals", "rows' last normals"})
        columns_.emplace_back(device, name);
}

std::size_t RowPass::row_bytes(std::size_t column) const {
    if (column == regions || column == in_solids || column == out_solids) return sizeof(std::int32_t);
    return (column == in || column == out ? 1 : 3) * records_->wide_bytes();
}

bool RowPass::is_wanted(std::size_t column, Fields fields) const {
    if (column == in_solids || column == out_solids) return fields.solids;
    return (column != in_normals && column != out_normals) || fields.normals;
}

bool RowPass::reserve(const std::vector<std::pair<Buffer*, std::uint64_t>>& wanted) {
    std::uint64_t more = 0;
    for (const auto& [buffer, bytes] : wanted) {
        if (bytes > device_.max_buffer()) return false;
        more += bytes > buffer->size() ? bytes : 0;
    }
    if (more > device_.available()) return false;
    for (const auto& [buffer, bytes] : wanted) buffer->reserve(bytes);
    return true;
}

const Buffer* RowPass::count(const Input& input, TimedKernels& timed) {
    if (!reserve({{&places_, (std::uint64_t{input.count} + 1) * sizeof(kernel::RayCount)}})) return nullptr;
    timed.emplace_back(&PipelineCounts::rows,
                       count_rows_.launch(input.count, work_group, input.frame, input.rays, input.offsets,
                                          input.boundaries, input.nodes, places_));
    return &places_;
}

bool RowPass::write(const Input& input, const kernel::RayCount& total, Fields fields, const SceneTables& scene,
                    TimedKernels& timed) {
    const bool is_described = fields.solids || fields.normals;
    std::vector<std::pair<Buffer*, std::uint64_t>> wanted;
    for (std::size_t i = 0; i < columns; ++i) {
        if (!is_wanted(i, fields))
            columns_[i].release();
        else
            wanted.emplace_back(&columns_[i], std::uint64_t{total.segments} * row_bytes(i));
    }
    bounds_.release();
    overlap_records_.release();
    if (is_described) wanted.emplace_back(&bounds_, std::uint64_t{total.segments} * sizeof(kernel::RowBoundaries));
    if (fields.overlaps) wanted.emplace_back(&overlap_records_, std::uint64_t{total.words} * records_->overlap_bytes());
    if (!reserve(wanted)) return false;
    const auto add = [&](Event event) { timed.emplace_back(&PipelineCounts::rows, std::move(event)); };
    add(write_rows_.launch(total.segments + total.words ? input.count : 0, work_group, input.frame, input.rays,
                           input.offsets, input.boundaries, input.nodes, places_, columns_[regions], columns_[in],
                           columns_[out], bounds_, overlap_records_));
    add(describe_rows_.launch(is_described ? total.segments : 0, work_group, input.frame, scene.geometry(), input.rays,
                              input.boundaries, bounds_, cl_uint{total.segments}, columns_[in_solids],
                              columns_[out_solids], columns_[in_normals], columns_[out_normals]));
    total_ = total;
    fields_ = fields;
    first_ = input.first;
    rays_ = input.count;
    return true;
}

void RowPass::start_copy(SomeRays deep) {
    constexpr std::size_t alignment = 64;
    const std::size_t records = has_overlaps() ? total_.words : 0;
    std::vector<std::pair<const Buffer*, std::size_t>> arrays = {
        {&places_, (std::size_t{rays_} + 1) * sizeof(kernel::RayCount)}};
    for (std::size_t i = 0; i < columns; ++i)
        arrays.emplace_back(&columns_[i], is_wanted(i, fields_) ? total_.segments * row_bytes(i) : 0);
    arrays.emplace_back(&overlap_records_, records * records_->overlap_bytes());
    arrays.emplace_back(&claim_places_, records * sizeof(kernel::RayCount));
    arrays.emplace_back(&claimants_, records ? claims_ * sizeof(std::uint32_t) : 0);
    arrays.emplace_back(&claimant_counts_, records * sizeof(std::uint32_t));
    std::size_t all = 0;
    places_in_staging_.clear();
    for (const auto& [buffer, bytes] : arrays) {
        places_in_staging_.push_back(all);
        all += (bytes + alignment - 1) / alignment * alignment;
    }
    if (!staging_ || staging_->size() < all) {
        staging_.reset();
        staging_.emplace(device_, "rows", all + all / 4);
    }
    is_underway_ = true;
    copies_.clear();
    for (std::size_t i = 0; i < arrays.size(); ++i)
        if (const auto& [buffer, bytes] = arrays[i]; bytes > 0) copies_.push_back(buffer->copy_read(staged(i), bytes));
    device_.flush_copies();
    deep_ = std::move(deep);
}

const Buffer* RowPass::count_claimants(const Input& input, const SceneTables& scene, TimedKernels& timed) {
    if (!reserve({{&claim_places_, (std::uint64_t{total_.words} + 1) * sizeof(kernel::RayCount)}})) return nullptr;
    timed.emplace_back(
        &PipelineCounts::rows,
        count_claimants_.launch(total_.words, divergent_group(device_), scene.evaluation(), input.offsets,
                                input.boundaries, input.bits, overlap_records_, cl_uint{total_.words}, claim_places_));
    return &claim_places_;
}

bool RowPass::list_claimants(const Input& input, std::uint32_t claims, const SceneTables& scene, TimedKernels& timed) {
    const std::uint64_t bytes = sizeof(std::uint32_t);
    if (claims == COUNT_MAX || !reserve({{&claimants_, claims * bytes}, {&claimant_counts_, total_.words * bytes}}))
        return false;
    timed.emplace_back(&PipelineCounts::rows,
                       list_claimants_.launch(total_.words, divergent_group(device_), input.frame, scene.evaluation(),
                                              input.offsets, input.boundaries, input.bits, overlap_records_,
                                              cl_uint{total_.words}, claim_places_, claimants_, claimant_counts_));
    claims_ = claims;
    return true;
}

void RowPass::take_overlaps() {
    memory_.overlaps.clear();
    memory_.overlap_regions.clear();
    if (!has_overlaps()) return;
    constexpr std::size_t first = 1 + columns;
    const auto* const bytes = staged(first);
    std::vector<kernel::OverlapRecord> converted;
    std::span records(reinterpret_cast<const kernel::OverlapRecord*>(bytes), total_.words);
    if (records_->overlap_bytes() != sizeof(kernel::OverlapRecord))
        records = converted = records_->overlap_records({bytes, bytes + total_.words * records_->overlap_bytes()});
    csgrt::take_overlaps(*scene_,
                         {records, reinterpret_cast<const kernel::RayCount*>(staged(first + 1)),
                          reinterpret_cast<const std::uint32_t*>(staged(first + 2)),
                          reinterpret_cast<const std::uint32_t*>(staged(first + 3)), deep_},
                         memory_);
}

/// A column, converted to the host's numbers.
template <class T>
const T* RowPass::column(std::size_t number, std::vector<T>& converted) const {
    if (!is_wanted(number, fields_)) return nullptr;
    const std::byte* const memory = staged(1 + number);
    if (row_bytes(number) == sizeof(T)) return reinterpret_cast<const T*>(memory);
    const auto* const singles = reinterpret_cast<const float*>(memory);
    const std::size_t count = total_.segments * sizeof(T) / sizeof(double);
    auto* const numbers = reinterpret_cast<double*>(room_for(converted, total_.segments));
    std::copy_n(singles, count, numbers);
    return converted.data();
}

RowView RowPass::wait() {
    is_underway_ = false;
    for (const Event& copy : copies_) wait_for(copy);
    copies_.clear();
    take_overlaps();
    const auto* const places = static_cast<const kernel::RayCount*>(staging_->data());
    std::vector<std::int32_t> unused;
    return {.first = first_,
            .places = {places, std::size_t{rays_} + 1},
            .regions = column(regions, unused),
            .in = column(in, memory_.in),
            .out = column(out, memory_.out),
            .in_solids = column(in_solids, unused),
            .out_solids = column(out_solids, unused),
            .in_normals = column(in_normals, memory_.in_normals),
            .out_normals = column(out_normals, memory_.out_normals),
            .overlaps = memory_.overlaps,
            .overlap_regions = memory_.overlap_regions};
}

void RowPass::cancel() noexcept {
    is_underway_ = false;
    for (const Event& copy : copies_) wait_until_done(copy);
    copies_.clear();
}

std::uint64_t RowPass::held() const {
    std::uint64_t sum = 0;
    for (const Buffer* buffer : {&places_, &bounds_, &overlap_records_, &claim_places_, &claimants_, &claimant_counts_})
        sum += buffer->size();
    for (const Buffer& column : columns_) sum += column.size();
    return sum;
}

void RowPass::release() {
    for (Buffer* buffer : {&places_, &bounds_, &overlap_records_, &claim_places_, &claimants_, &claimant_counts_})
        buffer->release();
    for (Buffer& column : columns_) column.release();
}

}  // namespace csgrt
