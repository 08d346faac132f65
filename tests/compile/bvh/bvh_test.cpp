// The hierarchy: every solid in one leaf, inside all boxes on the way, and no ray past what it hits.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "catch.hpp"
#include "compile/bvh/build.hpp"
#include "compile/linear.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

struct Scattered {
    std::vector<Box> boxes;
    Vec3 center;
    double radius = 0;

    void add(const Vec3& middle, const Vec3& half) {
        boxes.push_back({{middle.x - half.x, middle.y - half.y, middle.z - half.z},
                         {middle.x + half.x, middle.y + half.y, middle.z + half.z}});
    }
    void finish() {
        Box all = empty_box;
        for (const Box& box : boxes) all = united(all, box);
        center = {0.5 * (all.low.x + all.high.x), 0.5 * (all.low.y + all.high.y), 0.5 * (all.low.z + all.high.z)};
        radius = 0.5 * diagonal(all);
    }
};

/// Boxes of all sizes, some flat, in clusters, far from the origin.
Scattered scattered(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Scattered s;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = std::pow(10, uniform(-3, 1));
        const double spread = i % 3 == 0 ? 1 : 100;
        s.add({1e5 + spread * uniform(-1, 1), spread * uniform(-1, 1), -7 + spread * uniform(-1, 1)},
              {size * uniform(0, 1), i % 5 == 0 ? 0 : size * uniform(0, 1), size});
    }
    s.finish();
    return s;
}

struct Span {
    std::uint32_t first, last;
};

/// Checks links and boxes; returns the leaves.
void check_structure(const Scattered& s, const Hierarchy& h, std::uint32_t first_solid) {
    const auto count = static_cast<std::uint32_t>(h.nodes.size());
    REQUIRE(h.order.size() == s.boxes.size());
    std::vector<std::uint32_t> sorted = h.order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == i);

    std::uint32_t next_solid = first_solid;  // leaves come in ascending order and miss none
    std::vector<std::uint32_t> path;         // inner nodes around the current one
    for (std::uint32_t i = 0; i < count; ++i) {
        const kernel::BvhNode& node = h.nodes[i];
        while (!path.empty() && h.nodes[path.back()].skip <= i) path.pop_back();
        REQUIRE(node.skip > i);
        REQUIRE(node.skip <= (path.empty() ? count : h.nodes[path.back()].skip));
        if (node.leaf == 0) {
            path.push_back(i);
            REQUIRE(node.skip >= i + 3);
            continue;
        }
        REQUIRE(node.skip == i + 1);
        const std::uint32_t first = node.leaf >> BVH_LEAF_SHIFT, size = node.leaf & BVH_LEAF_MASK;
        REQUIRE(first == next_solid);
        REQUIRE(size >= 1);
        REQUIRE(size <= 4);
        next_solid += size;
        path.push_back(i);
        bool inside = true;
        for (const std::uint32_t around : path) {
            for (std::uint32_t solid = first; solid < first + size; ++solid) {
                const Box& box = s.boxes[h.order[solid - first_solid]];
                const double low[] = {box.low.x - s.center.x, box.low.y - s.center.y, box.low.z - s.center.z};
                const double high[] = {box.high.x - s.center.x, box.high.y - s.center.y, box.high.z - s.center.z};
                for (int axis = 0; axis < 3; ++axis) {
                    inside = inside && h.nodes[around].low[axis] <= low[axis] - bvh_padding * s.radius;
                    inside = inside && h.nodes[around].high[axis] >= high[axis] + bvh_padding * s.radius;
                    inside = inside && h.nodes[around].low[axis] >= -s.radius * 1.001;
                    inside = inside && h.nodes[around].high[axis] <= s.radius * 1.001;
                }
            }
        }
        REQUIRE(inside);
        path.pop_back();
    }
    REQUIRE(next_solid == first_solid + s.boxes.size());
}

bool slab(const Vec3& o, const Vec3& d, const Box& box) {
    double in = -infinity, out = infinity;
    const double origin[] = {o.x, o.y, o.z}, direction[] = {d.x, d.y, d.z};
    const double low[] = {box.low.x, box.low.y, box.low.z}, high[] = {box.high.x, box.high.y, box.high.z};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < low[axis] || origin[axis] > high[axis]) return false;
            continue;
        }
        const double a = (low[axis] - origin[axis]) / direction[axis],
                     b = (high[axis] - origin[axis]) / direction[axis];
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    return in <= out;
}

/// The walk, with the boxes in double: what it enters.
std::vector<bool> entered(const Scattered& s, const Hierarchy& h, std::uint32_t first_solid, const Vec3& o,
                          const Vec3& d, std::size_t& tests) {
    std::vector<bool> met(s.boxes.size(), false);
    const Vec3 origin{o.x - s.center.x, o.y - s.center.y, o.z - s.center.z};
    for (std::uint32_t i = 0; i < h.nodes.size();) {
        const kernel::BvhNode& node = h.nodes[i];
        ++tests;
        if (!slab(origin, d, {{node.low[0], node.low[1], node.low[2]}, {node.high[0], node.high[1], node.high[2]}})) {
            i = node.skip;
            continue;
        }
        for (std::uint32_t k = 0; node.leaf != 0 && k < (node.leaf & BVH_LEAF_MASK); ++k)
            met[h.order[(node.leaf >> BVH_LEAF_SHIFT) - first_solid + k]] = true;
        ++i;
    }
    return met;
}

}  // namespace

TEST_CASE("a hierarchy of no boxes, of one, of a few") {
    CHECK(build_bvh({}, {}, 0, 3).nodes.empty());
    for (const std::size_t count : {1u, 2u, 3u, 5u, 17u}) {
        const Scattered s = scattered(count, 5);
        check_structure(s, build_bvh(s.boxes, s.center, s.radius, 3), 3);
    }
}

TEST_CASE("hierarchies of many boxes hold each once, inside all boxes on the way") {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Scattered s = scattered(3000, seed);
        check_structure(s, build_bvh(s.boxes, s.center, s.radius, 10), 10);
    }
}

TEST_CASE("boxes that lie in one place, and rows that halve each time, are split all the same") {
    Scattered same;
    for (int i = 0; i < 1000; ++i) same.add({1, 2, 3}, {1, 1, 1});
    same.finish();
    check_structure(same, build_bvh(same.boxes, same.center, same.radius, 0), 0);
    Scattered halving;
    for (int i = 0; i < 1000; ++i) halving.add({std::ldexp(1.0, -i), 0, 0}, {std::ldexp(1.0, -i - 3), 1e-9, 1e-9});
    halving.finish();
    check_structure(halving, build_bvh(halving.boxes, halving.center, halving.radius, 0), 0);
}

TEST_CASE("no ray passes a box that it hits, and few others are met") {
    const Scattered s = scattered(2000, 9);
    const Hierarchy h = build_bvh(s.boxes, s.center, s.radius, 0);
    std::mt19937 random(4);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t hits = 0, met_count = 0, tests = 0;
    constexpr int rays = test::tries(2000);
    for (int ray = 0; ray < rays; ++ray) {
        // At a point of some box, its sides and corners included; every third along an axis.
        const Box& aim = s.boxes[random() % s.boxes.size()];
        const auto pick = [&](double low, double high) {
            return ray % 4 == 0 ? (random() % 2 == 0 ? low : high) : uniform(low, high);
        };
        const Vec3 target{pick(aim.low.x, aim.high.x), pick(aim.low.y, aim.high.y), pick(aim.low.z, aim.high.z)};
        Vec3 d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        if (ray % 3 == 0) d = random() % 2 == 0 ? Vec3{1, 0, 0} : Vec3{0, 0, -1};
        const Vec3 o{target.x - 150 * d.x, target.y - 150 * d.y, target.z - 150 * d.z};
        const std::vector<bool> met = entered(s, h, 0, o, d, tests);
        for (std::size_t i = 0; i < s.boxes.size(); ++i) {
            const bool hit = slab(o, d, s.boxes[i]);
            if (hit) REQUIRE(met[i]);
            hits += hit;
            met_count += met[i];
        }
    }
    CHECK(hits >= rays / 2);
    CHECK(tests < rays * s.boxes.size() / 5);
    CHECK(met_count < rays * s.boxes.size() / 10);
}

TEST_CASE("a hundred thousand boxes") {
    const Scattered s = scattered(test::tries(100'000), 6);
    check_structure(s, build_bvh(s.boxes, s.center, s.radius, 1), 1);
}

TEST_CASE("a hierarchy does not depend on the number of threads") {
    const Scattered s = scattered(test::sanitized ? 20'000 : 60'000, 8);
    const Hierarchy one = build_bvh(s.boxes, s.center, s.radius, 5, 1);
    for (const unsigned threads : {2u, 3u, 8u}) {
        const Hierarchy h = build_bvh(s.boxes, s.center, s.radius, 5, threads);
        CHECK(h.order == one.order);
        REQUIRE(h.nodes.size() == one.nodes.size());
        CHECK(std::memcmp(h.nodes.data(), one.nodes.data(), h.nodes.size() * sizeof h.nodes[0]) == 0);
    }
}

TEST_CASE("boxes beyond the largest float are split, too") {
    Scattered far;
    for (int i = 0; i < 100; ++i) far.add({1e150 * i, -1e100, 1}, {1e149, 1, 1e-300});
    far.finish();
    const Hierarchy h = build_bvh(far.boxes, far.center, far.radius, 0);
    REQUIRE(h.order.size() == far.boxes.size());
    for (const kernel::BvhNode& node : h.nodes)
        for (int axis = 0; axis < 3; ++axis) CHECK(node.low[axis] <= node.high[axis]);
}

TEST_CASE("subtrees taken from an earlier hierarchy are those that are built", "[promise:edits]") {
    std::mt19937 random(8);
    const auto part = [&] { return static_cast<double>(random() % 1000) / 1000; };
    for (const std::size_t count : {3u, 40u, 3000u, 40'000u}) {
        std::vector<Box> boxes(count);
        const auto place = [&](Box& box) {
            const Vec3 low{part(), std::round(8 * part()) / 8, part()};
            box = {low, {low.x + 0.01, low.y + 0.01, low.z + 0.01 + 0.1 * part()}};
        };
        for (Box& box : boxes) place(box);
        const Vec3 center{0.5, 0.5, 0.5};
        Hierarchy before = build_bvh(boxes, center, 1, 0);
        for (int i = 0; i < 6; ++i) {
            std::vector<std::uint32_t> changed;
            for (int n = 0; n <= i; ++n) {
                changed.push_back(static_cast<std::uint32_t>(random() % count));
                place(boxes[changed.back()]);
            }
            const EarlierHierarchy earlier{before.nodes, before.order, changed};
            Hierarchy made = build_bvh(
                count, [&](std::size_t box) { return boxes[box]; }, center, 1, 0, 0, &earlier);
            const Hierarchy anew = build_bvh(boxes, center, 1, 0);
            CHECK((made.order == anew.order));
            REQUIRE(made.nodes.size() == anew.nodes.size());
            CHECK(std::memcmp(made.nodes.data(), anew.nodes.data(), made.nodes.size() * sizeof made.nodes[0]) == 0);
            before = std::move(made);
        }
    }
}
