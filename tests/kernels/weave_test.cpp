// Kernel 3, and the sweep of deep rays, against the reference's weaving, on ends that a scene would have to be searched
// for: ties, chains of near ties, segments shorter than the tolerance, infinite ends, up to hundreds of segments on a
// ray.
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "catch.hpp"
#include "kernels/host_kernels.hpp"
#include "reference/weave.hpp"

using namespace csgrt;

namespace {

struct Woven {
    std::vector<kernel::Boundary> boundaries;
    std::vector<WovenPartition> partitions;
};

/// Of one ray along z.
struct Along {
    explicit Along(std::uint32_t segments, double tolerance) : offsets{{0, 0}, {segments, 0}} {
        frame.ray_count = 1;
        frame.work = WORK_RAYS;
        frame.tolerance = tolerance;
        frame.segment_capacity = frame.word_capacity = COUNT_MAX;
    }
    kernel::Frame frame{};
    kernel::RayRecord ray{0, 0, 0, 0, 0, 1, 0, 1};
    std::vector<kernel::RayCount> offsets;
};

/// Each solid a region of its own, the first half of one rank, the others of the next.
CompiledScene solids_alone(std::uint32_t count) {
    CompiledScene scene;
    scene.solids.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        scene.trees.push_back(OP_LEAF << TREE_SHIFT | i);
        scene.regions.push_back({i, 1});
    }
    for (std::uint32_t rank = 0; rank < RANKS; ++rank) scene.rank_ends[rank] = rank == 0 ? count / 2 : count;
    return scene;
}

/// Who claims a partition in such a scene, as PartitionNode.owner.
std::uint32_t owner_among(const std::vector<kernel::Boundary>& boundaries, const std::vector<std::uint32_t>& segments,
                          std::uint32_t half) {
    std::set<std::uint32_t> sides[4], all;
    for (const std::uint32_t segment : segments) all.insert(boundaries[2 * segment].solid);
    if (all.size() == 1) return *all.begin();
    for (const std::uint32_t segment : segments) {
        const std::uint32_t marks = boundaries[2 * segment].surface & MISSED, solid = boundaries[2 * segment].solid;
        const std::uint32_t bits[] = {MISSED_ABOVE, MISSED_BELOW, MISSED_LEFT, MISSED_RIGHT};
        for (int side = 0; side < 4; ++side)
            if (!(marks & bits[side])) sides[side].insert(solid);
    }
    std::uint32_t least = NONE;
    bool overlaps = false;
    for (const auto& regions : sides) {
        if (regions.empty() || *regions.begin() > least) continue;
        const bool two = regions.size() > 1 && (*regions.begin() < half) == (*std::next(regions.begin()) < half);
        overlaps = two || (overlaps && *regions.begin() == least);
        least = *regions.begin();
    }
    return least | (overlaps ? OVERLAP : 0u);
}

/// The list that weaving left, from front to back. `covers(node, segment, partition)`: is it one of its segments?
template <class Covers>
std::vector<WovenPartition> listed(const std::vector<kernel::PartitionNode>& nodes,
                                   const std::vector<kernel::Boundary>& boundaries, const Covers& covers) {
    const auto segments = static_cast<std::uint32_t>(boundaries.size() / 2);
    std::vector<WovenPartition> partitions;
    for (std::uint32_t n = kernel::first_partition(nodes.data(), segments); n != NONE; n = nodes[n].next) {
        WovenPartition p;
        p.in_boundary = nodes[n].in_boundary;
        p.out_boundary = nodes[n].out_boundary;
        p.in = boundaries[p.in_boundary].t;
        p.out = boundaries[p.out_boundary].t;
        for (std::uint32_t s = 0; s < segments; ++s)
            if (covers(n, s, p)) p.segments.push_back(s);
        partitions.push_back(p);
    }
    return partitions;
}

/// The partitions of the sweep, and whether their owners are those that they ought to have.
Woven weave_by_sweep(std::vector<kernel::Boundary> boundaries, double tolerance, std::uint32_t limit) {
    const auto segments = static_cast<std::uint32_t>(boundaries.size() / 2);
    Along along(segments, tolerance);
    const std::uint32_t solids = boundaries[boundaries.size() - 1].solid + 1;
    std::vector<kernel::PartitionNode> nodes(boundaries.size(), {1, 2, 3, 4});
    std::vector<kernel::RayTally> tallies(1);
    along.frame.rank_ends[0] = solids / 2;
    for (std::uint32_t rank = 1; rank < RANKS; ++rank) along.frame.rank_ends[rank] = solids;
    test::sweep_rays(solids_alone(solids), along.frame, &along.ray, nullptr, {0}, along.offsets, boundaries, nodes,
                     tallies, limit);
    Woven woven;
    woven.partitions = listed(nodes, boundaries, [&](std::uint32_t, std::uint32_t segment, const WovenPartition& p) {
        return boundaries[2 * segment].t <= p.in && p.in < boundaries[2 * segment + 1].t;
    });
    std::uint32_t n = kernel::first_partition(nodes.data(), segments);
    for (const WovenPartition& p : woven.partitions) {
        REQUIRE(nodes[n].owner == owner_among(boundaries, p.segments, solids / 2));
        n = nodes[n].next;
    }
    REQUIRE(woven.partitions.size() == tallies[0].partitions);
    woven.boundaries = std::move(boundaries);
    return woven;
}

Woven weave_by_kernel(std::vector<kernel::Boundary> boundaries, double tolerance) {
    const auto segments = static_cast<std::uint32_t>(boundaries.size() / 2);
    const std::uint32_t words = kernel::words_of(segments);
    Along along(segments, tolerance);
    std::vector<kernel::RayCount>& offsets = along.offsets;
    offsets[1].words = kernel::partitions_of(segments) * words;
    std::vector<kernel::PartitionNode> nodes(boundaries.size());
    std::vector<std::uint32_t> bits(offsets[1].words, 0xdeadbeefu);  // memory comes as it was left
    kernel::RayTally tally{};
    const std::vector<std::uint32_t> rays(boundaries.size());
    for (kernel::global_id = 0; kernel::global_id < boundaries.size(); ++kernel::global_id)
        kernel::order_boundaries(&along.frame, offsets.data(), boundaries.data(), rays.data(), nodes.data());
    kernel::global_id = 0;
    kernel::weave(&along.frame, &along.ray, nullptr, offsets.data(), boundaries.data(), nodes.data(), bits.data(),
                  &tally);
    Woven woven;
    woven.partitions = listed(nodes, boundaries, [&](std::uint32_t node, std::uint32_t segment, const WovenPartition&) {
        return bits[node * words + segment / 32] >> (segment % 32) & 1u;
    });
    REQUIRE(woven.partitions.size() == tally.partitions);
    woven.boundaries = std::move(boundaries);
    return woven;
}

std::vector<WovenPartition> weave_by_reference(const std::vector<kernel::Boundary>& boundaries, double tolerance) {
    static Weaver weaver;  // as the ray before left it
    const std::span<const WovenPartition> partitions = weave(boundaries, tolerance, weaver);
    return {partitions.begin(), partitions.end()};
}

void require_equal(const std::vector<WovenPartition>& a, const std::vector<WovenPartition>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
        REQUIRE(a[i].in == b[i].in);
        REQUIRE(a[i].out == b[i].out);
        REQUIRE(a[i].in_boundary == b[i].in_boundary);
        REQUIRE(a[i].out_boundary == b[i].out_boundary);
        REQUIRE(a[i].segments == b[i].segments);
    }
}

void require_equal(const std::vector<kernel::Boundary>& boundaries, double tolerance) {
    const std::vector<WovenPartition> expected = weave_by_reference(boundaries, tolerance);
    if (boundaries.size() <= 2 * DEEP_SEGMENTS)
        require_equal(weave_by_kernel(boundaries, tolerance).partitions, expected);
    for (const std::uint32_t limit : {1u, 7u, 1000u})
        require_equal(weave_by_sweep(boundaries, tolerance, limit).partitions, expected);
}

}  // namespace

TEST_CASE("the thesis's example: three segments make five partitions", "[weave]") {
    const std::vector<kernel::Boundary> boundaries = {{1, 0, 0}, {5, 0, 0}, {2, 1, 0}, {7, 1, 0}, {3, 2, 0}, {4, 2, 0}};
    const std::vector<WovenPartition> p = weave_by_reference(boundaries, 0);
    REQUIRE(p.size() == 5);
    CHECK(p[0].segments == std::vector<std::uint32_t>{0});
    CHECK(p[1].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(p[2].segments == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(p[3].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(p[4].segments == std::vector<std::uint32_t>{1});
    CHECK(p[4].in == 5);
    CHECK(p[4].out == 7);
    require_equal(boundaries, 0);
}

TEST_CASE("ends within the tolerance change at once and leave no sliver", "[weave][promise:coincidence]") {
    // B begins 1e-4 behind A and ends 1e-4 before it: one partition, no skins.
    const std::vector<kernel::Boundary> boundaries = {{1, 0, 0}, {5, 0, 0}, {1.0001, 1, 0}, {4.9999, 1, 0}};
    const std::vector<WovenPartition> p = weave_by_reference(boundaries, 0.0005);
    REQUIRE(p.size() == 1);
    CHECK(p[0].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(weave_by_reference(boundaries, 0).size() == 3);
    require_equal(boundaries, 0.0005);
    require_equal(boundaries, 0);
}

TEST_CASE("a segment shorter than the tolerance vanishes", "[weave]") {
    const std::vector<kernel::Boundary> boundaries = {{1, 0, 0}, {1.0001, 0, 0}};
    CHECK(weave_by_reference(boundaries, 0.0005).empty());
    CHECK(weave_by_reference(boundaries, 0).size() == 1);
    require_equal(boundaries, 0.0005);
}

TEST_CASE("kernel 3 weaves as the reference does, and so does the sweep of deep rays", "[weave]") {
    std::mt19937 random(20171);
    const double infinity = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 4000; ++round) {
        const int segments = round < 3900 ? static_cast<int>(random() % 12) + 1 : static_cast<int>(random() % 300) + 1;
        const int grid = static_cast<int>(random() % 40) + 2;  // few places: many ties
        const bool marked = random() % 2 == 0;
        const double jitter = random() % 3 == 0 ? 0.0 : 3e-4;
        std::uniform_real_distribution<double> unit(0, 1);
        std::vector<kernel::Boundary> boundaries;
        for (int s = 0; s < segments; ++s) {
            const auto some = [&] {
                const auto place = static_cast<double>(random() % static_cast<unsigned>(grid));
                return place + jitter * unit(random);
            };
            double in = some();
            double out = in + some() + 1e-9;
            if (random() % 40 == 0) in = -infinity;
            if (random() % 40 == 0) out = infinity;
            const std::uint32_t surface = random() % 5 == 0 ? static_cast<std::uint32_t>(random()) & MISSED : 0u;
            boundaries.push_back({in, static_cast<std::uint32_t>(s), marked ? surface : 0u});
            boundaries.push_back({out, static_cast<std::uint32_t>(s), marked ? surface : 0u});
        }
        INFO("round " << round);
        require_equal(boundaries, random() % 2 ? 0.0005 : 0.0);
    }
}

TEST_CASE("a solid's segments that abut or overlap are one to the sweep of deep rays", "[weave]") {
    std::mt19937 engine(20172);
    const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
    for (int round = 0; round < 300; ++round) {
        std::vector<kernel::Boundary> boundaries;
        const std::uint32_t solids = random() % 20 + 1;
        for (std::uint32_t solid = 0; solid < solids; ++solid) {
            double in = static_cast<double>(random() % 20);
            for (std::uint32_t k = random() % 9; k < 9; ++k) {
                const double out = in + 1 + static_cast<double>(random() % 3);
                boundaries.push_back({in, solid, 0});
                boundaries.push_back({out, solid, 0});
                in = out + static_cast<double>(random() % 3) - (random() % 4 == 0 ? 0.5 : 0.0);
            }
        }
        INFO("round " << round);
        require_equal(boundaries, random() % 2 ? 0.0005 : 0.0);
    }
}
