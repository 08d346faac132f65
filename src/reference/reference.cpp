#include "reference/reference.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "base/parallel.hpp"
#include "compile/flatten/attributes.hpp"
#include "kernel_host/geometry.hpp"
#include "rays/grid.hpp"
#include "rays/overlaps.hpp"
#include "reference/precision/double_fma.hpp"

namespace csgrt {

namespace {

/// A partition that at least one region claims.
struct ClaimedPartition {
    kernel::Boundary in, out;              ///< the boundaries of the partition, with the partition's t
    bool in_leaves = false;                ///< `in` is where its solid ends (a subtraction exposes this surface)
    bool out_enters = false;               ///< `out` is where its solid begins
    std::uint32_t region = 0;              ///< the lowest claimant
    std::vector<std::uint32_t> claimants;  ///< all of the region's rank, ascending; empty if there is only one
};

}  // namespace

// The answer of one ray, and memory that is used for one ray after another.
struct Reference::RayAnswer {
    std::vector<kernel::Boundary> boundaries;
    std::vector<ClaimedPartition> partitions;
    Weaver weaver;
    std::vector<std::uint32_t> solids, table,
        claimants;                      ///< of a partition: its solids, their regions, the regions that claim it
    std::vector<std::uint32_t> beside;  ///< the claimants on one side of a face in which the ray runs
    std::vector<std::uint8_t> values;   ///< of a tree's operands, while it is evaluated
    std::vector<kernel::Boundary> row_boundaries;  ///< of a list's ray
    std::vector<kernel::PartitionNode> nodes;
    std::vector<kernel::OverlapRecord> overlap_records;
    std::size_t woven = 0, overlaps = 0;
    std::size_t first_seen = SIZE_MAX;  ///< index in `partitions` of the first partition that ends behind t_min
};

std::unique_ptr<ReferenceKernels> make_kernels(const CompiledScene& scene, const Settings& settings) {
    const Laboratory& methods = laboratory(settings);
    if (settings.precision == Precision::single)
        return (methods.single_world ? make_single_world_kernels : make_single_kernels)(scene, methods.quartic);
    return (settings.precision == Precision::quad ? make_quad_kernels : make_double_kernels)(scene, methods.quartic);
}

std::unique_ptr<ReferenceKernels> make_kernels_to_run(const CompiledScene& scene, const Settings& settings) {
#ifdef CSGRT_DOUBLE_FMA
    if (settings.precision == Precision::double_ && __builtin_cpu_supports("fma"))
        return make_fused_kernels(scene, laboratory(settings).quartic);
#endif
    return make_kernels(scene, settings);
}

Ray ReferenceKernels::camera_ray(const kernel::Frame& frame, std::uint32_t x, std::uint32_t y) const {
    return ray_of(kernel::camera_ray(&frame, {x, y, 1}));
}

Reference::Reference(const CompiledScene& scene, const ReferenceKernels& kernels)
    : scene_(scene), kernels_(kernels), near_(scene) {
    regions_of_.resize(scene.solids.size());
    for (std::uint32_t region = 0; region < scene.flat_trees.size(); ++region) {
        if (!scene.claims.empty() && !scene.claims[region]) continue;
        for (const FlatTree::Node& node : scene.flat_trees[region].nodes) {
            if (node.op != Operator::leaf) continue;
            auto& list = regions_of_[node.solid];
            if (list.empty() || list.back() != region) list.push_back(region);
        }
    }
}

// The tree's nodes are in postfix order: an operator finds its operands' values on the stack.
bool Reference::inside(std::uint32_t region, const std::vector<std::uint32_t>& solids,
                       std::vector<std::uint8_t>& values) const {
    values.clear();
    for (const FlatTree::Node& node : scene_.flat_trees[region].nodes) {
        if (node.op == Operator::leaf) {
            values.push_back(std::binary_search(solids.begin(), solids.end(), node.solid));
            continue;
        }
        const std::size_t first = values.size() - node.arity;
        bool value = values[first] != 0;
        for (std::size_t i = first + 1; i < values.size(); ++i) {
            const bool operand = values[i] != 0;
            if (node.op == Operator::union_) value = value || operand;
            if (node.op == Operator::intersection) value = value && operand;
            if (node.op == Operator::difference) value = value && !operand;
            if (node.op == Operator::xor_) value = value != operand;
        }
        if (node.op == Operator::not_) value = !value;
        values.resize(first);
        values.push_back(value);
    }
    return !values.empty() && values.back() != 0;
}

bool Reference::in_contact(const WovenPartition& partition, const std::vector<kernel::Boundary>& boundaries) {
    return std::any_of(partition.segments.begin(), partition.segments.end(),
                       [&](std::uint32_t segment) { return (boundaries[2 * segment].surface & MISSED) != 0; });
}

bool Reference::is_one_solid(const WovenPartition& partition, const std::vector<kernel::Boundary>& boundaries) {
    const auto solid = [&](std::uint32_t segment) { return boundaries[2 * segment].solid; };
    return std::ranges::all_of(partition.segments,
                               [&](std::uint32_t segment) { return solid(segment) == solid(partition.segments[0]); });
}

void Reference::find_claimants(const WovenPartition& partition, std::uint32_t missed, RayAnswer& answer,
                               std::vector<std::uint32_t>& claimants) const {
    auto &solids = answer.solids, &table = answer.table;
    solids.clear();
    table.clear();
    claimants.clear();
    for (const std::uint32_t segment : partition.segments) {
        const kernel::Boundary& end = answer.boundaries[2 * segment];
        if (!(end.surface & missed)) solids.push_back(end.solid);
    }
    std::sort(solids.begin(), solids.end());
    for (const std::uint32_t solid : solids)
        table.insert(table.end(), regions_of_[solid].begin(), regions_of_[solid].end());
    std::sort(table.begin(), table.end());
    table.erase(std::unique(table.begin(), table.end()), table.end());
    for (const std::uint32_t region : table)
        if (inside(region, solids, answer.values)) claimants.push_back(region);
    if (claimants.empty()) return;
    // Claimants of a later rank are removed, and no overlap with them is reported.
    const std::uint32_t rank = rank_of(scene_.region_info[claimants.front()]);
    std::erase_if(claimants, [&](std::uint32_t region) { return rank_of(scene_.region_info[region]) != rank; });
}

// The side whose claimants have the least numbers decides the partition and its overlap.
void Reference::find_beside(const WovenPartition& partition, std::uint32_t beyond, RayAnswer& answer) const {
    auto &claimants = answer.claimants, &here = answer.beside;
    claimants.clear();
    const auto second = [](const std::vector<std::uint32_t>& of) { return of.size() > 1 ? of[1] : NONE; };
    for (const std::uint32_t side : {MISSED_ABOVE, MISSED_BELOW, MISSED_LEFT, MISSED_RIGHT}) {
        if (side & beyond) continue;
        find_claimants(partition, side, answer, here);
        if (here.empty()) continue;
        if (claimants.empty() || here.front() < claimants.front() ||
            (here.front() == claimants.front() && second(here) < second(claimants)))
            claimants.swap(here);
    }
}

void Reference::evaluate(const kernel::Frame& frame, const kernel::RayRecord& ray, RayAnswer& answer) const {
    answer.partitions.clear();
    answer.woven = answer.overlaps = 0;
    answer.first_seen = SIZE_MAX;
    const std::span<const WovenPartition> woven = kernels_.trace(frame, ray, near_, answer.boundaries, answer.weaver);
    if (answer.boundaries.empty()) return;
    answer.woven = woven.size();
    const bool is_picture = frame.work != WORK_RAYS;
    ReferenceKernels::Seen seen{0, std::numeric_limits<double>::infinity(), 0};
    if (is_picture || frame.clip_count)
        seen = kernels_.seen(frame, {{ray.ox, ray.oy, ray.oz}, {ray.dx, ray.dy, ray.dz}});

    const std::vector<std::uint32_t>& claimants = answer.claimants;
    for (const WovenPartition& partition : woven) {
        if (seen.beyond || (in_contact(partition, answer.boundaries) && !is_one_solid(partition, answer.boundaries))) {
            find_beside(partition, seen.beyond, answer);
        } else {
            find_claimants(partition, 0, answer, answer.claimants);
        }
        if (claimants.size() > 1) ++answer.overlaps;
        if (claimants.empty()) continue;

        ClaimedPartition claim;
        claim.in = answer.boundaries[partition.in_boundary];
        claim.out = answer.boundaries[partition.out_boundary];
        claim.in.t = partition.in;
        claim.out.t = partition.out;
        claim.in_leaves = partition.in_boundary % 2 == 1;
        claim.out_enters = partition.out_boundary % 2 == 0;
        claim.region = claimants.front();
        if (claimants.size() > 1) claim.claimants = claimants;
        const bool is_in_range = partition.out > seen.after && partition.in < seen.before && seen.after < seen.before;
        const bool is_seen = is_in_range && rank_of(scene_.region_info[claim.region]) != RANK_HIDDEN;
        answer.partitions.push_back(std::move(claim));
        if (answer.first_seen == SIZE_MAX && is_seen) {
            answer.first_seen = answer.partitions.size() - 1;
            if (!frame.every_partition) return;
        }
    }
}

// The results do not depend on the thread that computes a part.
template <class Work>
void Reference::parallel(std::size_t count, Watch* watch, const Work& work) const {
    std::mutex mutex;
    if (watch) watch->begin(count);
    for_chunks(count, 64, 0, [&](std::size_t begin, std::size_t end, std::size_t) {
        RayAnswer answer;
        work(begin, end, answer, mutex);
        if (watch) watch->add(end - begin);
    });
}

std::vector<kernel::Pixel> Reference::render(const PreparedFrame& prepared, Watch* watch, ReferenceCounts& counts,
                                             const std::vector<std::uint32_t>* some) const {
    const kernel::Frame& frame = prepared.frame;
    std::vector<kernel::Pixel> pixels(some ? some->size() : std::size_t{frame.width} * frame.height);
    parallel(pixels.size(), watch, [&](std::size_t begin, std::size_t end, RayAnswer& answer, std::mutex& mutex) {
        ReferenceCounts sum;
        for (std::size_t i = begin; i < end; ++i) {
            if (watch) watch->check();
            const std::size_t number = some ? (*some)[i] : i;
            const Ray ray = kernels_.camera_ray(frame, static_cast<std::uint32_t>(number % frame.width),
                                                static_cast<std::uint32_t>(number / frame.width));
            evaluate(
                frame,
                {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, 0, 0},
                answer);
            kernel::Pixel pixel;
            if (answer.first_seen == SIZE_MAX) {
                pixel = kernel::background_pixel(&frame);
            } else {
                const ClaimedPartition& hit = answer.partitions[answer.first_seen];
                const kernel::MaterialRecord& material = scene_.materials[hit.region];
                pixel = kernels_.hit_pixel(frame, prepared.lights, hit.region, material, ray, hit.in, hit.in_leaves);
            }
            pixel.depth = static_cast<std::uint32_t>(answer.boundaries.size() / 2);
            pixel.partitions = static_cast<std::uint32_t>(answer.woven);
            pixel.overlap = static_cast<std::uint32_t>(answer.overlaps);
            pixels[i] = pixel;
            sum.ends += answer.boundaries.size();
            sum.segments += answer.boundaries.size() / 2;
            sum.partitions += answer.woven;
            sum.overlaps += answer.overlaps;
        }
        const std::lock_guard lock(mutex);
        counts.ends += sum.ends;
        counts.segments += sum.segments;
        counts.partitions += sum.partitions;
        counts.overlaps += sum.overlaps;
    });
    return pixels;
}

// Each claim becomes a node, as kernel 4 writes nodes: a boundary's index is odd where a solid ends.
void Reference::append_rows(const kernel::Frame& frame, const kernel::RayRecord& record, std::uint32_t ray,
                            Fields fields, RayAnswer& answer, RowMemory& rows) const {
    const std::size_t count = answer.partitions.size();
    answer.row_boundaries.assign(4 * count, kernel::Boundary{});
    answer.nodes.assign(2 * ((count + 1) / 2), kernel::PartitionNode{NONE, NONE, NONE, NONE});
    for (std::uint32_t i = 0; i < count; ++i) {
        const ClaimedPartition& claim = answer.partitions[i];
        const std::uint32_t in = 4 * i + (claim.in_leaves ? 1 : 0), out = 4 * i + (claim.out_enters ? 2 : 3);
        answer.row_boundaries[in] = claim.in;
        answer.row_boundaries[out] = claim.out;
        answer.nodes[i] = {in, out, i + 1 < count ? i + 1 : NONE,
                           claim.region | (claim.claimants.empty() ? 0 : OVERLAP)};
    }
    kernels_.append_rows(frame, record, answer.row_boundaries, answer.nodes, fields, rows, answer.overlap_records);
    if (!fields.overlaps) return;
    for (const kernel::OverlapRecord& overlap_record : answer.overlap_records)
        append_overlap(ray, overlap_record.in, overlap_record.out, answer.partitions[overlap_record.node].claimants,
                       rows);
}

void Reference::trace(const kernel::Frame& frame, const RayList& list, RowReceiver& receiver, Watch* watch,
                      ReferenceCounts& counts) const {
    const auto trace_some = [&](std::size_t begin, std::size_t end, RayAnswer& answer, std::mutex& mutex) {
        ReferenceCounts sum;
        RowMemory rows;
        rows.places.resize(1);
        for (std::size_t i = begin; i < end; ++i) {
            if (watch) watch->check();
            const kernel::RayRecord record = list.record(i);
            kernels_.check(record, i);
            evaluate(frame, record, answer);
            append_rows(frame, record, static_cast<std::uint32_t>(i - begin), receiver.fields(), answer, rows);
            rows.places.push_back({static_cast<std::uint32_t>(rows.regions.size()), 0});
            sum.ends += answer.boundaries.size();
            sum.segments += answer.boundaries.size() / 2;
            sum.partitions += answer.woven;
            sum.overlaps += answer.overlap_records.size();
        }
        receiver.put(rows.view(begin, end - begin, receiver.fields()));
        const std::lock_guard lock(mutex);
        counts.ends += sum.ends;
        counts.segments += sum.segments;
        counts.partitions += sum.partitions;
        counts.overlaps += sum.overlaps;
    };
    parallel(list.size(), watch, [&](std::size_t begin, std::size_t end, RayAnswer& answer, std::mutex& mutex) {
        receiver.guard([&] { trace_some(begin, end, answer, mutex); });
    });
}

}  // namespace csgrt
