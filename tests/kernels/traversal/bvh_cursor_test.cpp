// The walk through a hierarchy visits what is below the boxes that are hit, in order, and nothing below the others.
#include "catch.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernel_host/geometry.hpp"

using namespace csgrt;

namespace {

using Numbers = std::vector<std::uint32_t>;

kernel::BvhNode inner(std::uint32_t skip) { return {{0, 0, 0}, skip, {0, 0, 0}, 0}; }
kernel::BvhNode leaf(std::uint32_t skip, std::uint32_t first) {
    return {{0, 0, 0}, skip, {0, 0, 0}, first << BVH_LEAF_SHIFT | 1u};
}

/// 0 is the root, of (1: 2 and 3) and (4: 5 and (6: 7 and 8)). The leaves hold the things 0 to 4.
const std::vector<kernel::BvhNode> nodes = {inner(9),   inner(4), leaf(3, 0), leaf(4, 1), inner(9),
                                            leaf(6, 2), inner(9), leaf(8, 3), leaf(9, 4)};

struct Walk {
    Numbers visited, found;  ///< nodes, things
};
Walk walk(kernel::bvh_cursor cursor, const Numbers& missed) {
    Walk w;
    while (kernel::bvh_goes_on(cursor)) {
        w.visited.push_back(cursor.node);
        const bool hit = std::find(missed.begin(), missed.end(), cursor.node) == missed.end();
        if (const std::uint32_t found = kernel::bvh_step(&cursor, nodes[cursor.node], hit))
            w.found.push_back(found >> BVH_LEAF_SHIFT);
    }
    CHECK(cursor.node == cursor.end);
    return w;
}

}  // namespace

TEST_CASE("a walk over a hierarchy visits each node once where all boxes are hit", "[kernels]") {
    const Walk all = walk(kernel::bvh_over(9), {});
    CHECK(all.visited == Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(all.found == Numbers{0, 1, 2, 3, 4});
}

TEST_CASE("a walk over a hierarchy passes by what is below a box that is missed", "[kernels]") {
    CHECK(walk(kernel::bvh_over(9), {0}).visited == Numbers{0});
    CHECK(walk(kernel::bvh_over(9), {0}).found.empty());
    const Walk right = walk(kernel::bvh_over(9), {1, 7});
    CHECK(right.visited == Numbers{0, 1, 4, 5, 6, 7, 8});
    CHECK(right.found == Numbers{2, 4});
    const Walk left = walk(kernel::bvh_over(9), {2, 4});
    CHECK(left.visited == Numbers{0, 1, 2, 3, 4});
    CHECK(left.found == Numbers{1});
}

TEST_CASE("a walk below a node stays below it", "[kernels]") {
    CHECK(walk(kernel::bvh_below(nodes.data(), 1), {}).visited == Numbers{1, 2, 3});
    CHECK(walk(kernel::bvh_below(nodes.data(), 6), {8}).found == Numbers{3});
    CHECK(walk(kernel::bvh_below(nodes.data(), 5), {}).found == Numbers{2});  // a leaf is below itself
}

TEST_CASE("a walk over no nodes visits none", "[kernels]") { CHECK(walk(kernel::bvh_over(0), {}).visited.empty()); }

TEST_CASE("the next leaf of a ray is one whose box, and all boxes above it, the ray hits", "[kernels]") {
    // A row of unit boxes along x, two to a parent; the ray runs across the row at x = 2.5 and 6.5 in turn.
    std::vector<kernel::BvhNode> row = {inner(7), inner(4), leaf(3, 0), leaf(4, 1), inner(7), leaf(6, 2), leaf(7, 3)};
    const float low[] = {0, 0, 0, 2, 4, 4, 6}, high[] = {8, 4, 2, 4, 8, 6, 8};
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i].low[0] = low[i] - 4;
        row[i].high[0] = high[i] - 4;
        row[i].low[1] = row[i].low[2] = -1;
        row[i].high[1] = row[i].high[2] = 1;
    }
    const auto leaves_at = [&](double x) {
        const kernel::wide3 o = kernel::make_wide3(x - 4, -10, 0), center = kernel::make_wide3(0, 0, 0);
        const kernel::slab_ray ray = kernel::make_slab_ray(kernel::offset_from(center, o), kernel::make_vec3(0, 1, 0),
                                                           8, -kernel::REAL_INFINITY);
        kernel::bvh_cursor cursor = kernel::bvh_over(7);
        Numbers found;
        while (const std::uint32_t next = kernel::next_leaf(ray, row.data(), &cursor))
            found.push_back(next >> BVH_LEAF_SHIFT);
        return found;
    };
    CHECK(leaves_at(2.5) == Numbers{1});
    CHECK(leaves_at(6.5) == Numbers{3});
    CHECK(leaves_at(4) == Numbers{1, 2});  // along the face that two boxes share
    CHECK(leaves_at(9).empty());
}
