#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <bit>

#include "kernel_geometry.hpp"

namespace csgrt {
namespace kernel {
#define CSGRT_TREE_STACK TREE_STACK
#include "../../kernels/boolean.h"
}  // namespace kernel

namespace {

constexpr std::size_t group = 64;           // work-items: one size for all kernels, so that each is compiled once
constexpr std::uint32_t scan_block = 1024;  // entries that a group of scan.cl sums
// What a ray needs on the device whatever it hits, pictured or listed, with its share of the scan's sums.
constexpr std::uint64_t ray_bytes =
    sizeof(kernel::RayCount) + sizeof(kernel::RayResult) + std::max(sizeof(kernel::Pixel), sizeof(kernel::RayRecord)) + 4;
constexpr std::uint64_t most_rays = 1u << 24;  // of one tile: launches stay short

std::vector<std::string> defines_of(const CompiledScene& scene, const Settings& settings) {
    return {"CSGRT_SOLIDS=" + std::to_string(scene.solid_types) + "u",
            "CSGRT_TREE_STACK=" + std::to_string(std::max(1u, scene.tree_stack)),
            "CSGRT_QUARTIC=" + std::to_string(static_cast<int>(settings.quartic))};
}

}  // namespace

SceneBuffers::SceneBuffers(Device& device, const CompiledScene& scene)
    : solids(device, "solids", scene.solids),
      reals(device, "solids' parameters", scene.reals),
      planes(device, "planes", scene.planes),
      plane_refs(device, "references to planes", scene.plane_refs),
      words(device, "solids' parts", scene.words),
      inner_nodes(device, "bounding volumes of solids' parts", scene.inner_nodes),
      region_lists(device, "solids' regions", scene.region_lists),
      regions(device, "regions", scene.regions),
      trees(device, "trees", scene.trees),
      materials(device, "materials", scene.materials),
      nodes(device, "bounding volumes", scene.nodes) {}

struct Pipeline::Tile {
    std::uint32_t first_ray = 0, rays = 0;
    kernel::RayCount total{};
};

Pipeline::Pipeline(Device& device, const CompiledScene& scene, const Settings& settings)
    : device_(device),
      scene_(scene),
      buffers_(device, scene),
      program_(device,
               assemble_program({"1_count_hits.cl", "scan.cl", "2_store_segments.cl", "3_weave.cl", "4_evaluate.cl", "5_shade.cl"}),
               defines_of(scene, settings)),
      count_hits_(program_.kernel("count_hits")),
      scan_blocks_(program_.kernel("scan_blocks")),
      scan_add_(program_.kernel("scan_add")),
      store_segments_(program_.kernel("store_segments")),
      weave_(program_.kernel("weave")),
      evaluate_(program_.kernel("evaluate")),
      shade_(program_.kernel("shade")),
      frame_(device, "frame", sizeof(kernel::Frame)),
      lights_(device, "lights"),
      rays_(device, "rays"),
      counts_(device, "counts"),
      results_(device, "results"),
      pixels_(device, "pixels"),
      ends_(device, "segments"),
      partitions_(device, "partitions"),
      bits_(device, "partitions' bits"),
      candidates_(device, "candidate regions") {}

// Exclusive prefix sums over the first `size` counts, level by level.
double Pipeline::scan(std::uint32_t size) {
    std::vector<std::uint32_t> sizes{size};
    while (sizes.back() > 1) sizes.push_back((sizes.back() + scan_block - 1) / scan_block);
    while (sums_.size() < sizes.size()) sums_.push_back(std::make_unique<Buffer>(device_, "sums of counts"));
    std::vector<Event> events;
    const auto level = [&](std::size_t i) -> Buffer& { return i == 0 ? counts_ : *sums_[i]; };
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
        level(i + 1).reserve(sizes[i + 1] * sizeof(kernel::RayCount));
        events.push_back(scan_blocks_.launch(sizes[i + 1] * group, group, level(i), level(i + 1), sizes[i]));
    }
    for (std::size_t i = sizes.size() - 1; i-- > 1;)
        events.push_back(scan_add_.launch(sizes[i - 1], group, level(i - 1), level(i), sizes[i - 1]));
    double sum = 0;
    for (const Event& event : events) sum += milliseconds(event);
    return sum;
}

// Gives back what holds segments and partitions: memory that another use of the budget wants.
void Pipeline::release_counted() {
    for (Buffer* buffer : {&ends_, &partitions_, &bits_, &candidates_}) *buffer = Buffer(device_, buffer->name());
}

// Returns false if the tile's segments do not fit; nothing is lost then, the caller takes a smaller tile.
bool Pipeline::run_tile(const PreparedFrame& prepared, Tile& tile, bool pictured, PipelineCounts& counts) {
    kernel::Frame frame = prepared.frame;
    frame.first_ray = tile.first_ray;
    frame.ray_count = tile.rays;
    const std::size_t entries = std::size_t{tile.rays} + 1;
    if (tile.rays * ray_bytes > device_.available()) release_counted();
    counts_.reserve(entries * sizeof(kernel::RayCount));
    results_.reserve(tile.rays * sizeof(kernel::RayResult));
    if (pictured) pixels_.reserve(tile.rays * sizeof(kernel::Pixel));
    if (frame.listed) {  // the device holds this tile's part of the list only
        frame.first_ray = 0;
        rays_.reserve(tile.rays * sizeof(kernel::RayRecord));
        rays_.upload(list_.data() + tile.first_ray, tile.rays * sizeof(kernel::RayRecord));
    }
    frame_.upload(&frame, sizeof frame);

    const SceneBuffers& s = buffers_;
    const kernel::RayCount zero{};
    counts_.upload(&zero, sizeof zero, tile.rays * sizeof zero);
    const Event count = count_hits_.launch(tile.rays, group, frame_, s.solids, s.reals, s.planes, s.plane_refs, s.words, s.inner_nodes, s.nodes,
                                           rays_, counts_);
    const double scan_time = scan(static_cast<std::uint32_t>(entries));
    counts_.read(&tile.total, sizeof tile.total, tile.rays * sizeof tile.total);
    counts.count_hits += milliseconds(count);
    counts.scan += scan_time;

    const kernel::RayCount total = tile.total;
    const std::uint64_t node_count = 2 * std::uint64_t{total.segments};
    const std::uint64_t end_bytes = node_count * sizeof(kernel::End);
    const std::uint64_t node_bytes = node_count * sizeof(kernel::PartitionNode);
    const std::uint64_t bit_bytes = std::uint64_t{total.words} * sizeof(std::uint32_t);
    const std::uint64_t candidate_bytes = std::uint64_t{total.regions} * sizeof(std::uint32_t);
    const std::uint64_t largest = std::max({end_bytes, node_bytes, bit_bytes, candidate_bytes});
    // Buffers only grow, unless that would not fit.
    const std::uint64_t held = ends_.size() + partitions_.size() + bits_.size() + candidates_.size();
    const std::uint64_t grown = std::max<std::uint64_t>(end_bytes, ends_.size()) +
                                std::max<std::uint64_t>(node_bytes, partitions_.size()) +
                                std::max<std::uint64_t>(bit_bytes, bits_.size()) +
                                std::max<std::uint64_t>(candidate_bytes, candidates_.size());
    if (grown > device_.available() + held) release_counted();
    const bool saturated = total.segments >= NONE / 2 || total.words == COUNT_MAX || total.regions == COUNT_MAX;
    if (saturated || largest > device_.max_buffer()) return false;
    const std::uint64_t free = device_.available() + ends_.size() + partitions_.size() + bits_.size() + candidates_.size();
    if (end_bytes + node_bytes + bit_bytes + candidate_bytes > free) return false;
    ends_.reserve(end_bytes);
    partitions_.reserve(node_bytes);
    bits_.reserve(bit_bytes);
    candidates_.reserve(candidate_bytes);

    const Event store = store_segments_.launch(total.segments ? tile.rays : 0, group, frame_, s.solids, s.reals, s.planes,
                                               s.plane_refs, s.words, s.inner_nodes, s.nodes, rays_, counts_, ends_);
    const Event weave = weave_.launch(tile.rays, group, frame_, rays_, counts_, ends_, partitions_, bits_, results_);
    const Event evaluate = evaluate_.launch(total.segments ? tile.rays : 0, group, frame_, s.solids, s.regions,
                                            s.region_lists, s.trees, counts_, ends_, partitions_, bits_, candidates_, results_);
    Event shade;
    if (pictured)
        shade = shade_.launch(tile.rays, group, frame_, s.solids, s.reals, s.planes, s.plane_refs, s.words, s.inner_nodes, s.regions, s.materials,
                              lights_, counts_, ends_, partitions_, results_, pixels_);
    counts.store_segments += milliseconds(store);
    counts.weave += milliseconds(weave);
    counts.evaluate += milliseconds(evaluate);
    counts.shade += milliseconds(shade);

    counts.segments += total.segments;
    counts.hits += node_count;
    counts.partitions_allocated += node_count;
    counts.segment_bytes += end_bytes;
    counts.partition_bytes += node_bytes + bit_bytes + candidate_bytes;
    ++counts.tiles;
    return true;
}

void Pipeline::for_each_tile(const PreparedFrame& prepared, bool pictured, const Progress& progress, PipelineCounts& counts,
                             const std::function<void(const Tile&)>& finish) {
    lights_.reserve(prepared.lights.size() * sizeof(kernel::LightRecord));
    if (!prepared.lights.empty()) lights_.upload(prepared.lights);

    // A quarter of the budget goes to what every ray needs, the rest to segments and partitions.
    if (pictured) rays_ = Buffer(device_, rays_.name());
    if (!pictured) pixels_ = Buffer(device_, pixels_.name());
    const std::uint64_t held = counts_.size() + results_.size() + pixels_.size() + rays_.size() + ends_.size() +
                               partitions_.size() + bits_.size() + candidates_.size();
    const std::uint64_t fitting = std::min((device_.available() + held) / (4 * ray_bytes), device_.max_buffer() / ray_bytes);
    std::uint64_t size = std::max<std::uint64_t>(1, std::min({fitting, most_rays, prepared.rays}));

    std::uint64_t first = 0;
    while (first < prepared.rays) {
        Tile tile;
        tile.first_ray = static_cast<std::uint32_t>(first);
        tile.rays = static_cast<std::uint32_t>(std::min(size, prepared.rays - first));
        if (!run_tile(prepared, tile, pictured, counts)) {
            if (tile.rays == 1)
                throw Error(Status::out_of_memory,
                            "the segments of one ray do not fit the device's memory (" +
                                std::to_string(device_.budget() >> 20) + " MiB): raise --max-memory, or use --reference");
            size = tile.rays / 2;
            continue;
        }
        finish(tile);
        first += tile.rays;
        if (progress && !progress(static_cast<double>(first) / static_cast<double>(prepared.rays)))
            throw Error(Status::interrupted, "interrupted");
    }
}

std::vector<kernel::Pixel> Pipeline::render(const PreparedFrame& prepared, const Progress& progress, PipelineCounts& counts) {
    const std::uint32_t width = prepared.frame.width, height = prepared.frame.height;
    std::vector<kernel::Pixel> pixels(std::size_t{width} * height);
    std::vector<kernel::Pixel> blocks;
    for_each_tile(prepared, true, progress, counts, [&](const Tile& tile) {
        blocks.resize(tile.rays);
        pixels_.read(blocks.data(), tile.rays * sizeof(kernel::Pixel));
        for (std::uint32_t i = 0; i < tile.rays; ++i) {
            const kernel::pixel_position at = kernel::pixel_of(tile.first_ray + i, width, height);
            if (!at.inside) continue;
            pixels[std::size_t{at.y} * width + at.x] = blocks[i];
            counts.partitions_used += blocks[i].partitions;
            counts.overlaps += blocks[i].overlap;
        }
    });
    return pixels;
}

// All regions that claim a partition, ascending: found again on the host, only for the few that overlap.
std::vector<std::uint32_t> Pipeline::claimants(const kernel::End* ends, std::uint32_t segments, const std::uint32_t* bits) const {
    const kernel::cover cover{ends, bits, segments};
    std::vector<std::uint32_t> table;
    for (std::uint32_t s = 0; s < segments; ++s) {
        if (!kernel::covers(cover, s)) continue;
        const kernel::SolidRecord& solid = scene_.solids[ends[2 * s].solid];
        for (std::uint32_t i = 0; i < solid.region_count; ++i) table.push_back(scene_.region_lists[solid.first_region + i]);
    }
    std::sort(table.begin(), table.end());
    table.erase(std::unique(table.begin(), table.end()), table.end());
    std::erase_if(table, [&](std::uint32_t region) {
        const kernel::RegionRecord& record = scene_.regions[region];
        return !(record.flags & REGION_UNION_ONLY) && !kernel::evaluate_tree(scene_.trees.data(), record.first_word, cover);
    });
    return table;
}

std::vector<ClaimedPartition> Pipeline::claims_of(const std::vector<kernel::End>& ends,
                                                  const std::vector<kernel::PartitionNode>& nodes,
                                                  const std::vector<std::uint32_t>& bits, const kernel::RayCount& begin,
                                                  const kernel::RayCount& end, std::uint32_t first_node) const {
    std::vector<ClaimedPartition> claims;
    const std::uint32_t segments = end.segments - begin.segments;
    const std::size_t base = 2 * std::size_t{begin.segments};
    for (std::uint32_t node = first_node; node != NONE; node = nodes[base + node].next) {
        const kernel::PartitionNode& partition = nodes[base + node];
        const std::uint32_t region = partition.region & ~OVERLAP;
        if (region == NONE) continue;
        ClaimedPartition claim;
        claim.in = ends[base + partition.in_end];
        claim.out = ends[base + partition.out_end];
        claim.in_leaves = partition.in_end % 2 == 1;
        claim.out_enters = partition.out_end % 2 == 0;
        claim.region = region;
        if (partition.region & OVERLAP)
            claim.claimants = claimants(ends.data() + base, segments, bits.data() + begin.words + node * kernel::words_of(segments));
        claims.push_back(std::move(claim));
    }
    return claims;
}

std::vector<RayPartitions> Pipeline::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays,
                                           const Progress& progress, PipelineCounts& counts) {
    list_.clear();
    list_.reserve(rays.size());
    for (const Ray& r : rays)
        list_.push_back({r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z});

    std::vector<RayPartitions> answers(rays.size());
    for_each_tile(prepared, false, progress, counts, [&](const Tile& tile) {
        const auto offsets = counts_.read<kernel::RayCount>(std::size_t{tile.rays} + 1);
        const auto results = results_.read<kernel::RayResult>(tile.rays);
        const auto ends = ends_.read<kernel::End>(2 * std::size_t{tile.total.segments});
        const auto nodes = partitions_.read<kernel::PartitionNode>(2 * std::size_t{tile.total.segments});
        const auto bits = bits_.read<std::uint32_t>(tile.total.words);
        for (std::uint32_t i = 0; i < tile.rays; ++i) {
            counts.partitions_used += results[i].partitions;
            counts.overlaps += results[i].overlaps;
            // The first claimed partition is where the list is worth reading from.
            const auto claims = claims_of(ends, nodes, bits, offsets[i], offsets[i + 1], results[i].first);
            answers[tile.first_ray + i] = to_partitions(scene_, rays[tile.first_ray + i], claims);
        }
    });
    return answers;
}

}  // namespace csgrt
