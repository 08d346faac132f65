// Kernel 3 against the reference's weaving, on ends that a scene would have to be searched for: ties, chains of near
// ties, segments shorter than the tolerance, infinite ends, up to hundreds of segments on a ray.
#include <cmath>
#include <limits>
#include <random>

#include "catch.hpp"
#include "kernels/host_kernels.hpp"
#include "reference/weave.hpp"

using namespace csgrt;

namespace {

struct Woven {
    std::vector<kernel::End> ends;
    std::vector<WovenPartition> partitions;
};

Woven weave_by_kernel(std::vector<kernel::End> ends, double tolerance) {
    const auto segments = static_cast<std::uint32_t>(ends.size() / 2);
    const std::uint32_t words = kernel::words_of(segments);
    kernel::Frame frame{};
    frame.ray_count = 1;
    frame.work = WORK_RAYS;
    const kernel::RayRecord ray{0, 0, 0, 0, 0, 1};
    frame.tolerance = tolerance;
    frame.segment_capacity = frame.word_capacity = COUNT_MAX;
    const std::vector<kernel::RayCount> offsets = {{0, 0}, {segments, kernel::partitions_of(segments) * words}};
    std::vector<kernel::PartitionNode> nodes(ends.size());
    std::vector<std::uint32_t> bits(offsets[1].words, 0xdeadbeefu);  // memory comes as it was left
    kernel::RayTally tally{};
    const std::vector<std::uint32_t> rays(ends.size());
    for (kernel::global_id = 0; kernel::global_id < ends.size(); ++kernel::global_id)
        kernel::order_ends(&frame, offsets.data(), ends.data(), rays.data(), nodes.data());
    kernel::global_id = 0;
    kernel::weave(&frame, &ray, nullptr, offsets.data(), ends.data(), nodes.data(), bits.data(), &tally);
    Woven woven;
    for (std::uint32_t n = kernel::first_partition(nodes.data(), segments); n != NONE; n = nodes[n].next) {
        WovenPartition p;
        p.in_end = nodes[n].in_end;
        p.out_end = nodes[n].out_end;
        p.in = ends[p.in_end].t;
        p.out = ends[p.out_end].t;
        for (std::uint32_t s = 0; s < segments; ++s)
            if (bits[n * words + s / 32] >> (s % 32) & 1u) p.segments.push_back(s);
        woven.partitions.push_back(p);
    }
    REQUIRE(woven.partitions.size() == tally.partitions);
    woven.ends = std::move(ends);
    return woven;
}

std::vector<WovenPartition> weave_by_reference(const std::vector<kernel::End>& ends, double tolerance) {
    static Weaver weaver;  // as the ray before left it
    const std::span<const WovenPartition> partitions = weave(ends, tolerance, weaver);
    return {partitions.begin(), partitions.end()};
}

void require_equal(const std::vector<kernel::End>& ends, double tolerance) {
    const Woven a = weave_by_kernel(ends, tolerance);
    const std::vector<WovenPartition> b = weave_by_reference(ends, tolerance);
    REQUIRE(a.partitions.size() == b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
        REQUIRE(a.partitions[i].in == b[i].in);
        REQUIRE(a.partitions[i].out == b[i].out);
        REQUIRE(a.partitions[i].in_end == b[i].in_end);
        REQUIRE(a.partitions[i].out_end == b[i].out_end);
        REQUIRE(a.partitions[i].segments == b[i].segments);
    }
}

}  // namespace

TEST_CASE("the thesis's example: three segments make five partitions", "[weave]") {
    const std::vector<kernel::End> ends = {{1, 0, 0}, {5, 0, 0}, {2, 1, 0}, {7, 1, 0}, {3, 2, 0}, {4, 2, 0}};
    const std::vector<WovenPartition> p = weave_by_reference(ends, 0);
    REQUIRE(p.size() == 5);
    CHECK(p[0].segments == std::vector<std::uint32_t>{0});
    CHECK(p[1].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(p[2].segments == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(p[3].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(p[4].segments == std::vector<std::uint32_t>{1});
    CHECK(p[4].in == 5);
    CHECK(p[4].out == 7);
    require_equal(ends, 0);
}

TEST_CASE("ends within the tolerance change at once and leave no sliver", "[weave]") {
    // B begins 1e-4 behind A and ends 1e-4 before it: one partition, no skins.
    const std::vector<kernel::End> ends = {{1, 0, 0}, {5, 0, 0}, {1.0001, 1, 0}, {4.9999, 1, 0}};
    const std::vector<WovenPartition> p = weave_by_reference(ends, 0.0005);
    REQUIRE(p.size() == 1);
    CHECK(p[0].segments == std::vector<std::uint32_t>{0, 1});
    CHECK(weave_by_reference(ends, 0).size() == 3);
    require_equal(ends, 0.0005);
    require_equal(ends, 0);
}

TEST_CASE("a segment shorter than the tolerance vanishes", "[weave]") {
    const std::vector<kernel::End> ends = {{1, 0, 0}, {1.0001, 0, 0}};
    CHECK(weave_by_reference(ends, 0.0005).empty());
    CHECK(weave_by_reference(ends, 0).size() == 1);
    require_equal(ends, 0.0005);
}

TEST_CASE("kernel 3 weaves as the reference does", "[weave]") {
    std::mt19937 random(20171);
    const double infinity = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 4000; ++round) {
        const int segments = round < 3900 ? static_cast<int>(random() % 12) + 1 : static_cast<int>(random() % 300) + 1;
        const int grid = static_cast<int>(random() % 40) + 2;  // few places: many ties
        const double jitter = random() % 3 == 0 ? 0.0 : 3e-4;
        std::uniform_real_distribution<double> unit(0, 1);
        std::vector<kernel::End> ends;
        for (int s = 0; s < segments; ++s) {
            const auto some = [&] {
                const auto place = static_cast<double>(random() % static_cast<unsigned>(grid));
                return place + jitter * unit(random);
            };
            double in = some();
            double out = in + some() + 1e-9;
            if (random() % 40 == 0) in = -infinity;
            if (random() % 40 == 0) out = infinity;
            ends.push_back({in, static_cast<std::uint32_t>(s), 0});
            ends.push_back({out, static_cast<std::uint32_t>(s), 0});
        }
        INFO("round " << round);
        require_equal(ends, random() % 2 ? 0.0005 : 0.0);
    }
}
