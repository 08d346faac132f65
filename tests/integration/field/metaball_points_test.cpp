// Metaballs of many points: no piece of a ray is lost. The judge is the field itself, in 113 bits: where the ray passes
// each point and half-way between two such places it is inside or outside, and the answer must say so.
#include "catch.hpp"

#include <algorithm>
#include <cmath>

#include "integration/field/judge.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/solids/all.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;
using Method = Metaball::Method;

namespace {

constexpr Method methods[] = {Method::metaball, Method::isopotential, Method::blob};

/// Points in a row, in a few lumps or scattered, of some sizes; most of them reach a few others.
Metaball points_of(Method method, std::size_t form, std::size_t count, Random& random) {
    Metaball s;
    s.method = method;
    s.threshold = method == Method::metaball ? random.between(0.2, 0.7) : random.between(0.5, 2);
    const Vec3 along = random.direction(), start{random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)};
    const double n = static_cast<double>(count), step = random.between(1.2, 12), spread = 3 * std::cbrt(n);
    const auto scattered = [&](double by) {
        return Vec3{random.between(-by, by), random.between(-by, by), random.between(-by, by)};
    };
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 at = start;
        if (form == 0) at = at + (step * static_cast<double>(i)) * along;
        if (form == 1) at = at + (40.0 * static_cast<double>(i % 7)) * along + scattered(3);
        if (form == 2) at = at + scattered(spread);
        s.points.push_back({at, form == 0 ? 1 : random.between(0.3, 1.5), random.between(0.5, 3)});
    }
    return s;
}

/// Through two of the points, all but exactly or past them.
Ray ray_at(const Metaball& s, Random& random) {
    const auto some = [&] {
        const double off = random.coin() ? random.power_of_ten(-9, -2) : random.between(0, 0.7);
        return s.points[random.below(static_cast<std::uint32_t>(s.points.size()))].position + off * random.direction();
    };
    const Vec3 from = some();
    Vec3 way = some() - from;
    if (!(dot(way, way) > 1)) way = random.direction();
    return {from - random.between(0, 3) * way, way};
}
Ray along_row(const Metaball& s, double off) {
    const Vec3 way = unit(s.points[1].position - s.points[0].position);
    return {s.points[0].position - 5 * way + off * any_across(way), way};
}

struct Count {
    std::size_t rays = 0, places = 0, undecided = 0, wrong = 0, segments = 0;
};

/// Judges what is said of a ray at each point's pass, and half-way between two.
void judge(const Metaball& s, const oracle::ImplicitSolid& solid, const Ray& ray,
           const std::vector<oracle::Segment>& found, Count& count) {
    std::vector<double> places;
    const double square = dot(ray.direction, ray.direction);
    for (const Metaball::Point& p : s.points) places.push_back(dot(p.position - ray.origin, ray.direction) / square);
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i + 1 < s.points.size(); ++i) places.push_back(0.5 * (places[i] + places[i + 1]));
    for (const double t : places) {
        const oracle::QVec at = oracle::QVec(ray.origin) + oracle::quad(t) * oracle::QVec(ray.direction);
        const oracle::QVec local = solid.to_local.point(at);
        const oracle::quad value = solid.surfaces[0]->value(local);
        const bool is_in =
            std::any_of(found.begin(), found.end(), [&](const oracle::Segment& f) { return f.in <= t && t <= f.out; });
        ++count.places;
        if (is_in == (value < 0)) continue;
        const bool unsure = oracle::absolute(value) <= solid.change(0, local, oracle::quad(1e-11 * solid.radius));
        ++(unsure ? count.undecided : count.wrong);
    }
    ++count.rays;
    count.segments += found.size();
}

void judge_points(Method method, std::size_t form, std::size_t points, int rays, Random& random, Count& count) {
    const Metaball s = points_of(method, form, points, random);
    const oracle::ImplicitSolid solid = oracle::implicit(s, oracle::to_affine(identity));
    const auto answer = kernel_answer(s, identity);
    for (int i = 0; i < rays; ++i) {
        const Ray ray = form == 0 && i % 2 == 0 ? along_row(s, i == 0 ? 0 : random.between(0, 0.5)) : ray_at(s, random);
        judge(s, solid, ray, answer(ray), count);
    }
}

void check(const Count& count) {
    INFO(count.rays << " rays, " << count.segments << " segments, " << count.places << " places, " << count.undecided
                    << " undecided");
    CHECK(count.wrong == 0);
    CHECK(count.undecided * 1000 <= count.places);
    CHECK(count.segments > count.rays);
}

}  // namespace

TEST_CASE("a ray through 300 balls of a metaball meets all of them", "[field]") {
    for (const Method method : methods) {
        Metaball row{.method = method, .threshold = method == Method::metaball ? 0.5 : 1};
        for (int i = 0; i < 300; ++i) row.points.push_back({{10.0 * i, 0, 0}, 1, 1});
        const std::vector<oracle::Segment> found = kernel_answer(row, identity)({{-9, 0, 0}, {1, 0, 0}});
        REQUIRE(found.size() == 300);
        if (method != Method::metaball) continue;
        const double radius = std::sqrt(1 - std::sqrt(0.5));  // (1 - r^2)^2 = 1/2
        for (int i = 0; i < 300; ++i) {
            CHECK(found[static_cast<std::size_t>(i)].in == Approx(9 + 10 * i - radius).margin(1e-9));
            CHECK(found[static_cast<std::size_t>(i)].out == Approx(9 + 10 * i + radius).margin(1e-9));
        }
    }
}

TEST_CASE("metaballs of many points are what their field says", "[field]") {
    Random random(31);
    for (const Method method : methods) {
        Count count;
        for (const std::size_t form : {0u, 1u, 2u})
            for (const std::size_t points : {17u, method == Method::isopotential ? 90u : 300u})
                judge_points(method, form, points, 2, random, count);
        INFO(static_cast<int>(method));
        check(count);
    }
}

TEST_CASE("metaballs of many points on the device are those on the reference, to the bit", "[field]") {
    Random random(32);
    Builder to("metaballs", 1, 1);
    for (const Method method : methods)
        for (const std::size_t form : {0u, 2u}) {
            const Metaball s = points_of(method, form, 40, random);
            to.region(leaf(to.solid(s)));
            for (int i = 0; i < 8; ++i) {
                const Ray ray = ray_at(s, random);
                to.ray(ray.origin, ray.direction);
            }
        }
    const StressScene made = to.take();
    Renderer reference(made.scene, made.objects, test::on_reference());
    Renderer device(made.scene, made.objects, test::on_device());
    test::require_same(device.shoot(made.rays), reference.shoot(made.rays));
}

TEST_CASE("metaballs of many points are what their field says, 10^5 rays", "[.long]") {
    Random random(33);
    Count count;
    while (count.rays < 100'000)
        judge_points(methods[random.below(3)], random.below(3), 17 + random.below(40), 40, random, count);
    check(count);
}

TEST_CASE("metaballs of as many points as may be are right", "[.long]") {
    Random random(34);
    Count count;
    judge_points(Method::isopotential, 0, Limits::isopotential_points, 2, random, count);
    judge_points(Method::isopotential, 2, Limits::isopotential_points, 2, random, count);
    judge_points(Method::metaball, 0, Limits::metaball_points, 1, random, count);
    judge_points(Method::blob, 0, Limits::metaball_points, 1, random, count);
    check(count);
}
