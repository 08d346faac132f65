// Faces with holes: the triangles cover them once, and have their edges.
#include "compile/solids/meshes/triangulate.hpp"

#include <cmath>
#include <map>
#include <random>

#include "catch.hpp"

using namespace csgrt;

namespace {

using Loop = std::vector<std::uint32_t>;
using Face = std::array<std::uint32_t, 3>;

struct Drawing {
    std::vector<Vec3> vertices;
    std::vector<Loop> loops;

    void loop(const std::vector<std::array<double, 2>>& points, bool backward = false) {
        Loop& loop = loops.emplace_back();
        for (const auto& [x, y] : points) {
            loop.push_back(static_cast<std::uint32_t>(vertices.size()));
            vertices.push_back({x, y, 0});
        }
        if (backward) std::reverse(loop.begin(), loop.end());
    }
    double twice_area(const Loop& loop) const {
        double sum = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &p = vertices[loop[i]], &q = vertices[loop[(i + 1) % loop.size()]];
            sum += p.x * q.y - p.y * q.x;
        }
        return sum;
    }
    /// What is left of the outline.
    double area() const {
        double sum = std::abs(twice_area(loops[0]));
        for (std::size_t i = 1; i < loops.size(); ++i) sum -= std::abs(twice_area(loops[i]));
        return sum / 2;
    }
    std::vector<Face> cut() const {
        std::vector<Face> triangles;
        triangulate(vertices, loops, triangles);
        return triangles;
    }
    double covered() const {
        double sum = 0;
        for (const Face& face : cut()) sum += std::abs(twice_area({face[0], face[1], face[2]})) / 2;
        return sum;
    }
    /// Edges that an odd number of triangles have.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> border() const {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        const auto flip = [&](std::uint32_t a, std::uint32_t b) {
            if (a == b) return;
            const auto [known, added] = edges.emplace(std::minmax(a, b), 1);
            if (!added) edges.erase(known);
        };
        for (const Face& f : cut()) flip(f[0], f[1]), flip(f[1], f[2]), flip(f[2], f[0]);
        return edges;
    }
    void check() const {
        std::size_t corners = 0;
        for (const Loop& loop : loops) corners += loop.size();
        CHECK(cut().size() == corners + 2 * (loops.size() - 1) - 2);
        CHECK(covered() == Approx(area()).epsilon(1e-12));
        const auto edges = border();
        CHECK(edges.size() == corners);
        for (const Loop& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i)
                CHECK(edges.count(std::minmax(loop[i], loop[(i + 1) % loop.size()])) == 1);
    }
};

}  // namespace

TEST_CASE("triangulate: convex, concave, clockwise, with corners in line", "[compile]") {
    Drawing square;
    square.loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true);
    square.check();
    Drawing comb;
    comb.loop({{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
    comb.check();
    Drawing in_line;
    in_line.loop({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {1.5, 2}, {0, 2}, {0, 1}});
    in_line.check();
}

TEST_CASE("triangulate: holes in a row, one seen past another, corners level with each other", "[compile]") {
    Drawing drawing;
    drawing.loop({{0, 0}, {9, 0}, {9, 3}, {0, 3}});
    for (const double x : {1, 3, 5, 7}) drawing.loop({{x, 1}, {x + 1, 1}, {x + 1, 2}, {x, 2}}, x > 4);
    drawing.check();
    Drawing diamonds;
    diamonds.loop({{-4, 0}, {0, -4}, {4, 0}, {0, 4}});
    diamonds.loop({{-2, 0}, {-1, -1}, {0, 0}, {-1, 1}});
    diamonds.loop({{1, 0}, {2, -1}, {3, 0}, {2, 1}});
    diamonds.check();
    std::swap(diamonds.loops[0], diamonds.loops[2]);  // the largest loop is the outline, wherever it stands
    std::vector<Face> triangles;
    triangulate(diamonds.vertices, diamonds.loops, triangles);
    CHECK(triangles.size() == 14);
    CHECK(diamonds.covered() == Approx(32 - 2 - 2));
}

TEST_CASE("triangulate: rough faces with many rough holes", "[compile]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    const double pi = std::acos(-1.0);
    for (int round = 0; round < 60; ++round) {
        Drawing drawing;
        const auto ring = [&](double x, double y, double low, double high, int corners, bool backward) {
            std::vector<std::array<double, 2>> points;
            for (int i = 0; i < corners; ++i) {
                const double turn = 2 * pi * i / corners, r = low + (high - low) * unit(random);
                points.push_back({x + r * std::cos(turn), y + r * std::sin(turn)});
            }
            drawing.loop(points, backward);
        };
        ring(0, 0, 8, 12, 5 + round, unit(random) < 0.5);
        for (int x = -3; x <= 3; ++x)
            for (int y = -3; y <= 3; ++y)
                if (unit(random) < 0.3) {
                    const bool backward = unit(random) < 0.5;
                    ring(x, y, 0.05, 0.49, 3 + static_cast<int>(9 * unit(random)), backward);
                }
        drawing.check();
        // The same upright in space, leaning.
        for (Vec3& v : drawing.vertices) v = {v.y - 0.3 * v.x, 0.2 * v.x, v.x};
        std::vector<Face> turned;
        triangulate(drawing.vertices, drawing.loops, turned);
        CHECK(turned.size() == drawing.cut().size());
    }
}

TEST_CASE("triangulate: holes on a grid, all level with each other", "[compile]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 60; ++round) {
        Drawing drawing;
        drawing.loop({{0, 0}, {13, 0}, {13, 13}, {0, 13}}, unit(random) < 0.5);
        for (double x = 1; x < 13; x += 2)
            for (double y = 1; y < 13; y += 2) {
                const double kind = unit(random);
                if (kind < 0.2)
                    drawing.loop({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}, kind < 0.1);
                else if (kind < 0.4)
                    drawing.loop({{x, y}, {x + 1, y}, {x + 0.5, y + 1}}, kind < 0.3);
                else if (kind < 0.6)
                    drawing.loop({{x, y + 0.5}, {x + 0.5, y}, {x + 1, y + 0.5}, {x + 0.5, y + 1}}, kind < 0.5);
            }
        drawing.check();
    }
}

TEST_CASE("triangulate: a face that crosses itself, or has no area, still has its edges", "[compile]") {
    Drawing bow;
    bow.loop({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    CHECK(bow.border().size() == 4);
    Drawing flat;
    flat.loop({{0, 0}, {1, 0}, {2, 0}, {1, 0}});
    CHECK(flat.border().size() == 4);
    Drawing outside;  // a hole that is none
    outside.loop({{0, 0}, {1, 0}, {0, 1}});
    outside.loop({{5, 5}, {6, 5}, {5, 6}});
    CHECK(outside.border().size() == 6);
    std::vector<Face> none;
    triangulate({}, {}, none);
    CHECK(none.empty());
}
