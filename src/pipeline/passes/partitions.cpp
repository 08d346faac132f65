#include "pipeline/passes/partitions.hpp"

#include <algorithm>
#include <utility>

namespace csgrt {
namespace {
constexpr std::uint32_t scan_block = 1024;  // entries that a group of scan.cl sums
std::uint32_t blocks_of(std::uint32_t entries) { return (entries + scan_block - 1) / scan_block; }

std::vector<std::string> files_of(bool packets) {
    std::vector<std::string> files = {Cull::file};
    if (packets) files.push_back("1_packet_candidates.cl");
    files.insert(files.end(),
                 {"1_count_hits.cl", "scan.cl", "2_store_segments.cl", "3_weave.cl", "4_evaluate.cl", "5_shade.cl"});
    return files;
}
}  // namespace

Exact::Exact(Device& device, const CompiledScene& scene, const HostKernels& kernels, const Settings& settings)
    : device_(device),
      scene_(scene),
      kernels_(kernels),
      program_(device, assemble_program(files_of(in_packets(device, settings))), defines_of(device, scene, settings),
               settings.precision != Precision::double_),
      cull_(device, program_),
      find_candidates_(program_.kernel("find_candidates")),
      count_hits_(program_.kernel("count_hits")),
      sum_hits_(program_.kernel("sum_hits")),
      scan_blocks_(program_.kernel("scan_blocks")),
      scan_sums_(program_.kernel("scan_sums")),
      scan_add_(program_.kernel("scan_add")),
      store_segments_(program_.kernel("store_segments")),
      order_ends_(program_.kernel("order_ends")),
      weave_(program_.kernel("weave")),
      evaluate_(program_.kernel("evaluate")),
      shade_(program_.kernel("shade")),
      places_(device, "candidates' places"),
      counts_(device, "counts"),
      candidates_(device, "candidates"),
      found_(device, "candidates' segments, then partitions"),
      ends_(device, "segments"),
      bits_(device, "partitions' bits"),
      sums_(device, "sums of counts"),
      tally_sums_(device, "sums of tallies"),
      read_(device, "sums of tallies"),
      sum_(device, "sum of counts") {
    if (in_packets(device, settings))
        packet_candidates_ = {program_.kernel("count_packet_candidates"), program_.kernel("list_packet_candidates")};
}

std::uint64_t Exact::held() const {
    std::uint64_t sum = 0;
    for (const Buffer* buffer : {&places_, &counts_, &tally_sums_, &candidates_, &found_, &ends_, &bits_})
        sum += buffer->size();
    return sum;
}

void Exact::release() {
    for (Buffer* buffer : {&places_, &counts_, &tally_sums_}) buffer->release();
    release_counted();
}

void Exact::release_counted() {
    for (Buffer* buffer : {&candidates_, &found_, &ends_, &bits_}) buffer->release();
}

void Exact::sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums, TimedKernels& timed) {
    sums.reserve(blocks_of(size) * sizeof(kernel::RayCount));
    timed.emplace_back(&PipelineCounts::scan,
                       scan_blocks_.launch(std::size_t{blocks_of(size)} * work_group, work_group, entries, sums, size));
}

void Exact::queue_scan(Buffer& counts, std::uint32_t rays, TimedKernels& timed) {
    const std::uint32_t entries = rays + 1, tiles = blocks_of(entries);
    sum_blocks(counts, entries, sums_, timed);
    if (tiles > 1) {
        timed.emplace_back(&PipelineCounts::scan, scan_sums_.launch(work_group, work_group, sums_, tiles));
        timed.emplace_back(&PipelineCounts::scan, scan_add_.launch(entries, work_group, counts, sums_, entries));
    }
    device_.flush();
}

// A read that stands behind kernels keeps all copies waiting for them, those of other queues, too: NVIDIA's GPUs make copies to the
// host one after another. So it is asked for only when they are done.
kernel::RayCount Exact::sum_of(const Buffer& counts, const Run& run) {
    wait_for(run.timed.back().second);
    sum_.start(counts, sizeof(kernel::RayCount), run.rays * sizeof(kernel::RayCount));
    sum_.fetch();
    return sum_.wait<kernel::RayCount>(1).front();
}

std::vector<std::pair<Buffer*, std::uint64_t>> Exact::bytes_of_rays(std::uint32_t rays) {
    const std::uint64_t entries = std::uint64_t{rays} + 1;
    return {{&places_, entries * sizeof(kernel::RayCount)},
            {&counts_, entries * sizeof(kernel::RayCount)},
            {&tally_sums_, blocks_of(rays) * sizeof(kernel::RayTally)}};
}

Exact::Needs Exact::room() const {
    const auto holding = [](const Buffer& buffer, std::size_t bytes) {
        return static_cast<std::uint32_t>(std::min<std::size_t>(buffer.size() / bytes, NONE / 2));
    };
    const std::size_t segment = 2 * kernels_.end_bytes();
    return {.candidates = std::min(holding(candidates_, sizeof(kernel::Candidate)), holding(found_, segment)),
            .total = {.segments = std::min(holding(ends_, segment), holding(found_, 2 * sizeof(kernel::PartitionNode))),
                      .words = holding(bits_, sizeof(std::uint32_t))}};
}

// Room for candidates, and for what is found of each.
bool Exact::reserve_candidates(std::uint32_t candidates) {
    const std::uint64_t candidate_bytes = std::uint64_t{candidates} * sizeof(kernel::Candidate);
    const std::uint64_t found_bytes = 2 * std::uint64_t{candidates} * kernels_.end_bytes();
    if (candidates == COUNT_MAX || found_bytes > device_.max_buffer()) return false;
    if (candidate_bytes <= candidates_.size() && found_bytes <= found_.size()) return true;
    const std::uint64_t bytes = candidate_bytes + found_bytes, held = candidates_.size() + found_.size();
    if (bytes > device_.available() + held) release_counted();
    if (bytes > device_.available() + candidates_.size() + found_.size()) return false;
    candidates_.reserve(candidate_bytes);
    found_.reserve(found_bytes);
    return true;
}

// Makes room for the segments and, beside the candidates' or in place of them, the partitions. Buffers only grow, unless that
// would not fit.
bool Exact::reserve_counted(const kernel::RayCount& total) {
    if (total.segments >= NONE / 2 || total.words == COUNT_MAX) return false;
    const std::uint64_t nodes = 2 * std::uint64_t{total.segments};
    const std::pair<Buffer*, std::uint64_t> wanted[] = {{&ends_, nodes * kernels_.end_bytes()},
                                                        {&bits_, std::uint64_t{total.words} * sizeof(std::uint32_t)}};
    const std::uint64_t partitions = nodes * sizeof(kernel::PartitionNode), more = partitions > found_.size() ? partitions : 0;
    std::uint64_t needed = more, grown = more, held = 0;
    if (more > device_.max_buffer()) return false;
    for (const auto& [buffer, bytes] : wanted) {
        if (bytes > device_.max_buffer()) return false;
        needed += bytes;
        grown += std::max<std::uint64_t>(bytes, buffer->size());
        held += buffer->size();
    }
    if (needed > device_.available() + held) return false;
    if (grown > device_.available() + held)
        for (const auto& [buffer, bytes] : wanted) buffer->release();
    for (const auto& [buffer, bytes] : wanted) buffer->reserve(bytes);
    return true;
}

std::optional<Exact::Needs> Exact::weave(const SceneBuffers& scene, const BatchBuffers& batch, std::uint32_t rays, Rays kind,
                                         TimedKernels& timed) {
    if (auto needs = try_weave({scene, batch, rays, kind, timed})) return needs;
    for (const auto& [time, kernel] : timed) wait_for(kernel);  // a fault is not a lack of memory
    release_counted();  // a smaller batch is not to be kept from its own
    return {};
}

std::optional<Exact::Needs> Exact::try_weave(const Run& run) {
    const auto wanted = bytes_of_rays(run.rays);
    std::uint64_t more = 0;
    for (const auto& [buffer, bytes] : wanted) more += bytes > buffer->size() ? bytes : 0;
    if (more > device_.available()) release_counted();
    if (more > device_.available()) return {};
    for (const auto& [buffer, bytes] : wanted) buffer->reserve(bytes);
    Needs needs;
    queue_places(run);
    needs.candidates = sum_of(places_, run).segments;
    if (!reserve_candidates(needs.candidates)) return {};
    queue_counts(run, needs.candidates);
    needs.total = total_ = sum_of(counts_, run);
    if (!reserve_counted(total_)) return {};
    queue_partitions(run, needs.candidates, 2 * std::size_t{total_.segments});
    return needs;
}

bool Exact::hold_rays(std::uint32_t rays) const {
    for (const auto& [buffer, bytes] : const_cast<Exact*>(this)->bytes_of_rays(rays))
        if (bytes > buffer->size()) return false;
    return true;
}

std::optional<Exact::Needs> Exact::capacity_for(std::uint32_t rays) const {
    if (!hold_rays(rays)) return {};
    // The more of two: a picture may well have two batches that differ.
    const auto expected = [&](double RayNeeds::*what) {
        return static_cast<std::uint64_t>(std::max(needed_.*what, needed_before_.*what) * rays);
    };
    const std::uint64_t candidates = expected(&RayNeeds::candidates), segments = expected(&RayNeeds::segments);
    const Needs there = room();
    // What earlier rays needed says little of these: where half of it is there, it may do.
    if (there.candidates == 0 || there.total.segments == 0 || candidates / 2 > there.candidates ||
        segments / 2 > there.total.segments || expected(&RayNeeds::words) / 2 > there.total.words)
        return {};
    return there;
}

void Exact::weave_ahead(const SceneBuffers& scene, const BatchBuffers& batch, std::uint32_t rays, const Needs& capacity,
                        TimedKernels& timed) {
    const Run run{scene, batch, rays, Rays::tiles, timed};
    queue_places(run);
    queue_counts(run, capacity.candidates);
    queue_partitions(run, capacity.candidates, 2 * std::size_t{capacity.total.segments});
    device_.flush();
}

void Exact::queue_places(const Run& run) {
    const SceneBuffers& s = run.scene;
    const BatchBuffers& batch = run.batch;
    const Buffer none(device_, "nothing");
    const Buffer& lists = run.kind == Rays::tiles ? batch.lists : none;
    constexpr std::size_t group = work_group;
    run.timed.emplace_back(
        &PipelineCounts::count_hits,
        by_packets(run) ? packet_candidates_->count.launch(run.rays / packet_rays, group, batch.frame, s.nodes, lists, batch.rays, places_)
                        : find_candidates_.launch(run.rays, group, batch.frame, s.nodes, lists, batch.rays, places_, none));
    queue_scan(places_, run.rays, run.timed);
}

// `candidates`: as many, or as many as there is room for.
void Exact::queue_counts(const Run& run, std::size_t candidates) {
    const SceneBuffers& s = run.scene;
    const BatchBuffers& batch = run.batch;
    const Buffer none(device_, "nothing");
    const Buffer& lists = run.kind == Rays::tiles ? batch.lists : none;
    const std::size_t group = work_group, listed = candidates ? run.rays : 0;
    const auto timed = [&](Event event) { run.timed.emplace_back(&PipelineCounts::count_hits, std::move(event)); };
    timed(by_packets(run)
              ? packet_candidates_->list.launch(listed / packet_rays, group, batch.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words,
                                                s.inner_nodes, s.nodes, lists, batch.rays, places_, candidates_, found_)
              : find_candidates_.launch(listed, group, batch.frame, s.nodes, lists, batch.rays, places_, candidates_));
    device_.flush();
    timed(count_hits_.launch(candidates, group, batch.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words, s.inner_nodes, batch.rays,
                             places_, candidates_, found_));
    timed(sum_hits_.launch(run.rays, work_group, batch.frame, places_, candidates_, counts_));
    queue_scan(counts_, run.rays, run.timed);
}

// `candidates`, `nodes`: as many, or as many as there is room for.
void Exact::queue_partitions(const Run& run, std::size_t candidates, std::size_t nodes) {
    const SceneBuffers& s = run.scene;
    const BatchBuffers& batch = run.batch;
    const auto timed = [&](double PipelineCounts::*time, Event event) { run.timed.emplace_back(time, std::move(event)); };
    timed(&PipelineCounts::store_segments,
          store_segments_.launch(nodes ? candidates : 0, work_group, batch.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words,
                                         s.inner_nodes, batch.rays, places_, candidates_, found_, counts_, ends_, bits_));
    device_.flush();
    Buffer& partitions = found_;  // what it held is stored; a larger one takes its place when the kernel has ended
    partitions.reserve(nodes * sizeof(kernel::PartitionNode));
    timed(&PipelineCounts::weave, order_ends_.launch(nodes, work_group, batch.frame, counts_, ends_, bits_, partitions));
    timed(&PipelineCounts::weave, weave_.launch(run.rays, work_group, batch.frame, batch.rays, counts_, ends_, partitions, bits_, places_));
    timed(&PipelineCounts::evaluate, evaluate_.launch(nodes, work_group, batch.frame, s.solids, s.starts, s.leaves, s.trees, counts_,
                                                              ends_, bits_, partitions));
}

void Exact::add_needs(const Needs& needs, std::uint32_t rays, PipelineCounts& counts) {
    const std::uint64_t nodes = 2 * std::uint64_t{needs.total.segments};
    counts.segments += needs.total.segments;
    counts.hits += nodes;
    counts.partitions_allocated += nodes;
    counts.segment_bytes += nodes * kernels_.end_bytes() +
                            needs.candidates * (sizeof(kernel::Candidate) + 2 * std::uint64_t{kernels_.end_bytes()});
    counts.partition_bytes += nodes * sizeof(kernel::PartitionNode) + std::uint64_t{needs.total.words} * sizeof(std::uint32_t);
    needed_before_ = std::exchange(needed_, {.candidates = double(needs.candidates) / rays,
                                             .segments = double(needs.total.segments) / rays,
                                             .words = double(needs.total.words) / rays});
}

void Exact::shade(const SceneBuffers& s, const BatchBuffers& batch, const Buffer& picture, std::uint32_t rays, TimedKernels& timed) {
    timed.emplace_back(&PipelineCounts::shade,
                       shade_.launch(rays, work_group, batch.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words, s.inner_nodes,
                                     s.regions, s.materials, s.lights, counts_, ends_, found_, places_, batch.rays,
                                     batch.tally, picture));
}

// The first step of a scan leaves the sums of tiles, so that not every ray's tally has to come to the host.
void Exact::tally(std::uint32_t rays, TimedKernels& timed) {
    sum_blocks(places_, rays, tally_sums_, timed);
    tallies_ = blocks_of(rays);
    read_.start(tally_sums_, tallies_ * sizeof(kernel::RayTally));
}

void Exact::fetch() { read_.fetch(); }

void Exact::settle(std::uint32_t rays, bool tallied, TimedKernels& timed, PipelineCounts& counts) {
    if (tallied) tally(rays, timed);
    device_.finish();
    fetch();
    if (tallied) add_tallies(counts);
    add_times(timed, counts);
}

void Exact::add_tallies(PipelineCounts& counts) {
    for (const kernel::RayTally& tally : read_.wait<kernel::RayTally>(tallies_)) {
        counts.partitions_used += tally.partitions;
        counts.overlaps += tally.overlaps;
    }
}

}  // namespace csgrt
