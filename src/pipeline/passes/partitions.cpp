#include "pipeline/passes/partitions.hpp"

#include <algorithm>
#include <utility>

namespace csgrt {
namespace kernel {
#include "../kernels/shared/capacity.h"
}  // namespace kernel

namespace {

bool has_flat_faced(const CompiledScene& scene) { return (scene.solid_types & FLAT_FACED) != 0; }

std::vector<std::string> files_of(bool packets, bool rays_in_faces) {
    std::vector<std::string> files = {CullPass::file, "0_make_rays.cl"};
    if (packets) files.push_back("1_packet_candidates.cl");
    if (rays_in_faces) files.push_back("2_rays_in_faces.cl");
    files.insert(files.end(), {"1_count_segments.cl", "scan.cl", "2_store_segments.cl", "3_weave.cl", "4_evaluate.cl",
                               "3_deep_rays.cl", "5_shade.cl", "6_rows.cl"});
    return files;
}

// With another evaluation no ray is deep: a ray of more segments than this limit has more words than 32 bits can count.
std::vector<std::string> options_for(const Device& device, const CompiledScene& scene, const Settings& settings) {
    std::vector<std::string> options = program_options(device, ProgramNeeds(scene), settings);
    if (laboratory(settings).evaluation) options.push_back("DEEP_SEGMENTS=0x3ffffu");
    return options;
}

}  // namespace

PartitionPass::PartitionPass(Device& device, const CompiledScene& scene, const RecordConverter& records,
                             const Settings& settings)
    : device_(device),
      scene_(&scene),
      records_(&records),
      other_evaluation_(laboratory(settings).evaluation),
      program_(device,
               program_source(device.info(), settings, "partitions",
                              files_of(traces_packets(device, settings), has_flat_faced(scene))) +
                   (other_evaluation_ ? other_evaluation_->source : ""),
               options_for(device, scene, settings), settings.precision != Precision::double_),
      cull_(device, program_),
      make_rays_(program_.kernel("make_rays")),
      find_candidates_(program_.kernel("find_candidates")),
      count_segments_(program_.kernel("count_segments")),
      sum_segments_(program_.kernel("sum_segments")),
      scan_blocks_(program_.kernel("scan_blocks")),
      scan_sums_(program_.kernel("scan_sums")),
      scan_add_(program_.kernel("scan_add")),
      store_segments_(program_.kernel("store_segments")),
      order_boundaries_(program_.kernel("order_boundaries")),
      weave_(program_.kernel("weave")),
      evaluate_(program_.kernel(other_evaluation_ ? other_evaluation_->name : "evaluate")),
      shade_(program_.kernel("shade")),
      memory_(device, records),
      deep_rays_(device, program_, scene),
      rows_(device, program_, scene, records),
      no_buffer_(device, "nothing"),
      scan_sums_buffer_(device, "sums of counts"),
      read_(device, "sums of tallies"),
      read_total_(device, "sum of counts") {
    if (traces_packets(device, settings))
        packet_candidates_ = {program_.kernel("count_packet_candidates"), program_.kernel("list_packet_candidates")};
    if (has_flat_faced(scene)) rays_in_faces_ = {program_.kernel("count_in_faces"), program_.kernel("store_in_faces")};
}

void PartitionPass::set_scene(const CompiledScene& scene, const RecordConverter& records) {
    scene_ = &scene;
    records_ = &records;
    deep_rays_.set_scene(scene);
    rows_.set_scene(scene, records);
    average_ = average_before_ = {};
}

// The first step of a scan replaces the entries by sums within their block, and writes each block's sum.
void PartitionPass::sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums, TimedKernels& timed) {
    sums.reserve(scan_blocks_of(size) * sizeof(kernel::RayCount));
    timed.emplace_back(&PipelineCounts::scan, scan_blocks_.launch(std::size_t{scan_blocks_of(size)} * work_group,
                                                                  work_group, entries, sums, cl_uint{size}));
}

// A scan makes exclusive prefix sums of rays + 1 entries. The last entry need not be set: it is part of no sum.
void PartitionPass::scan(const Buffer& counts, std::uint32_t rays, TimedKernels& timed) {
    const cl_uint entries = rays + 1, blocks = scan_blocks_of(entries);
    sum_blocks(counts, entries, scan_sums_buffer_, timed);
    if (blocks > 1) {
        timed.emplace_back(&PipelineCounts::scan, scan_sums_.launch(work_group, work_group, scan_sums_buffer_, blocks));
        timed.emplace_back(&PipelineCounts::scan,
                           scan_add_.launch(entries, work_group, counts, scan_sums_buffer_, entries));
    }
    device_.flush();
}

// The copy is queued only when the kernels are done: NVIDIA's GPUs make copies to the host one after another. A copy
// that is queued behind kernels would delay the copies of other queues, too.
kernel::RayCount PartitionPass::read_total(const Buffer& counts, std::uint32_t rays, const TimedKernels& timed) {
    wait_for(timed.back().second);
    read_total_.start(counts, sizeof(kernel::RayCount), rays * sizeof(kernel::RayCount));
    read_total_.copy();
    return read_total_.wait<kernel::RayCount>(1).front();
}

std::optional<PartitionSizes> PartitionPass::trace_counted(const Input& input, TimedKernels& timed) {
    if (auto sizes = try_counted(input, timed)) return sizes;
    // A fault throws here; missing memory throws nothing, and a smaller batch needs what is released.
    for (const auto& [time, kernel] : timed) wait_for(kernel);
    memory_.release_counted();
    deep_rays_.release();
    return {};
}

std::optional<PartitionSizes> PartitionPass::try_counted(const Input& input, TimedKernels& timed) {
    PartitionSizes sizes;
    deep_rays_.release();  // gives its memory to the buffers of all rays
    if (!memory_.reserve_rays(input.rays)) return {};
    place_candidates(input, timed);
    sizes.candidates = read_total(memory_.candidate_places(), input.rays, timed).segments;
    if (!memory_.reserve_candidates(sizes.candidates)) return {};
    count_segments(input, sizes.candidates, timed);
    sizes.total = read_total(memory_.offsets(), input.rays, timed);
    // Very many words look like the flag, too; then the list of deep rays will be empty.
    has_deep_rays_ = !other_evaluation_ && sizes.total.words >= DEEP_WORDS;
    if (has_deep_rays_) {
        sum_segments(input, 0, timed);
        sizes.total = read_total(memory_.offsets(), input.rays, timed);
    }
    if (!memory_.reserve_segments(sizes.total)) return {};
    if (has_deep_rays_) {
        offsets_ = memory_.offsets().read<kernel::RayCount>(std::size_t{input.rays} + 1);
        if (!deep_rays_.prepare(offsets_, memory_.to_reserve(sizes.total.segments))) return {};
    }
    make_partitions(input, sizes.candidates, sizes.total.segments, timed);
    if (has_deep_rays_) deep_rays_.launch(input.batch, input.work, memory_, timed);
    return sizes;
}

std::optional<PartitionSizes> PartitionPass::capacity_for(std::uint32_t rays) const {
    if (!memory_.holds_rays(rays) || has_deep_rays_) return {};
    // The larger of the two averages counts, because the two batches of a picture may differ.
    const auto expected = [&](double Average::*what) {
        return static_cast<std::uint64_t>(std::max(average_.*what, average_before_.*what) * rays);
    };
    const PartitionSizes capacity = memory_.capacity();
    // The averages of earlier rays say little about these rays, so half of the expected size may suffice.
    if (capacity.candidates == 0 || capacity.total.segments == 0 ||
        expected(&Average::candidates) / 2 > capacity.candidates ||
        expected(&Average::segments) / 2 > capacity.total.segments ||
        expected(&Average::words) / 2 > capacity.total.words)
        return {};
    return capacity;
}

void PartitionPass::trace_queued(const Input& input, const PartitionSizes& capacity, TimedKernels& timed) {
    place_candidates(input, timed);
    count_segments(input, capacity.candidates, timed);
    make_partitions(input, capacity.candidates, capacity.total.segments, timed);
    device_.flush();
}

// Kernel 1, first step: counts each ray's candidates, which gives their positions.
void PartitionPass::place_candidates(const Input& input, TimedKernels& timed) {
    const BatchBuffers& batch = input.batch;
    const Buffer& tile_nodes = input.work == Work::tiles ? batch.tile_nodes : no_buffer_;
    Buffer& places = memory_.candidate_places();
    timed.emplace_back(
        &PipelineCounts::count_segments,
        in_packets(input)
            ? packet_candidates_->count.launch((input.rays + packet_rays - 1) / packet_rays, work_group, batch.frame,
                                               input.scene.nodes(), tile_nodes, batch.rays, batch.tiles, places)
            : find_candidates_.launch(input.rays, work_group, batch.frame, input.scene.nodes(), tile_nodes, batch.rays,
                                      batch.numbers(input.work), places, no_buffer_));
    scan(places, input.rays, timed);
}

// Kernel 1, the other steps: lists the candidates, and counts the segments of each candidate. `candidates`: the number
// of work-items.
void PartitionPass::count_segments(const Input& input, std::uint32_t candidates, TimedKernels& timed) {
    const BatchBuffers& batch = input.batch;
    const Buffer& tile_nodes = input.work == Work::tiles ? batch.tile_nodes : no_buffer_;
    const Buffer& numbers = batch.numbers(input.work);
    const std::size_t listing_rays = candidates ? input.rays : 0;
    const auto add = [&](Event event) { timed.emplace_back(&PipelineCounts::count_segments, std::move(event)); };
    add(in_packets(input)
            ? packet_candidates_->list.launch((listing_rays + packet_rays - 1) / packet_rays, work_group, batch.frame,
                                              input.scene.geometry(), input.scene.nodes(), tile_nodes, batch.rays,
                                              batch.tiles, memory_.candidate_places(), memory_.candidates(),
                                              memory_.found())
            : find_candidates_.launch(listing_rays, work_group, batch.frame, input.scene.nodes(), tile_nodes,
                                      batch.rays, numbers, memory_.candidate_places(), memory_.candidates()));
    device_.flush();
    add(count_segments_.launch(candidates, work_group, batch.frame, input.scene.geometry(), batch.rays, numbers,
                               memory_.candidate_places(), memory_.candidates(), memory_.found()));
    if (rays_in_faces_ && has_flat_faced(*scene_))
        add(rays_in_faces_->count.launch(candidates, work_group, batch.frame, input.scene.geometry(), batch.rays,
                                         numbers, memory_.candidate_places(), memory_.candidates()));
    sum_segments(input, DEEP_WORDS, timed);
}

void PartitionPass::sum_segments(const Input& input, std::uint32_t deep_words, TimedKernels& timed) {
    timed.emplace_back(
        &PipelineCounts::count_segments,
        sum_segments_.launch(input.rays, work_group, input.batch.frame, memory_.candidate_places(),
                             memory_.candidates(), cl_uint{deep_words}, memory_.offsets(), input.batch.report));
    scan(memory_.offsets(), input.rays, timed);
}

// Kernels 2 to 4. `candidates`, `segments`: the numbers of work-items; kernels over boundaries have twice as many.
void PartitionPass::make_partitions(const Input& input, std::uint32_t candidates, std::uint32_t segments,
                                    TimedKernels& timed) {
    const BatchBuffers& batch = input.batch;
    const Buffer& numbers = batch.numbers(input.work);
    const std::size_t boundaries = 2 * std::size_t{segments};
    const auto add = [&](double PipelineCounts::*time, Event event) { timed.emplace_back(time, std::move(event)); };
    add(&PipelineCounts::store_segments,
        store_segments_.launch(segments ? candidates : 0, work_group, batch.frame, input.scene.geometry(), batch.rays,
                               numbers, memory_.candidate_places(), memory_.candidates(), memory_.found(),
                               memory_.offsets(), memory_.boundaries(), memory_.bits()));
    if (rays_in_faces_ && has_flat_faced(*scene_))
        add(&PipelineCounts::store_segments,
            rays_in_faces_->store.launch(segments ? candidates : 0, work_group, batch.frame, input.scene.geometry(),
                                         batch.rays, numbers, memory_.candidate_places(), memory_.candidates(),
                                         memory_.offsets(), memory_.boundaries(), memory_.bits()));
    device_.flush();
    memory_.reserve_partitions(segments);  // the driver keeps the memory that it replaces until kernel 2 has ended
    add(&PipelineCounts::weave, order_boundaries_.launch(boundaries, work_group, batch.frame, memory_.offsets(),
                                                         memory_.boundaries(), memory_.bits(), memory_.partitions()));
    add(&PipelineCounts::weave,
        weave_.launch(input.rays, work_group, batch.frame, batch.rays, numbers, memory_.offsets(), memory_.boundaries(),
                      memory_.partitions(), memory_.bits(), memory_.ray_tallies()));
    add(&PipelineCounts::evaluate,
        other_evaluation_
            ? other_evaluation_->launch(evaluate_, input, memory_, segments)
            : evaluate_.launch(boundaries, work_group, batch.frame, input.scene.evaluation(), batch.rays, numbers,
                               memory_.offsets(), memory_.boundaries(), memory_.bits(), memory_.partitions()));
}

bool PartitionPass::write_rows(const Input& input, std::uint64_t first, Fields fields, TimedKernels& timed) {
    const RowPass::Input of = rows_of(input, first);
    const Buffer* const counts = rows_.count(of, timed);
    if (!counts) return false;
    scan(*counts, input.rays, timed);
    if (!rows_.write(of, read_total(*counts, input.rays, timed), fields, input.scene, timed)) return false;
    if (!rows_.has_overlaps()) return true;
    const Buffer* const claims = rows_.count_claimants(of, input.scene, timed);
    if (!claims) return false;
    scan(*claims, rows_.overlaps(), timed);
    return rows_.list_claimants(of, read_total(*claims, rows_.overlaps(), timed).segments, input.scene, timed);
}

Event PartitionPass::make_rays(const BatchBuffers& batch, std::uint32_t rays, RayRange range) {
    return make_rays_.launch(rays, work_group, batch.frame, cl_double{range.t_near}, cl_double{range.t_far},
                             batch.rays);
}

// Rays that are near each other in memory are read at once.
SomeRays PartitionPass::read_deep_rays() {
    constexpr std::size_t near = 4096;  // segments
    struct Block {
        std::size_t first, end;  // segments
    };
    std::vector<Block> blocks;
    SomeRays deep;
    std::size_t before = 0;  // segments of the earlier blocks
    for (const kernel::DeepRay& listed : deep_rays_.rays()) {
        const std::uint32_t ray = listed.ray;
        const std::size_t first = offsets_[ray].segments, end = offsets_[ray + 1].segments;
        if (blocks.empty() || first > blocks.back().end + near) {
            if (!blocks.empty()) before += blocks.back().end - blocks.back().first;
            blocks.push_back({first, end});
        }
        blocks.back().end = end;
        deep.rays.push_back({ray, static_cast<std::uint32_t>(end - first), before + first - blocks.back().first});
    }
    if (blocks.empty()) return deep;
    const std::size_t segments = before + blocks.back().end - blocks.back().first,
                      segment_bytes = 2 * records_->boundary_bytes(), node_bytes = 2 * sizeof(kernel::PartitionNode);
    if (const std::size_t bytes = segments * (segment_bytes + node_bytes); !deep_ || deep_->size() < bytes) {
        deep_.reset();
        deep_.emplace(device_, "deep rays", bytes + bytes / 4);
    }
    auto* const boundaries = static_cast<std::byte*>(deep_->data());
    auto* const nodes = boundaries + segments * segment_bytes;
    std::vector<Event> reads;
    std::size_t to = 0;
    for (const auto& [first, end] : blocks) {
        const std::size_t count = end - first;
        reads.push_back(memory_.boundaries().queue_read(boundaries + to * segment_bytes, count * segment_bytes,
                                                        first * segment_bytes));
        reads.push_back(
            memory_.partitions().queue_read(nodes + to * node_bytes, count * node_bytes, first * node_bytes));
        to += count;
    }
    for (const Event& read : reads) wait_for(read);
    deep.boundaries = reinterpret_cast<const kernel::Boundary*>(boundaries);
    deep.nodes = reinterpret_cast<const kernel::PartitionNode*>(nodes);
    if (segment_bytes != 2 * sizeof(kernel::Boundary)) {
        deep_boundaries_ = records_->boundaries({boundaries, nodes});
        deep.boundaries = deep_boundaries_.data();
    }
    return deep;
}

TracedBatch PartitionPass::read(std::uint32_t rays) {
    TracedBatch traced;
    traced.offsets = memory_.offsets().read<kernel::RayCount>(std::size_t{rays} + 1);
    const std::size_t boundaries = 2 * std::size_t{traced.offsets.back().segments};
    traced.boundaries =
        records_->boundaries(memory_.boundaries().read<std::byte>(boundaries * records_->boundary_bytes()));
    traced.nodes = memory_.partitions().read<kernel::PartitionNode>(boundaries);
    return traced;
}

void PartitionPass::shade(const Input& input, const Buffer& picture, TimedKernels& timed) {
    timed.emplace_back(
        &PipelineCounts::shade,
        shade_.launch(input.rays, work_group, input.batch.frame, input.scene.geometry(), input.scene.appearance(),
                      input.batch.numbers(input.work), memory_.offsets(), memory_.boundaries(), memory_.partitions(),
                      memory_.ray_tallies(), input.batch.report, picture));
}

// The host reads only the blocks' sums, not every ray's tally.
void PartitionPass::sum_tallies(std::uint32_t rays, TimedKernels& timed) {
    sum_blocks(memory_.ray_tallies(), rays, memory_.tally_sums(), timed);
    tally_count_ = scan_blocks_of(rays);
    read_.start(memory_.tally_sums(), tally_count_ * sizeof(kernel::RayTally));
}

void PartitionPass::add_tallies(PipelineCounts& counts) {
    for (const kernel::RayTally& tally : read_.wait<kernel::RayTally>(tally_count_)) {
        counts.partitions_used += tally.partitions;
        counts.overlaps += tally.overlaps;
    }
}

void PartitionPass::add_sizes(const PartitionSizes& needed, std::uint32_t rays, PipelineCounts& counts) {
    const std::uint64_t nodes = 2 * std::uint64_t{needed.total.segments};
    counts.segments += needed.total.segments;
    counts.ends += nodes;
    counts.partitions_allocated += nodes;
    counts.segment_bytes +=
        nodes * records_->boundary_bytes() +
        needed.candidates * (sizeof(kernel::Candidate) + 2 * std::uint64_t{records_->boundary_bytes()});
    counts.partition_bytes +=
        nodes * sizeof(kernel::PartitionNode) + std::uint64_t{needed.total.words} * sizeof(std::uint32_t);
    average_before_ = std::exchange(average_, {.candidates = double(needed.candidates) / rays,
                                               .segments = double(needed.total.segments) / rays,
                                               .words = double(needed.total.words) / rays});
}

}  // namespace csgrt
