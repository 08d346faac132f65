#include "pipeline/passes/native_tracer.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/clock.hpp"
#include "pipeline/passes/first_hits.hpp"
#include "rays/overlaps.hpp"

namespace csgrt {
namespace kernel {
#include "../kernels/boolean/status_tree.h"
#include "../kernels/shared/capacity.h"
}  // namespace kernel

namespace {

template <class T>
std::uint64_t argument(T* memory) {
    return reinterpret_cast<std::uintptr_t>(memory);
}
std::uint64_t argument(std::uint32_t value) { return value; }
constexpr const void* none = nullptr;

/// Replaces each count by the sum of the counts before it. `counts` has one more entry, for the sum of all counts.
/// Returns this sum.
kernel::RayCount scan(std::span<kernel::RayCount> counts) {
    std::uint64_t segments = 0, words = 0;
    const auto limited = [](std::uint64_t x) {
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(x, COUNT_MAX));
    };
    for (kernel::RayCount& count : counts.first(counts.size() - 1)) {
        const kernel::RayCount own = count;
        count = {limited(segments), limited(words)};
        segments += own.segments;
        words += own.words;
    }
    return counts.back() = {limited(segments), limited(words)};
}

}  // namespace

/// The memory of one thread.
struct NativeTracer::Scratch {
    std::vector<kernel::RayCount> places, offsets;
    std::vector<kernel::Candidate> candidates;
    std::vector<kernel::Boundary> found, boundaries;
    std::vector<kernel::PartitionNode> nodes;
    std::vector<std::uint32_t> bits;
    std::vector<kernel::RayTally> tallies;
    std::vector<kernel::RowBoundaries> bounds;
    std::vector<kernel::OverlapRecord> overlap_records;
    std::vector<kernel::DeepSegment> deep_segments;
    std::vector<std::uint32_t> status;
    std::vector<kernel::TileNode> lists;

    static Scratch& own() {
        static thread_local Scratch scratch;
        return scratch;
    }
    /// Frees memory that only one batch of many needed.
    void trim() {
        constexpr std::size_t most = std::size_t{1} << 16;
        if (boundaries.size() > 8 * most || candidates.size() > 8 * most) *this = {};
    }
};

/// The data of one batch while its kernels run.
struct NativeTracer::Run {
    const kernel::Frame& frame;
    std::span<const kernel::RayRecord> rays;
    const std::atomic<bool>* stop;
    PipelineCounts& counts;
    Scratch& scratch = Scratch::own();
    kernel::RayCount total{};
    Clock::time_point last = Clock::now();

    template <class... Arguments>
    void operator()(const native::CompiledKernel* kernel, std::size_t items, const Arguments&... arguments) {
        const std::uint64_t all[] = {argument(arguments)...};
        if (std::size(all) != kernel->argument_count) throw std::logic_error(kernel->name);
        native::run_here(*kernel, items, all, stop);
        if (stop && *stop) throw Error(Status::interrupted, "interrupted");
    }
    void lap(double PipelineCounts::*figure) {
        const auto now = Clock::now();
        counts.*figure += std::chrono::duration<double, std::milli>(now - last).count();
        last = now;
    }
};

NativeTracer::NativeTracer(const native::Level& level, const CompiledScene& scene, std::uint64_t budget)
    : scene_(scene), budget_(budget) {
    const auto kernel = [&](const char* name, const char* program = "partitions") {
        const native::CompiledKernel* const found = level.program(program)->kernel(name);
        if (!found) throw std::logic_error(name);
        return found;
    };
    find_candidates_ = kernel("find_candidates");
    count_packet_candidates_ = kernel("count_packet_candidates");
    list_packet_candidates_ = kernel("list_packet_candidates");
    count_segments_ = kernel("count_segments");
    count_in_faces_ = kernel("count_in_faces");
    sum_segments_ = kernel("sum_segments");
    store_segments_ = kernel("store_segments");
    store_in_faces_ = kernel("store_in_faces");
    order_boundaries_ = kernel("order_boundaries");
    weave_ = kernel("weave");
    evaluate_ = kernel("evaluate");
    sort_deep_blocks_ = kernel("sort_deep_blocks");
    merge_deep_runs_ = kernel("merge_deep_runs");
    clear_status_ = kernel("clear_status");
    sweep_deep_rays_ = kernel("sweep_deep_rays");
    count_rows_ = kernel("count_rows");
    write_rows_ = kernel("write_rows");
    describe_rows_ = kernel("describe_rows");
    hit_listed_rays_ = kernel("hit_listed_rays", FirstHitPass::native_program(scene));
}

bool NativeTracer::trace(const kernel::Frame& list, std::span<const kernel::RayRecord> rays, Fields fields,
                         const std::atomic<bool>* stop, RowMemory& rows, PipelineCounts& counts) const {
    kernel::Frame frame = list;
    frame.ray_count = static_cast<std::uint32_t>(rays.size());
    Run run{frame, rays, stop, counts};
    Scratch& s = run.scratch;
    const std::size_t n = rays.size();
    const auto geometry = [&](const native::CompiledKernel* kernel, std::size_t items, const auto&... others) {
        run(kernel, items, &frame, scene_.solids.data(), scene_.reals.data(), scene_.planes.data(), scene_.words.data(),
            scene_.inner_nodes.data(), others...);
    };
    const bool packets = n > 1, flat_faced = (scene_.solid_types & FLAT_FACED) != 0;
    const std::size_t items = packets ? (n + packet_rays - 1) / packet_rays : n;
    kernel::RayCount* const places = room_for(s.places, n + 1);
    const kernel::BvhNode* const nodes = scene_.nodes.data();
    packets ? run(count_packet_candidates_, items, &frame, nodes, none, rays.data(), none, places)
            : run(find_candidates_, items, &frame, nodes, none, rays.data(), none, places, none);
    const std::uint32_t candidate_count = scan({places, n + 1}).segments;
    if (candidate_count * std::uint64_t{sizeof(kernel::Candidate) + 2 * sizeof(kernel::Boundary)} > budget_)
        return false;
    kernel::Candidate* const candidates = room_for(s.candidates, candidate_count);
    kernel::Boundary* const found = room_for(s.found, 2 * std::size_t{candidate_count});
    packets ? geometry(list_packet_candidates_, items, nodes, none, rays.data(), none, places, candidates, found)
            : run(find_candidates_, items, &frame, nodes, none, rays.data(), none, places, candidates);
    geometry(count_segments_, candidate_count, rays.data(), none, places, candidates, found);
    if (flat_faced) geometry(count_in_faces_, candidate_count, rays.data(), none, places, candidates);
    kernel::RayCount* const offsets = room_for(s.offsets, n + 1);
    run(sum_segments_, n, &frame, places, candidates, std::uint32_t{0}, offsets, none);
    run.total = scan({offsets, n + 1});
    run.lap(&PipelineCounts::count_segments);

    const std::size_t boundary_count = 2 * std::size_t{run.total.segments};
    if (boundary_count * (sizeof(kernel::Boundary) + sizeof(kernel::PartitionNode)) +
                run.total.words * std::uint64_t{sizeof(std::uint32_t)} >
            budget_ ||
        run.total.segments >= NONE / 2 || run.total.words == COUNT_MAX)
        return false;
    kernel::Boundary* const boundaries = room_for(s.boundaries, boundary_count);
    std::uint32_t* const bits = room_for(s.bits, std::max<std::size_t>(run.total.words, boundary_count));
    geometry(store_segments_, candidate_count, rays.data(), none, places, candidates, found, offsets, boundaries, bits);
    if (flat_faced)
        geometry(store_in_faces_, candidate_count, rays.data(), none, places, candidates, offsets, boundaries, bits);
    run.lap(&PipelineCounts::store_segments);
    kernel::PartitionNode* const partitions = room_for(s.nodes, boundary_count);
    kernel::RayTally* const tallies = room_for(s.tallies, n);
    run(order_boundaries_, boundary_count, &frame, offsets, boundaries, bits, partitions);
    run(weave_, n, &frame, rays.data(), none, offsets, boundaries, partitions, bits, tallies);
    run.lap(&PipelineCounts::weave);
    run(evaluate_, boundary_count, &frame, scene_.solids.data(), scene_.starts.data(), scene_.trees.data(), rays.data(),
        none, offsets, boundaries, bits, partitions);
    trace_deep_rays(run);
    run.lap(&PipelineCounts::evaluate);
    write_rows(run, fields, rows);
    run.lap(&PipelineCounts::rows);

    for (std::size_t i = 0; i < n; ++i) counts.partitions_used += tallies[i].partitions;
    counts.segments += run.total.segments;
    counts.ends += boundary_count;
    counts.partitions_allocated += boundary_count;
    counts.segment_bytes += boundary_count * sizeof(kernel::Boundary) +
                            candidate_count * std::uint64_t{sizeof(kernel::Candidate) + 2 * sizeof(kernel::Boundary)};
    counts.partition_bytes += boundary_count * sizeof(kernel::PartitionNode) + run.total.words * sizeof(std::uint32_t);
    ++counts.batches;
    s.trim();
    return true;
}

void NativeTracer::trace(const kernel::Frame& frame, const RayList& rays, std::uint64_t first, std::uint64_t end,
                         const std::atomic<bool>* stop, RowReceiver& receiver, PipelineCounts& counts) const {
    static thread_local RowMemory rows;
    std::array<kernel::RayRecord, batch_rays> memory;
    std::uint64_t size = batch_rays;
    while (first < end) {
        const std::span records = std::span(memory).first(std::min(size, end - first));
        rays.fill(first, records);
        // First hits are searched in the order of the solids' boxes, but a plate that a ray grazes may begin before its
        // box. Packets do not help for points, which may lie far from each other.
        const bool by_hits =
            frame.first_row && !frame.whole_lines && records.size() > 1 && records[0].t_near < records[0].t_far;
        if (!(by_hits && hit(frame, records, receiver.fields(), stop, rows, counts)) &&
            !trace(frame, records, receiver.fields(), stop, rows, counts)) {
            if (records.size() == 1) throw_too_long_ray(budget_);
            size = records.size() / 2;
            continue;
        }
        receiver.put(rows.view(first, records.size(), receiver.fields()));
        counts.done.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(records.size())});
        first += records.size();
    }
}

bool NativeTracer::hit(const kernel::Frame& list, std::span<const kernel::RayRecord> rays, Fields fields,
                       const std::atomic<bool>* stop, RowMemory& rows, PipelineCounts& counts) const {
    kernel::Frame frame = list;
    frame.ray_count = static_cast<std::uint32_t>(rays.size());
    Run run{frame, rays, stop, counts};
    const std::size_t n = rays.size(), items = (n + packet_rays - 1) / packet_rays;
    std::vector<std::uint32_t>&found = run.scratch.bits, &solids = run.scratch.status;
    rows.reserve(n, {.solids = true, .normals = fields.normals, .overlaps = false});
    room_for(found, n);
    room_for(solids, n);
    Vec3* const normals = fields.normals ? rows.in_normals.data() : nullptr;
    run(hit_listed_rays_, items, &frame, scene_.solids.data(), scene_.reals.data(), scene_.planes.data(),
        scene_.words.data(), scene_.inner_nodes.data(), scene_.nodes.data(), scene_.starts.data(), scene_.trees.data(),
        rays.data(), room_for(run.scratch.lists, items * PACKET_NODES), found.data(), rows.in.data(), solids.data(),
        normals);
    run.lap(&PipelineCounts::first_hits);
    kernel::RayCount* const places = room_for(rows.places, n + 1);
    std::uint32_t row = 0;
    for (std::size_t i = 0; i < n; ++i) {
        places[i] = {row, 0};
        if (found[i] == HIT_UNKNOWN) return false;
        if (found[i] == NONE) continue;
        const bool is_cut = solids[i] == NONE;
        rows.regions[row] = static_cast<std::int32_t>(found[i]);
        rows.in[row] = rows.in[i];
        rows.in_solids[row] = is_cut ? -1 : static_cast<std::int32_t>(solids[i]);
        if (normals) normals[row] = is_cut ? Vec3{} : normals[i];
        ++row;
    }
    places[n] = {row, 0};
    ++counts.batches;
    return true;
}

// The steps are the same as in DeepRayPass (src/pipeline/passes/deep_rays.hpp).
void NativeTracer::trace_deep_rays(Run& run) const {
    Scratch& s = run.scratch;
    constexpr std::uint32_t field_in_boundary = 0, field_next = 2;  // of kernel::PartitionNode
    const auto regions = static_cast<std::uint32_t>(scene_.regions.size());
    for (std::uint32_t ray = 0; ray < run.rays.size(); ++ray) {
        const std::uint32_t segments = s.offsets[ray + 1].segments - s.offsets[ray].segments, boundaries = 2 * segments;
        if (segments <= DEEP_SEGMENTS) continue;
        const StatusTree& tree = LateStatusTree::of(scene_);
        const auto cluster_words = static_cast<std::uint32_t>(tree.outside.size()),
                   words = cluster_words + kernel::words_of_set(regions), all = SIDES * words;
        std::uint32_t* const status = room_for(s.status, all);
        kernel::DeepSegment* const of_segments = room_for(s.deep_segments, segments);
        kernel::DeepRay deep{};
        deep.ray = ray;
        deep.open = deep.last = NONE;
        const std::uint32_t blocks = (boundaries + DEEP_BLOCK - 1) / DEEP_BLOCK;
        std::uint32_t field = field_next;
        for (std::uint64_t length = DEEP_BLOCK; length < boundaries; length *= 2)
            field ^= field_next ^ field_in_boundary;
        run(sort_deep_blocks_, blocks, &deep, 1u, blocks, s.offsets.data(), s.boundaries.data(), s.nodes.data(), field);
        for (std::uint32_t length = DEEP_BLOCK; length < boundaries; length *= 2) {
            run(merge_deep_runs_, blocks, &deep, 1u, blocks, s.offsets.data(), s.boundaries.data(), s.nodes.data(),
                field, length);
            field ^= field_next ^ field_in_boundary;
        }
        run(clear_status_, all, tree.outside.data(), cluster_words, words, all, status);
        while (deep.changed < boundaries)
            run(sweep_deep_rays_, 1, &run.frame, run.rays.data(), none, &deep, 0u, 0u, 1u, s.offsets.data(),
                s.boundaries.data(), s.nodes.data(), of_segments, status, cluster_words, regions, tree.links.data(),
                tree.first_leaves.data(), tree.leaves.data(), 16'384u, s.tallies.data());
    }
}

void NativeTracer::write_rows(Run& run, Fields fields, RowMemory& rows) const {
    Scratch& s = run.scratch;
    const std::size_t n = run.rays.size();
    const void* const offsets = s.offsets.data();
    kernel::RayCount* const places = room_for(rows.places, n + 1);
    run(count_rows_, n, &run.frame, run.rays.data(), offsets, s.boundaries.data(), s.nodes.data(), places);
    const kernel::RayCount total = scan({places, n + 1});
    rows.reserve(total.segments, fields);
    run.counts.overlaps += total.words;
    kernel::RowBoundaries* const bounds =
        fields.solids || fields.normals ? room_for(s.bounds, total.segments) : nullptr;
    kernel::OverlapRecord* const overlap_records = fields.overlaps ? room_for(s.overlap_records, total.words) : nullptr;
    run(write_rows_, n, &run.frame, run.rays.data(), offsets, s.boundaries.data(), s.nodes.data(), places,
        rows.regions.data(), rows.in.data(), rows.out.data(), bounds, overlap_records);
    if (bounds)
        run(describe_rows_, total.segments, &run.frame, scene_.solids.data(), scene_.reals.data(), scene_.planes.data(),
            scene_.words.data(), scene_.inner_nodes.data(), run.rays.data(), s.boundaries.data(), bounds,
            total.segments, fields.solids ? rows.in_solids.data() : nullptr,
            fields.solids ? rows.out_solids.data() : nullptr, fields.normals ? rows.in_normals.data() : nullptr,
            fields.normals ? rows.out_normals.data() : nullptr);
    if (fields.overlaps)
        append_overlaps(scene_, {overlap_records, total.words}, {s.offsets.data(), s.boundaries.data(), s.nodes.data()},
                        rows);
}

}  // namespace csgrt
