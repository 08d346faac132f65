// Meshes with a hole: where a ray meets an odd number of triangles, the way they are said to face decides.
#include <csgrt/csgrt.hpp>

#include "catch.hpp"

using namespace csgrt;

namespace {

/// Two cubes along x, from 0 to 1 and from 2 to 3; the first lacks its face at 0. Seen from outside, counterclockwise.
Bot two_cubes(Bot::Orientation orientation, bool turned) {
    Bot bot{.orientation = orientation};
    for (const double x : {0.0, 2.0}) {
        const auto first = static_cast<std::uint32_t>(bot.vertices.size());
        for (int i = 0; i < 8; ++i) bot.vertices.push_back({x + (i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
        const std::array<std::array<std::uint32_t, 4>, 6> sides = {
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
        for (std::size_t s = x == 0 ? 1 : 0; s < 6; ++s) {
            const auto& q = sides[s];
            for (std::array<std::uint32_t, 3> face : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
                for (std::uint32_t& corner : face) corner += first;
                if (turned) std::swap(face[1], face[2]);
                bot.faces.push_back(face);
            }
        }
    }
    return bot;
}

RayPartitions shoot(const Bot& bot, const Ray& ray) {
    Scene scene{.objects = {Solid{"s", bot, {}}}};
    Settings settings{.reference = true};
    return Renderer(scene, {}, settings).shoot({ray})[0];
}

}  // namespace

TEST_CASE("a mesh with a hole: the sides that face each other bound the inside, from either end",
          "[geometry][promise:solids]") {
    using enum Bot::Orientation;
    for (const bool turned : {false, true}) {
        const Bot bot = two_cubes(turned ? clockwise : counterclockwise, turned);
        const RayPartitions there = shoot(bot, {{-1, 0.5, 0.25}, {1, 0, 0}}),
                            back = shoot(bot, {{4, 0.5, 0.25}, {-1, 0, 0}});
        REQUIRE(there.partitions.size() == 1);
        CHECK(there.partitions[0].in == 3);
        CHECK(there.partitions[0].out == 4);
        CHECK(there.partitions[0].in_normal == Vec3{-1, 0, 0});
        CHECK(there.partitions[0].out_normal == Vec3{1, 0, 0});
        REQUIRE(back.partitions.size() == 1);
        CHECK(back.partitions[0].in == 1);
        CHECK(back.partitions[0].out == 2);
    }
    // Where nothing is said, the first two are taken for the bounds.
    const RayPartitions unknown = shoot(two_cubes(unoriented, false), {{-1, 0.5, 0.25}, {1, 0, 0}});
    REQUIRE(unknown.partitions.size() == 1);
    CHECK(unknown.partitions[0].in == 2);
    CHECK(unknown.partitions[0].out == 3);
    // A closed part is met an even number of times: parity.
    const RayPartitions closed = shoot(two_cubes(counterclockwise, false), {{2.5, -1, 0.25}, {0, 1, 0}});
    REQUIRE(closed.partitions.size() == 1);
    CHECK(closed.partitions[0].in == 1);
}
