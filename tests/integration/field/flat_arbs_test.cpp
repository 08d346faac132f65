// Arbs whose vertices are repeated at random: an edge, a face or a whole side of them may collapse, and what is left
// may be a body, or sheets that lie on one another. Those without volume are refused by name; of all others device and
// reference give the same bits, within the box of the vertices.
#include "catch.hpp"

#include <algorithm>
#include <cmath>

#include "integration/field/judge.hpp"
#include "oracle/concave_arb.hpp"
#include "scene/faults/check_faults.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

Arb collapsed(Random& random) {
    Arb arb = box({0, 0, 0}, {1, 1, 1});
    const Vec3 a{random.between(1, 3), random.between(-1, 1), 0}, b{0, random.between(1, 3), random.between(-1, 1)},
        c{random.between(-1, 1), 0, random.between(1, 3)};
    const bool plain = random.coin();
    if (!plain)
        for (Vec3& v : arb.vertices) v = v.x * a + v.y * b + v.z * c;
    for (int i = random.whole(1, 5); i > 0; --i) arb.vertices[random.below(8)] = arb.vertices[random.below(8)];
    return arb;
}

/// Is some of many points within what the faces enclose? By the parity of the faces on a ray.
bool encloses(const Arb& arb, Random& random) {
    for (int i = 0; i < 300; ++i) {
        Vec3 at{0, 0, 0};
        double sum = 0;
        for (const Vec3& v : arb.vertices) {
            const double weight = -std::log(1 - random.unit());
            at = at + weight * v;
            sum += weight;
        }
        if (oracle::contains(arb, (1 / sum) * at)) return true;
    }
    return false;
}

/// How many are refused because their faces lie on one another.
std::size_t check_collapsed(std::uint64_t seed, int arbs, int rays) {
    Random random(seed);
    Builder to("arbs", seed, 1);
    std::size_t refused = 0, accepted = 0;
    std::vector<Arb> kept;
    for (int i = 0; i < arbs; ++i) {
        const Arb arb = collapsed(random);
        const std::vector<std::string> faults = solid_faults(arb);
        if (faults.empty()) {
            ++accepted;
            to.region(leaf(to.solid(arb)));
            kept.push_back(arb);
        } else if (faults.front().find("lie on one another") != std::string::npos) {
            ++refused;
            CHECK_FALSE(encloses(arb, random));
        }
    }
    CHECK(accepted * 10 > static_cast<std::size_t>(arbs));
    const StressScene made = to.take();
    for (std::size_t k = 0; k < kept.size(); ++k) {
        std::vector<Ray> through;
        Vec3 low = kept[k].vertices[0], high = low;
        for (const Vec3& v : kept[k].vertices) {
            low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        }
        for (int i = 0; i < rays; ++i) {
            const auto some = [&](double from, double to_) { return from + (to_ - from) * random.between(-0.3, 1.3); };
            const Vec3 way = random.direction();
            through.push_back({Vec3{some(low.x, high.x), some(low.y, high.y), some(low.z, high.z)} - 20.0 * way, way});
        }
        const std::vector<std::string> object{made.objects[k]};
        INFO(oracle::describe(kept[k], identity));
        const auto found = Renderer(made.scene, object, test::on_reference()).shoot(through);
        test::require_same(Renderer(made.scene, object, test::on_device()).shoot(through), found);
        for (std::size_t i = 0; i < found.size(); ++i)
            for (const Partition& p : found[i].partitions)
                for (const double t : {p.in, p.out}) {
                    const Vec3 at = through[i].origin + t * through[i].direction;
                    const double out = std::max(
                        {low.x - at.x, low.y - at.y, low.z - at.z, at.x - high.x, at.y - high.y, at.z - high.z});
                    CHECK(out < 1e-9);
                }
    }
    return refused;
}

}  // namespace

TEST_CASE("arbs of repeated vertices have a volume or are refused by name", "[field]") {
    CHECK(check_collapsed(1, 60, 12) > 0);
}
TEST_CASE("arbs of repeated vertices have a volume or are refused by name, 10^5 rays", "[.long]") {
    std::size_t refused = 0;
    for (std::uint64_t seed = 10; seed < 60; ++seed) refused += check_collapsed(seed, 200, 20);
    CHECK(refused > 100);
}

TEST_CASE("an arb of two sheets, each there and back, is refused", "[field]") {
    const Arb sheets{{{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 0, 1}, {0, 1, 1}}}};
    check_fault(sheets, "its faces lie on one another: there is no volume");
}

TEST_CASE("an arb thinner than 1e-12 of its size is refused with the numbers", "[field]") {
    check_fault(box({0, 0, 0}, {1e12, 1, 1}),
                "it is too thin: its vertices lie within 0.707107 mm of one plane, and within 1 mm, 1e-12 of its size");
    check_fault(box({0, 0, 0}, {1, 1, 1e-13}), "it is too thin: its vertices lie within 1e-13 mm of one plane");
    check_fault(box({0, 0, 0}, {1, 1, 0}), "the vertices lie in one plane: there is no volume");
    check_fault(box({1e9, 0, 0}, {1e9 + 1e-7, 1, 1}), "the vertices lie in one plane");  // to the coordinates' rounding
    check_sound(box({0, 0, 0}, {1e12, 2, 2}));
    check_sound(box({0, 0, 0}, {1, 1, 2e-12}));
}
