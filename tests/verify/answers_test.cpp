// What counts as the same answer, and what as the same bits.
#include "verify/answers.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"

using csgrt::Partition;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
const csgrt::Vec3 along{2, 0, 0}, against{-1, 0, 0}, out{1, 0, 0}, grazing{0, 1, 0};
const csgrt::Blur blur{along, 0.5, 1e-3, 100};

Partition partition(std::uint32_t region, double from, double to) { return {from, to, against, out, region, 0, 0}; }

}  // namespace

TEST_CASE("partitions and gaps shorter than the tolerance do not count, in millimetres", "[promise:verify]") {
    const std::vector<Partition> all = {partition(1, 0, 10), partition(2, 10, 10.25), partition(1, 10.25, 20)};
    const std::vector<Partition> kept = that_count(all, blur);  // the direction is two millimetres long
    REQUIRE(kept.size() == 1);
    CHECK(kept[0].in == 0);
    CHECK(kept[0].out == 20);
    CHECK(that_count({partition(1, 0, 10), partition(2, 10, 10.26), partition(1, 10.26, 20)}, blur).size() == 3);
    CHECK(that_count({partition(1, 0, 10), partition(1, 10.26, 20)}, blur).size() == 2);
    CHECK(that_count({partition(1, -infinity, infinity)}, blur).size() == 1);
}

TEST_CASE("the flatter a ray meets a surface the farther an end may move, up to a limit") {
    CHECK(blur.of(against) == Approx(1e-3));
    CHECK(blur.of({-0.5, 0.8660254037844386, 0}) == Approx(2e-3));
    CHECK(blur.of(grazing) == Approx(2 * std::sqrt(100 * 1e-3)));
    Partition sliver = partition(1, 0, 0.5);
    CHECK(that_count({sliver}, blur).size() == 1);
    sliver.out_normal = grazing;
    CHECK(that_count({sliver}, blur).empty());
    sliver.out_normal = {undefined, undefined, undefined};
    CHECK(that_count({sliver}, blur).size() == 1);
}

TEST_CASE("answers pair as they are, without what does not count, or not at all") {
    const std::vector<Partition> one = {partition(1, 0, 10)}, skin = {partition(1, 0, 10), partition(2, 10, 10.1)};
    CHECK(pair(one, one, blur).as_they_are);
    CHECK(pair(one, {partition(1, 3, 4)}, blur).as_they_are);  // distances are judged elsewhere
    CHECK(pair(one, skin, blur).same_regions);
    CHECK(!pair(one, skin, blur).as_they_are);
    CHECK(!pair(one, {partition(2, 0, 10)}, blur).same_regions);
    CHECK(!pair(one, {}, blur).same_regions);
}

TEST_CASE("a partition that ends at the ray's start does not count: rounding decides whether it is left out") {
    const Partition leaving = partition(1, -5, 0), after = partition(1, 2, 3);
    CHECK(that_count({leaving, after}, blur).size() == 1);
    CHECK(that_count({partition(1, -5, 0.25)}, blur).empty());
    CHECK(that_count({partition(1, -5, 0.26)}, blur).size() == 1);
    CHECK(that_count({partition(1, -5, -0.1), partition(1, 0.1, 5)}, blur).size() == 1);  // joined: it straddles
    CHECK(pair({leaving}, {}, blur).same_regions);
    CHECK(!pair({leaving}, {after}, blur).same_regions);  // not the one for the other
    CHECK(!pair({leaving, after}, {leaving}, blur).same_regions);
    CHECK(!pair({leaving}, {leaving}, blur).as_they_are);

    const std::vector<csgrt::RayPartitions> nothing = {{}, {}};
    const csgrt::Blur fine{along, 0, 1e-12, 100};
    CHECK(!stands_alone({leaving}, nothing, fine));
    CHECK(stands_alone({leaving, after}, nothing, fine));
    CHECK(stands_alone({partition(1, -5, 1)}, nothing, fine));
    CHECK(stands_alone({partition(1, -5, 1e-3)}, nothing, fine));
}

TEST_CASE("an answer stands alone where all neighbours meet something else, over more than rounding") {
    const auto answer = [](std::vector<Partition> partitions) {
        return csgrt::RayPartitions{std::move(partitions), {}};
    };
    const csgrt::Blur fine{along, 0, 1e-12, 100};
    const csgrt::RayPartitions above = answer({partition(1, 0, 10), partition(1, 20, 30)}),
                               below = answer({partition(1, 5, 10), partition(1, 20, 40)});
    const std::vector<csgrt::RayPartitions> both = {above, below};
    // In the face of which the two neighbours are on either side, a ray may take after one of them anywhere.
    CHECK(!stands_alone(above.partitions, both, fine));
    CHECK(!stands_alone({partition(1, 0, 10), partition(1, 20, 40)}, both, fine));
    CHECK(!stands_alone({partition(1, 0, 10), partition(1, 20, 35)}, both, fine));
    CHECK(stands_alone({partition(1, 0, 30)}, both, fine));
    CHECK(stands_alone({partition(1, 0, 10)}, both, fine));
    CHECK(stands_alone({partition(1, 0, 8), partition(2, 8, 10), partition(1, 20, 30)}, both, fine));
    CHECK(!stands_alone({partition(1, 0, 10 + 1e-7), partition(1, 20, 30)}, both, fine));
}

TEST_CASE("a difference leaves out what both have before and behind it") {
    const auto chain = [](std::initializer_list<std::uint32_t> regions) {
        std::vector<Partition> partitions;
        for (const std::uint32_t region : regions) {
            const double at = 10.0 * static_cast<double>(partitions.size());
            partitions.push_back(partition(region, at, at + 5));
        }
        return partitions;
    };
    using Regions = std::vector<std::uint32_t>;
    const auto inner = difference_of(chain({1, 2, 3, 4}), chain({1, 5, 4}), blur);
    CHECK(inner.exact == Regions{2, 3});
    CHECK(inner.found == Regions{5});
    const auto twice = difference_of(chain({1, 1}), chain({1}), blur);  // the shared one is not counted twice
    CHECK(twice.exact == Regions{1});
    CHECK(twice.found.empty());
}

TEST_CASE("every bit of a ray's answer is compared", "[promise:verify]") {
    csgrt::RayPartitions a{{partition(1, 0, 1)}, {{0, 1, {1, 2}}}};
    CHECK(identical(a, a));
    const auto differs = [&](auto change) {
        csgrt::RayPartitions b = a;
        change(b);
        return !identical(a, b);
    };
    CHECK(differs([](auto& b) { b.partitions[0].in = -0.0; }));
    CHECK(differs([](auto& b) { b.partitions[0].out = std::nextafter(1.0, 2.0); }));
    CHECK(differs([](auto& b) { b.partitions[0].in_normal.y = -0.0; }));
    CHECK(differs([](auto& b) { b.partitions[0].out_normal.z = undefined; }));
    CHECK(differs([](auto& b) { b.partitions[0].region = 2; }));
    CHECK(differs([](auto& b) { b.partitions[0].in_solid = 2; }));
    CHECK(differs([](auto& b) { b.partitions[0].out_solid = 2; }));
    CHECK(differs([](auto& b) { b.partitions.clear(); }));
    CHECK(differs([](auto& b) { b.overlaps.clear(); }));
    CHECK(differs([](auto& b) { b.overlaps[0].in = -0.0; }));
    CHECK(differs([](auto& b) { b.overlaps[0].out = 2; }));
    CHECK(differs([](auto& b) { b.overlaps[0].regions = {1, 3}; }));
    a.partitions[0].in_normal.x = undefined;
    CHECK(identical(a, a));
}
