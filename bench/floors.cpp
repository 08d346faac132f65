// The kernels are compiled for the host once more, with counters in the way of each box, solid and word.
#include "floors.hpp"

#include <cstdio>

#include "compile/compiled_scene.hpp"

namespace csgrt::kernel {
struct Counted {
    std::uint64_t boxes = 0, solids = 0, words = 0;
};
static Counted counted;
#include "kernels/shared/slab.h"
}  // namespace csgrt::kernel

#define box_is_hit(ray, node) (++counted.boxes, box_is_hit(ray, node))
#define box_is_hit_before(ray, node, end) (++counted.boxes, box_is_hit_before(ray, node, end))
#undef TREE_SHIFT  // every word of a tree is split by it when it is read
#define TREE_SHIFT (++counted.words, 29u)
#include "kernel_host/geometry.hpp"
#define collect(...) (++counted.solids, collect(__VA_ARGS__))
#include "tests/kernels/host_kernels.hpp"

namespace csgrt::bench {

double Floor::milliseconds(int size) const {
    const double seconds = boxes / 820e9 + solids / 394e9 + words * 10 / 30.5e12 + 2 * bytes / 4259e9;
    return 1000 * seconds * size * size;
}

Floor count_floor(const std::string& workload, const Scene& scene, const std::vector<std::string>& objects) {
    const CompiledScene compiled = compile(scene, objects);
    View view;
    view.width = view.height = 256;
    const PreparedFrame prepared = prepare_frame(compiled, view, -1);
    kernel::counted = {};
    const test::HostRun run = test::run_kernels(compiled, prepared);
    const double pixels = view.width * view.height;  // of which only those of the screen have rays
    const auto per_pixel = [&](auto count) { return static_cast<double>(count) / pixels; };
    const auto bytes_of = [](const auto& all) { return all.size() * sizeof all[0]; };
    std::uint64_t partitions = 0;
    for (const kernel::RayTally& tally : run.tallies) partitions += tally.partitions;
    Floor floor;
    floor.workload = workload;
    floor.boxes = per_pixel(kernel::counted.boxes) / 2;  // two walks, one to count, one to list
    floor.solids = per_pixel(run.candidates);
    floor.words = per_pixel(kernel::counted.words);
    floor.segments = per_pixel(run.boundaries.size()) / 2;
    floor.partitions = per_pixel(partitions);
    floor.bytes = per_pixel(bytes_of(run.offsets) + bytes_of(run.boundaries) + bytes_of(run.nodes) +
                            bytes_of(run.bits) + bytes_of(run.tallies) + bytes_of(run.picture));
    return floor;
}

void print_floors(const std::vector<Floor>& floors, const std::vector<double>& measured, int size) {
    std::printf("\nper pixel, every partition, and the least time of %d x %d on an H200 (floor), ms\n", size, size);
    std::printf("| %-16s | %7s | %7s | %8s | %8s | %10s | %7s | %8s | %8s |\n|---|---|---|---|---|---|---|---|---|\n",
                "scene", "boxes", "solids", "words", "segments", "partitions", "bytes", "floor", "measured");
    for (std::size_t i = 0; i < floors.size(); ++i) {
        const Floor& f = floors[i];
        std::printf("| %-16s | %7.1f | %7.2f | %8.1f | %8.2f | %10.2f | %7.1f | %8.4f |", f.workload.c_str(), f.boxes,
                    f.solids, f.words, f.segments, f.partitions, f.bytes, f.milliseconds(size));
        if (measured[i] >= 0) {
            std::printf(" %8.3f |\n", measured[i]);
        } else {
            std::printf(" %8s |\n", "-");
        }
    }
}

}  // namespace csgrt::bench
