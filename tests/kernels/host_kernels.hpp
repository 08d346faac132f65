// The five kernels compiled as C++ and run on the host, a work-item after the other, in buffers of the exact size: what
// a sanitizer sees here, a device would do silently.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/frame.hpp"
#include "compile/regions/status_tree.hpp"
#include "kernel_host/geometry.hpp"
#include "pipeline/readback/picture.hpp"

namespace csgrt::kernel {

inline thread_local std::size_t global_id = 0;
inline std::size_t get_global_id(int) { return global_id; }
inline std::size_t get_global_size(int) { return 1; }
using std::size_t;

#define __kernel [[maybe_unused]] static inline
#define __global
#define CSGRT_LARGE_TERMS
// NOLINTBEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wzero-as-null-pointer-constant"
#include "../kernels/traversal/candidates.h"
#include "../kernels/0_cull_tiles.cl"
#include "../kernels/1_count_segments.cl"
#include "../kernels/2_store_segments.cl"
#include "../kernels/2_rays_in_faces.cl"
#include "../kernels/3_weave.cl"
#include "../kernels/4_evaluate.cl"
#include "../kernels/3_deep_rays.cl"
#include "../kernels/5_shade.cl"
#define CSGRT_SOLIDS 0xffffffffu
inline u32 atomic_inc(u32* place) { return (*place)++; }
#include "../kernels/shading/first_hits_ray.h"
#include "../kernels/first_hits.cl"
#undef CSGRT_SOLIDS
#pragma GCC diagnostic pop
// NOLINTEND
#undef __kernel
#undef __global
#undef CSGRT_LARGE_TERMS

}  // namespace csgrt::kernel

namespace csgrt::test {

/// Everything that the kernels leave behind for one frame, or for a list of rays.
struct HostRun {
    std::size_t candidates = 0;
    std::vector<kernel::RayCount> offsets;
    std::vector<kernel::Boundary> boundaries;
    std::vector<kernel::PartitionNode> nodes;
    std::vector<std::uint32_t> bits;
    std::vector<kernel::RayTally> tallies;
    std::vector<float> picture;  ///< the frame's channels, plane by plane
};

/// The numbers of all of a picture's rays.
inline std::vector<std::uint32_t> all_numbers(const kernel::Frame& frame) {
    std::vector<std::uint32_t> numbers(frame.work == WORK_RAYS ? 0 : frame.ray_count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

/// The planes of the first channels, background where no ray was.
inline std::vector<float> picture_of(const kernel::Frame& frame, const std::vector<std::uint32_t>& numbers,
                                     const std::vector<float>& values, std::size_t channels) {
    const std::size_t size = std::size_t{frame.width} * frame.height;
    std::vector<float> picture(channels * size);
    std::vector<ChannelMemory> planes;
    for (std::size_t i = 0; i < channels; ++i) {
        planes.push_back({picture.data() + i * size, 0});
        if (i < 4) planes.back().background = frame.background[i];
        if (i == 4) planes.back().background = std::numeric_limits<float>::infinity();
        std::fill_n(planes.back().pixels, size, planes.back().background);
    }
    const std::size_t across = (frame.width + TILE - 1) / TILE, down = (frame.height + TILE - 1) / TILE;
    std::vector<std::uint8_t> drawn(across * down);
    put_rays(frame, numbers, values.data(), {planes, drawn});
    return picture;
}

/// What kernel 0 leaves behind.
struct HostTiles {
    std::vector<unsigned char> costs;
    std::vector<kernel::TileNode> lists;
};
inline HostTiles cull(const CompiledScene& scene, const kernel::Frame& frame) {
    using namespace kernel;
    HostTiles tiles;
    tiles.costs.resize(frame.ray_count / (TILE * TILE));
    tiles.lists.resize(tiles.costs.size() * LISTED_NODES);
    for (global_id = 0; global_id < tiles.costs.size(); ++global_id)
        cull_tiles(&frame, scene.nodes.data(), scene.starting.data(), nullptr, tiles.costs.data(), tiles.lists.data(),
                   nullptr);
    return tiles;
}

/// Sorts and sweeps the rays that are listed as src/pipeline/passes/deep_rays.cpp has it done, one at a time, whether
/// they are deep or not. `limit`: ends that a launch passes.
inline void sweep_rays(const CompiledScene& scene, const kernel::Frame& frame, const kernel::RayRecord* rays,
                       const std::uint32_t* listed, const std::vector<std::uint32_t>& deep,
                       const std::vector<kernel::RayCount>& offsets, std::vector<kernel::Boundary>& boundaries,
                       std::vector<kernel::PartitionNode>& nodes, std::vector<kernel::RayTally>& tallies,
                       std::uint32_t limit) {
    using namespace kernel;
    const csgrt::StatusTree tree = make_status_tree(scene);
    const auto regions = static_cast<u32>(scene.regions.size()), cluster_words = static_cast<u32>(tree.outside.size()),
               words = cluster_words + words_of_set(regions);
    std::vector<u32> status(SIDES * std::size_t{words}, 0xdeadbeefu);
    for (global_id = 0; global_id < status.size(); ++global_id)
        clear_status(tree.outside.data(), cluster_words, words, static_cast<u32>(status.size()), status.data());
    const std::vector<u32> clear = status;
    for (const u32 ray : deep) {
        const u32 segments = offsets[ray + 1].segments - offsets[ray].segments,
                  blocks = (2 * segments + DEEP_BLOCK - 1) / DEEP_BLOCK;
        DeepRay one{};
        one.ray = ray;
        one.open = one.last = NONE;
        u32 field = FIELD_NEXT;
        for (u32 run = DEEP_BLOCK; run < 2 * segments; run *= 2) field ^= FIELD_NEXT ^ FIELD_IN_END;
        for (global_id = 0; global_id <= blocks; ++global_id)
            sort_deep_blocks(&one, 1, blocks, offsets.data(), boundaries.data(), nodes.data(), field);
        for (u32 run = DEEP_BLOCK; run < 2 * segments; run *= 2) {
            for (global_id = 0; global_id <= blocks; ++global_id)
                merge_deep_runs(&one, 1, blocks, offsets.data(), boundaries.data(), nodes.data(), field, run);
            field ^= FIELD_NEXT ^ FIELD_IN_END;
        }
        std::vector<DeepSegment> of_segments(segments);
        for (u32 passed = 0; passed < 2 * segments; passed += limit)
            for (global_id = 0; global_id < 2; ++global_id)
                sweep_deep_rays(&frame, rays, listed, &one, 0, 0, 1, offsets.data(), boundaries.data(), nodes.data(),
                                of_segments.data(), status.data(), cluster_words, regions, tree.links.data(),
                                tree.first_leaves.data(), tree.leaves.data(), limit, tallies.data());
        if (status != clear) throw std::logic_error("a ray left its status behind");
    }
}

/// Runs all kernels; `rays` empty: the frame's camera.
inline HostRun run_kernels(const CompiledScene& scene, const PreparedFrame& prepared,
                           const std::vector<kernel::RayRecord>& rays = {}) {
    using namespace kernel;
    Frame frame = prepared.frame;
    frame.first_ray = 0;
    frame.ray_count = static_cast<u32>(prepared.rays);
    if (rays.empty()) frame.work = WORK_PIXELS;
    const std::vector<u32> numbers = all_numbers(frame);
    const u32* const listed = numbers.data();
    const std::size_t count = frame.ray_count;
    HostRun run;
    const auto each_of = [](std::size_t items, const auto& work) {
        for (global_id = 0; global_id < items; ++global_id) work();
    };
    const auto each = [&](const auto& work) { each_of(count, work); };
    const auto scan = [](std::vector<RayCount>& counts) {
        RayCount sum{};
        for (RayCount& c : counts) {
            const RayCount own = c;
            c = sum;
            sum.segments += own.segments;
            sum.words += own.words;
        }
        return sum;
    };
    const HostTiles tiles = !rays.empty() ? HostTiles{} : cull(scene, frame);
    const TileNode* lists = !rays.empty() ? nullptr : tiles.lists.data();
    std::vector<CandidateCount> places(count + 1);
    each([&] { find_candidates(&frame, scene.nodes.data(), lists, rays.data(), listed, places.data(), nullptr); });
    u32 candidate_count = 0;
    for (CandidateCount& c : places) c.candidates = std::exchange(candidate_count, candidate_count + c.candidates);
    std::vector<Candidate> candidates(candidate_count);
    each([&] {
        find_candidates(&frame, scene.nodes.data(), lists, rays.data(), listed, places.data(), candidates.data());
    });
    std::vector<Boundary> found(2 * candidates.size());
    each_of(candidates.size(), [&] {
        count_segments(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data(), found.data());
    });
    each_of(candidates.size(), [&] {
        count_in_faces(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data());
    });
    run.candidates = candidates.size();
    run.offsets.resize(count + 1);
    each([&] { sum_segments(&frame, places.data(), candidates.data(), 0, run.offsets.data(), nullptr); });
    const RayCount sum = scan(run.offsets);
    run.boundaries.resize(2 * std::size_t{sum.segments});
    run.nodes.resize(run.boundaries.size());
    run.bits.resize(std::max<std::size_t>(sum.words, run.boundaries.size()));
    run.tallies.resize(count);
    std::vector<float> values(13 * count);
    each_of(candidates.size(), [&] {
        store_segments(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data(), found.data(),
                       run.offsets.data(), run.boundaries.data(), run.bits.data());
    });
    each_of(candidates.size(), [&] {
        store_in_faces(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data(),
                       run.offsets.data(), run.boundaries.data(), run.bits.data());
    });
    each_of(run.boundaries.size(), [&] {
        order_boundaries(&frame, run.offsets.data(), run.boundaries.data(), run.bits.data(), run.nodes.data());
    });
    each([&] {
        kernel::weave(&frame, rays.data(), listed, run.offsets.data(), run.boundaries.data(), run.nodes.data(),
                      run.bits.data(), run.tallies.data());
    });
    each_of(run.boundaries.size(), [&] {
        evaluate(&frame, scene.solids.data(), scene.starts.data(), scene.trees.data(), rays.data(), listed,
                 run.offsets.data(), run.boundaries.data(), run.bits.data(), run.nodes.data());
    });
    std::vector<u32> deep;
    for (u32 ray = 0; ray < count; ++ray)
        if (run.offsets[ray + 1].segments - run.offsets[ray].segments > DEEP_SEGMENTS) deep.push_back(ray);
    if (!deep.empty())
        sweep_rays(scene, frame, rays.data(), listed, deep, run.offsets, run.boundaries, run.nodes, run.tallies, 1000);
    if (rays.empty()) {
        const std::vector<MaterialRecord> materials = scene.materials;
        each([&] {
            shade(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                  scene.inner_nodes.data(), materials.data(), prepared.lights.data(), scene.display.data(), listed,
                  run.offsets.data(), run.boundaries.data(), run.nodes.data(), run.tallies.data(), nullptr,
                  values.data());
        });
        run.picture = picture_of(frame, numbers, values, 13);
    }
    return run;
}

/// The first hits by their own kernels. Returns how many rays had no room.
inline std::uint32_t run_first_hits(const CompiledScene& scene, const PreparedFrame& prepared,
                                    std::vector<float>& picture) {
    using namespace kernel;
    Frame frame = prepared.frame;
    frame.first_ray = 0;
    frame.ray_count = static_cast<u32>(prepared.rays);
    frame.work = WORK_PIXELS;
    std::vector<u32> numbers = all_numbers(frame);
    const HostTiles tiles = cull(scene, frame);
    std::vector<u32> overflown(frame.ray_count);
    BatchReport report{};
    std::erase_if(numbers, [&](u32 number) { return !tiles.costs[number / (TILE * TILE)]; });
    frame.ray_count = static_cast<u32>(numbers.size());
    std::vector<float> values(10 * numbers.size());
    const std::vector<MaterialRecord> materials = scene.materials;
    for (global_id = 0; global_id < frame.ray_count; ++global_id)
        first_hits(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                   scene.inner_nodes.data(), scene.nodes.data(), scene.starts.data(), scene.trees.data(),
                   materials.data(), prepared.lights.data(), scene.display.data(), tiles.lists.data(), numbers.data(),
                   &report, overflown.data(), values.data());
    picture = picture_of(frame, numbers, values, 10);
    return report.overflows;
}

}  // namespace csgrt::test
