// Frames and grids of rays.
#include "analysis/frame.hpp"

#include "catch.hpp"

using namespace csgrt;
using namespace csgrt::analysis;

TEST_CASE("frames are of perpendicular unit vectors, and uniform") {
    double sum[3][3] = {}, squares[3][3] = {};
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        Random random{1, static_cast<std::uint64_t>(i)};
        const std::array<Vec3, 3> frame = random_frame(random);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(length(frame[k]) - 1) < 1e-14);
            CHECK(std::abs(dot(frame[k], frame[(k + 1) % 3])) < 1e-14);
            const double parts[] = {frame[k].x, frame[k].y, frame[k].z};
            for (std::size_t j = 0; j < 3; ++j) {
                sum[k][j] += parts[j] / count;
                squares[k][j] += parts[j] * parts[j] / count;
            }
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(std::abs(sum[k][j]) < 5 / std::sqrt(3.0 * count));
            CHECK(std::abs(squares[k][j] - 1.0 / 3) < 0.011);  // five times its deviation
        }
    }
}

TEST_CASE("the grids of a box have about the rays that are wanted, and cover its corners") {
    const Box boxes[] = {{{-1, -1, -1}, {1, 1, 1}}, {{0, 0, 0}, {1e6, 1, 1}}, {{0, 0, 0}, {1e6, 1e6, 0}}};
    for (const Box& box : boxes) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            Random random{seed};
            for (const Grid& grid : grids_of(box, 1000, random)) {
                CHECK(grid.size() <= 70'000);
                std::uint64_t meet = 0;
                for (std::uint64_t i = 0; i < grid.size(); ++i) meet += grid.meets(grid.ray(i));
                CHECK(meet <= 1300);
                if (&box == boxes) CHECK(meet >= 700);
                CHECK(grid.cell > 0);
                const Vec3 u = 1 / length(grid.right) * grid.right, v = 1 / length(grid.up) * grid.up;
                const Ray last = grid.ray(grid.size() - 1);
                for (const double x : {box.low.x, box.high.x}) {
                    for (const double y : {box.low.y, box.high.y}) {
                        for (const double z : {box.low.z, box.high.z}) {
                            const Vec3 from = Vec3{x, y, z} - grid.corner, to = last.origin - Vec3{x, y, z};
                            const double rounding = 1e-9 * length(box.high - box.low);
                            CHECK(dot(from, u) >= -length(grid.right) - rounding);
                            CHECK(dot(to, u) >= -length(grid.right) - rounding);
                            CHECK(dot(from, v) >= -length(grid.up) - rounding);
                            CHECK(dot(to, v) >= -length(grid.up) - rounding);
                            CHECK(dot(from, grid.direction) > 0);
                            CHECK(dot(from, grid.direction) < grid.length);
                        }
                    }
                }
            }
        }
    }
}
