#include "pipeline/exact.hpp"

#include <algorithm>
#include <utility>

#include "kernel_geometry.hpp"

namespace csgrt {
namespace kernel {
#define CSGRT_LARGE_TERMS
#include "../../kernels/boolean.h"
}  // namespace kernel

namespace {
constexpr std::uint32_t scan_block = 1024;  // entries that a group of scan.cl sums
std::uint32_t blocks_of(std::uint32_t entries) { return (entries + scan_block - 1) / scan_block; }

std::vector<std::string> files_of(bool packets) {
    std::vector<std::string> files = {"0_cull_blocks.cl"};
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
      scan_add_(program_.kernel("scan_add")),
      store_segments_(program_.kernel("store_segments")),
      order_ends_(program_.kernel("order_ends")),
      weave_(program_.kernel("weave")),
      evaluate_(program_.kernel("evaluate")),
      shade_(program_.kernel("shade")),
      places_(device, "candidates' places"),
      counts_(device, "counts"),
      firsts_(device, "first partitions"),
      candidates_(device, "candidates"),
      found_(device, "candidates' segments, then partitions"),
      ends_(device, "segments"),
      bits_(device, "partitions' bits"),
      tally_sums_(device, "sums of tallies"),
      read_(device, "sums of tallies"),
      sum_(device, "sum of counts") {
    if (in_packets(device, settings))
        packet_candidates_ = {program_.kernel("count_packet_candidates"), program_.kernel("list_packet_candidates")};
}

std::uint64_t Exact::held() const {
    std::uint64_t sum = 0;
    for (const Buffer* buffer : {&places_, &counts_, &firsts_, &tally_sums_, &candidates_, &found_, &ends_, &bits_})
        sum += buffer->size();
    return sum;
}

void Exact::release() {
    for (Buffer* buffer : {&places_, &counts_, &firsts_, &tally_sums_}) buffer->release();
    release_counted();
}

void Exact::release_counted() {
    for (Buffer* buffer : {&candidates_, &found_, &ends_, &bits_}) buffer->release();
}

void Exact::sum_blocks(const Buffer& entries, std::uint32_t size, Buffer& sums) {
    sums.reserve(blocks_of(size) * sizeof(kernel::RayCount));
    timed_.emplace_back(&PipelineCounts::scan,
                        scan_blocks_.launch(std::size_t{blocks_of(size)} * work_group, work_group, entries, sums, size));
}

void Exact::queue_scan(Buffer& counts, std::uint32_t rays) {
    counts.queue_fill(0, sizeof(kernel::RayCount), rays * sizeof(kernel::RayCount));
    std::vector<std::uint32_t> sizes{rays + 1};
    while (sizes.back() > 1) sizes.push_back(blocks_of(sizes.back()));
    while (sums_.size() < sizes.size()) sums_.push_back(std::make_unique<Buffer>(device_, "sums of counts"));
    const auto level = [&](std::size_t i) -> Buffer& { return i == 0 ? counts : *sums_[i]; };
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) sum_blocks(level(i), sizes[i], level(i + 1));
    for (std::size_t i = sizes.size() - 1; i-- > 1;)
        timed_.emplace_back(&PipelineCounts::scan,
                            scan_add_.launch(sizes[i - 1], work_group, level(i - 1), level(i), sizes[i - 1]));
    device_.flush();
}

// A read that stands behind kernels keeps all copies waiting for them, those of other queues, too: NVIDIA's GPUs make copies to the
// host one after another. So it is asked for only when they are done.
kernel::RayCount Exact::sum_of(const Buffer& counts, std::uint32_t rays) {
    wait_for(timed_.back().second);
    sum_.start(counts, sizeof(kernel::RayCount), rays * sizeof(kernel::RayCount));
    sum_.fetch();
    return sum_.wait<kernel::RayCount>(1).front();
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

bool Exact::weave(const SceneBuffers& scene, const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts,
                  const std::function<void()>& beside) {
    if (try_weave(scene, tile, rays, kind, counts, beside)) return true;
    for (const auto& [time, kernel] : timed_) wait_for(kernel);  // a fault is not a lack of memory
    release_counted();  // a smaller tile is not to be kept from its own
    return false;
}

bool Exact::try_weave(const SceneBuffers& scene, const TileBuffers& tile, std::uint32_t rays, Rays kind, PipelineCounts& counts,
                      const std::function<void()>& beside) {
    const SceneBuffers& s = scene;
    const std::size_t entries = std::size_t{rays} + 1;
    const std::pair<Buffer*, std::uint64_t> wanted[] = {{&places_, entries * sizeof(kernel::RayCount)},
                                                        {&counts_, entries * sizeof(kernel::RayCount)},
                                                        {&firsts_, rays * sizeof(cl_uint)},
                                                        {&tally_sums_, blocks_of(rays) * sizeof(kernel::RayTally)}};
    std::uint64_t more = 0;
    for (const auto& [buffer, bytes] : wanted) more += bytes > buffer->size() ? bytes : 0;
    if (more > device_.available()) release_counted();
    if (more > device_.available()) return false;
    for (const auto& [buffer, bytes] : wanted) buffer->reserve(bytes);
    const auto run = [&](double PipelineCounts::*time, Event event) { timed_.emplace_back(time, std::move(event)); };
    const Buffer none(device_, "nothing");
    const Buffer& lists = kind == Rays::blocks ? tile.lists : none;
    const std::size_t group = uneven_group(device_);
    // Only a picture's blocks hold rays that lie side by side.
    const bool packets = kind == Rays::blocks && packet_candidates_;
    run(&PipelineCounts::count_hits,
        packets ? packet_candidates_->count.launch(rays / packet_rays, group, tile.frame, s.nodes, lists, tile.rays, places_)
                : find_candidates_.launch(rays, group, tile.frame, s.nodes, lists, tile.rays, places_, none));
    queue_scan(places_, rays);
    const cl_uint candidates = sum_of(places_, rays).segments;
    const std::uint64_t candidate_bytes = std::uint64_t{candidates} * sizeof(kernel::Candidate);
    const std::uint64_t found_bytes = 2 * std::uint64_t{candidates} * kernels_.end_bytes();
    if (candidates == COUNT_MAX || found_bytes > device_.max_buffer()) return false;
    if (candidate_bytes > candidates_.size() || found_bytes > found_.size()) {
        const std::uint64_t bytes = candidate_bytes + found_bytes, held = candidates_.size() + found_.size();
        if (bytes > device_.available() + held) release_counted();
        if (bytes > device_.available() + candidates_.size() + found_.size()) return false;
        candidates_.reserve(candidate_bytes);
        found_.reserve(found_bytes);
    }
    const std::size_t listed = candidates ? rays : 0;
    run(&PipelineCounts::count_hits,
        packets ? packet_candidates_->list.launch(listed / packet_rays, group, tile.frame, s.solids, s.reals, s.planes, s.plane_refs,
                                                  s.words, s.inner_nodes, s.nodes, lists, tile.rays, places_, candidates_, found_)
                : find_candidates_.launch(listed, group, tile.frame, s.nodes, lists, tile.rays, places_, candidates_));
    device_.flush();
    run(&PipelineCounts::count_hits, count_hits_.launch(candidates, group, tile.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words,
                                                        s.inner_nodes, tile.rays, candidates, candidates_, found_));
    run(&PipelineCounts::count_hits, sum_hits_.launch(rays, work_group, tile.frame, places_, candidates_, counts_));
    queue_scan(counts_, rays);
    if (beside) beside();
    total_ = sum_of(counts_, rays);
    if (!reserve_counted(total_)) return false;

    const cl_uint nodes = 2 * total_.segments;
    run(&PipelineCounts::store_segments,
        store_segments_.launch(nodes ? candidates : 0, work_group, tile.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words,
                               s.inner_nodes, tile.rays, candidates, candidates_, found_, counts_, ends_, bits_));
    device_.flush();
    Buffer& partitions = found_;  // what it held is stored; a larger one takes its place when the kernel has ended
    partitions.reserve(nodes * sizeof(kernel::PartitionNode));
    run(&PipelineCounts::weave, order_ends_.launch(nodes, work_group, counts_, ends_, bits_, nodes, partitions));
    run(&PipelineCounts::weave,
        weave_.launch(rays, group, tile.frame, tile.rays, counts_, ends_, partitions, bits_, firsts_, places_));
    run(&PipelineCounts::evaluate, evaluate_.launch(nodes, work_group, s.solids, s.starts, s.leaves, s.trees, counts_, ends_, bits_,
                                                    nodes, partitions));

    counts.segments += total_.segments;
    counts.hits += nodes;
    counts.partitions_allocated += nodes;
    counts.segment_bytes += std::uint64_t{nodes} * kernels_.end_bytes() + candidate_bytes + found_bytes;
    counts.partition_bytes +=
        std::uint64_t{nodes} * sizeof(kernel::PartitionNode) + std::uint64_t{total_.words} * sizeof(std::uint32_t);
    return true;
}

void Exact::shade(const SceneBuffers& s, const TileBuffers& tile, const Buffer& picture, std::uint32_t rays) {
    timed_.emplace_back(&PipelineCounts::shade,
                        shade_.launch(rays, work_group, tile.frame, s.solids, s.reals, s.planes, s.plane_refs, s.words, s.inner_nodes,
                                      s.regions, s.materials, s.lights, counts_, ends_, found_, firsts_, places_, tile.rays,
                                      tile.tally, picture));
}

// The first step of a scan leaves the sums of blocks, so that not every ray's tally has to come to the host.
void Exact::tally(std::uint32_t rays) {
    sum_blocks(places_, rays, tally_sums_);
    tallies_ = blocks_of(rays);
    read_.start(tally_sums_, tallies_ * sizeof(kernel::RayTally));
}

void Exact::fetch() {
    read_.fetch();
    for (auto& kernel : timed_) done_.push_back(std::move(kernel));
    timed_.clear();
}

void Exact::settle(std::uint32_t rays, bool tallied, PipelineCounts& counts) {
    if (tallied) tally(rays);
    device_.finish();
    fetch();
    if (tallied) add_tallies(counts);
    add_times(counts);
}

void Exact::forget() noexcept {
    timed_.clear();
    done_.clear();
    read_.forget();
}

void Exact::add_tallies(PipelineCounts& counts) {
    for (const kernel::RayTally& tally : read_.wait<kernel::RayTally>(tallies_)) {
        counts.partitions_used += tally.partitions;
        counts.overlaps += tally.overlaps;
    }
}

void Exact::add_times(PipelineCounts& counts) {
    for (const auto& [time, kernel] : std::exchange(done_, {})) counts.*time += milliseconds(kernel);
}

std::vector<std::vector<ClaimedPartition>> Exact::claims(std::uint32_t rays) const {
    const auto offsets = counts_.read<kernel::RayCount>(std::size_t{rays} + 1);
    const auto firsts = firsts_.read<std::uint32_t>(rays);
    const auto ends = kernels_.ends(ends_.read<std::byte>(2 * std::size_t{total_.segments} * kernels_.end_bytes()));
    const auto nodes = found_.read<kernel::PartitionNode>(2 * std::size_t{total_.segments});
    const auto bits = bits_.read<std::uint32_t>(total_.words);
    std::vector<std::vector<ClaimedPartition>> claims(rays);
    for (std::uint32_t i = 0; i < rays; ++i)
        claims[i] = claims_of(ends, nodes, bits, offsets[i], offsets[i + 1], firsts[i]);
    return claims;
}

// All regions that claim a partition, ascending: found again on the host, only for the few that overlap.
std::vector<std::uint32_t> Exact::claimants(const kernel::End* ends, std::uint32_t segments,
                                            const std::uint32_t* bits) const {
    const kernel::cover cover{
        ends, bits, segments, scene_.solids.data(), scene_.starts.data(), scene_.leaves.data(), scene_.trees.data()};
    kernel::covered_solids covered;
    kernel::list_covered(cover, &covered);
    std::vector<std::uint32_t> claimants;
    for (std::uint32_t segment = 0; segment < segments; ++segment) {
        if (!kernel::covers(cover, segment)) continue;
        const kernel::SolidRecord& solid = scene_.solids[ends[2 * segment].solid];
        for (std::uint32_t i = 0; i < solid.start_count; ++i) {
            const kernel::StartRecord& start = scene_.starts[solid.first_start + i];
            if (kernel::term_holds(cover, &covered, start)) claimants.push_back(start.region);
        }
    }
    std::sort(claimants.begin(), claimants.end());
    claimants.erase(std::unique(claimants.begin(), claimants.end()), claimants.end());
    return claimants;
}

std::vector<ClaimedPartition> Exact::claims_of(const std::vector<kernel::End>& ends,
                                               const std::vector<kernel::PartitionNode>& nodes,
                                               const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                               const kernel::RayCount& end, std::uint32_t first_node) const {
    std::vector<ClaimedPartition> claims;
    const std::uint32_t segments = end.segments - begin.segments;
    const std::size_t base = 2 * std::size_t{begin.segments};
    for (std::uint32_t node = first_node; node != NONE; node = nodes[base + node].next) {
        const kernel::PartitionNode& partition = nodes[base + node];
        const std::uint32_t region = partition.owner & ~OVERLAP;
        if (region == NONE) continue;
        ClaimedPartition claim;
        claim.in = ends[base + partition.in_end];
        claim.out = ends[base + partition.out_end];
        claim.in_leaves = partition.in_end % 2 == 1;
        claim.out_enters = partition.out_end % 2 == 0;
        claim.region = region;
        if (partition.owner & OVERLAP)
            claim.claimants =
                claimants(ends.data() + base, segments, bits.data() + begin.words + node * kernel::words_of(segments));
        claims.push_back(std::move(claim));
    }
    return claims;
}

}  // namespace csgrt
