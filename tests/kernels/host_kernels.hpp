// The five kernels compiled as C++ and run on the host, a work-item after the other, in buffers of the exact size: what
// a sanitizer sees here, a device would do silently.
#pragma once

#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/frame.hpp"
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
#include "../kernels/3_weave.cl"
#include "../kernels/4_evaluate.cl"
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
    std::vector<kernel::End> ends;
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
        if (i < 3) planes.back().background = frame.background[i];
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
        cull_tiles(&frame, scene.nodes.data(), tiles.costs.data(), tiles.lists.data(), nullptr);
    return tiles;
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
    std::vector<End> found(2 * candidates.size());
    each_of(candidates.size(), [&] {
        count_segments(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data(), found.data());
    });
    run.candidates = candidates.size();
    run.offsets.resize(count + 1);
    each([&] { sum_segments(&frame, places.data(), candidates.data(), run.offsets.data()); });
    const RayCount sum = scan(run.offsets);
    run.ends.resize(2 * std::size_t{sum.segments});
    run.nodes.resize(run.ends.size());
    run.bits.resize(sum.words);
    run.tallies.resize(count);
    std::vector<float> values(13 * count);
    each_of(candidates.size(), [&] {
        store_segments(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                       scene.inner_nodes.data(), rays.data(), listed, places.data(), candidates.data(), found.data(),
                       run.offsets.data(), run.ends.data(), run.bits.data());
    });
    each_of(run.ends.size(),
            [&] { order_ends(&frame, run.offsets.data(), run.ends.data(), run.bits.data(), run.nodes.data()); });
    each([&] {
        kernel::weave(&frame, rays.data(), listed, run.offsets.data(), run.ends.data(), run.nodes.data(),
                      run.bits.data(), run.tallies.data());
    });
    each_of(run.ends.size(), [&] {
        evaluate(&frame, scene.solids.data(), scene.starts.data(), scene.trees.data(), run.offsets.data(),
                 run.ends.data(), run.bits.data(), run.nodes.data());
    });
    if (rays.empty()) {
        each([&] {
            shade(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                  scene.inner_nodes.data(), scene.materials.data(), prepared.lights.data(), listed, run.offsets.data(),
                  run.ends.data(), run.nodes.data(), run.tallies.data(), nullptr, values.data());
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
    for (global_id = 0; global_id < frame.ray_count; ++global_id)
        first_hits(&frame, scene.solids.data(), scene.reals.data(), scene.planes.data(), scene.words.data(),
                   scene.inner_nodes.data(), scene.nodes.data(), scene.starts.data(), scene.trees.data(),
                   scene.materials.data(), prepared.lights.data(), tiles.lists.data(), numbers.data(), &report,
                   overflown.data(), values.data());
    picture = picture_of(frame, numbers, values, 10);
    return report.overflows;
}

}  // namespace csgrt::test
