// Rays that are parallel to the plane of a half-space, as far as their numbers let one say: they stay on their side,
// though the product of the normal and the direction is rarely 0. Judged in closed form.
#include "catch.hpp"

#include <cmath>
#include <limits>

#include "integration/field/judge.hpp"
#include "oracle/solids/all.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A half-space somewhere, alone, cut by a ball and cut out of it, and rays along its plane from points that lie in the
/// ball, off the plane.
struct Along {
    StressScene made;
    std::vector<double> heights;  ///< of the rays above the plane
    double radius = 0;
};

Along along(std::uint64_t seed, std::size_t times) {
    Builder to("parallel", seed, times);
    Random& random = to.random();
    Along result;
    const double scale = random.power_of_ten(-3, 6);
    const Vec3 normal = unit(random.direction());
    const double distance = random.below(3) == 0 ? 0 : scale * random.between(-1, 1);
    const Matrix place = seed % 3 == 0 ? identity : translation(scale * random.direction()) * rotation(random);
    const Vec3 middle = distance * normal;
    result.radius = scale;
    const std::string half = to.solid(Half{{normal, distance}}), sphere = to.solid(ball(middle, scale));
    to.region(leaf(half, place));
    to.region(operate(Operator::intersection, {leaf(sphere, place), leaf(half, place)}));
    to.region(operate(Operator::difference, {leaf(sphere, place), leaf(half, place)}));
    const oracle::ImplicitSolid judge = oracle::implicit(Half{{normal, distance}}, oracle::to_affine(place));
    const oracle::QVec across = judge.normal(0, judge.center);
    for (int i = to.rays(24); i > 0;) {
        const Vec3 x = any_across(normal), y = cross(normal, x);
        const double turn = random.between(-4, 4),
                     height = random.sign() * scale * random.between(0.1, 0.9) * random.power_of_ten(-8, 0);
        const Vec3 direction = std::cos(turn) * x + std::sin(turn) * y;
        const Vec3 way = moved_direction(place, random.power_of_ten(-3, 3) * direction);
        // A few roundings on the way here may have turned it farther.
        const oracle::quad least = oracle::quad(0x1p-51) * oracle::length(oracle::QVec(way));
        if (oracle::absolute(oracle::dot(across, oracle::QVec(way))) > least) continue;
        --i;
        to.ray(moved_point(place, middle + height * normal + scale * random.between(-0.2, 0.2) * direction), way);
        result.heights.push_back(height);
    }
    result.made = to.take();
    return result;
}

void check_along(const Along& a, std::size_t& rays) {
    Settings settings = test::on_reference();
    settings.tolerance_rule = Tolerance::surfaces;
    Settings device_settings = test::on_device();
    device_settings.tolerance_rule = Tolerance::surfaces;
    std::size_t wrong = 0;
    for (std::size_t region = 0; region < 3; ++region) {
        const std::vector<std::string> object{a.made.objects[region]};
        const auto found = Renderer(a.made.scene, object, settings).shoot(a.made.rays);
        test::require_same(Renderer(a.made.scene, object, device_settings).shoot(a.made.rays), found);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const bool below = a.heights[i] < 0;
            const std::vector<Partition>& p = found[i].partitions;
            if (below == (region == 2)) {
                wrong += !p.empty();
            } else if (region == 0) {
                wrong += p.size() != 1 || p[0].in != -infinite || p[0].out != infinite;
            } else {
                const double length = std::sqrt(dot(a.made.rays[i].direction, a.made.rays[i].direction));
                const double chord = 2 * std::sqrt(a.radius * a.radius - a.heights[i] * a.heights[i]);
                wrong += p.size() != 1 || std::abs((p[0].out - p[0].in) * length - chord) > 1e-9 * a.radius;
            }
            ++rays;
        }
    }
    INFO("seed " << a.made.seed);
    CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("a ray along the plane of a half-space stays on its side", "[field]") {
    std::size_t rays = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) check_along(along(seed, 1), rays);
    CHECK(rays > 1000);
}

TEST_CASE("a ray along the plane of a half-space stays on its side, 10^5 rays", "[.long]") {
    std::size_t rays = 0;
    for (std::uint64_t seed = 100; rays < 100'000; ++seed) check_along(along(seed, 20), rays);
}
