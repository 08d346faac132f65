// Pipes against their definition: a point is in a pipe when it lies within the outer radius of the rounded centre line,
// and not within the inner one.
#include <cmath>
#include <random>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "scene/vector.hpp"

using namespace csgrt;

namespace {

/// A stretch of the centre line: straight, or a bend around `center`.
struct Stretch {
    Vec3 from, to;
    double outer[2], inner[2];  ///< radii at both ends
    bool round = false;
    Vec3 center{};
};

std::vector<Stretch> stretches_of(const Pipe& pipe) {
    std::vector<Stretch> result;
    Vec3 at = pipe.points.front().position;
    for (std::size_t i = 0; i + 1 < pipe.points.size(); ++i) {
        const auto &p = pipe.points[i], &q = pipe.points[i + 1];
        Vec3 to = q.position, after = to, center{};
        bool turns = false;
        if (i + 2 < pipe.points.size()) {
            const Vec3 back = unit(p.position - q.position), on = unit(pipe.points[i + 2].position - q.position);
            const double angle = std::acos(std::clamp(dot(back, on), -1.0, 1.0));  // between the legs; pi: straight on
            turns = angle < 3.14159;
            if (turns) {
                const double along = q.bend / std::tan(angle / 2);
                to = q.position + along * back;
                after = q.position + along * on;
                center = q.position + (q.bend / std::sin(angle / 2)) * unit(unit(back) + unit(on));
            }
        }
        result.push_back({at, to, {p.outer / 2, q.outer / 2}, {p.inner / 2, q.inner / 2}});
        if (turns) result.push_back({to, after, {q.outer / 2, q.outer / 2}, {q.inner / 2, q.inner / 2}, true, center});
        at = after;
    }
    return result;
}

/// How far a point is from being inside: negative inside.
double depth(const std::vector<Stretch>& stretches, const Vec3& p) {
    double outer = 1e9, inner = 1e9;
    for (const Stretch& s : stretches) {
        double beyond, distance, part = 0;
        if (s.round) {
            const Vec3 a = unit(s.from - s.center), b = unit(s.to - s.center), axis = unit(cross(a, b)),
                       r = p - s.center;
            const double height = dot(r, axis), radial = length(r - height * axis);
            distance = std::hypot(radial - length(s.from - s.center), height);
            beyond = std::max(-dot(cross(axis, a), r), dot(cross(axis, b), r));
        } else {
            const Vec3 h = s.to - s.from;
            part = dot(p - s.from, h) / dot(h, h);
            distance = length(p - s.from - part * h);
            beyond = std::max(-part, part - 1) * length(h);
        }
        const auto radius = [&](const double(&r)[2]) { return r[0] + std::clamp(part, 0.0, 1.0) * (r[1] - r[0]); };
        outer = std::min(outer, std::max(distance - radius(s.outer), beyond));
        if (s.inner[0] > 0 || s.inner[1] > 0) inner = std::min(inner, std::max(distance - radius(s.inner), beyond));
    }
    return std::max(outer, -inner);
}

void check_pipe(const Pipe& pipe, std::uint32_t seed) {
    const std::vector<Stretch> stretches = stretches_of(pipe);
    Scene scene{.objects = {Solid{"hose", pipe, {}}}};
    Settings settings{.reference = true};
    Renderer renderer(scene, {}, settings);
    std::mt19937_64 random(seed);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const Box box = renderer.model().bounds();
    std::vector<Ray> rays;
    const auto point = [&] {
        return Vec3{between(box.low.x, box.high.x), between(box.low.y, box.high.y), between(box.low.z, box.high.z)};
    };
    for (int i = 0; i < 3000; ++i) {
        const Vec3 a = point(), d = unit(point() - a);
        rays.push_back({a - 1000 * d, d});
    }
    const auto answers = renderer.shoot(rays);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        double before = 0;
        const auto at = [&](double t) { return depth(stretches, rays[i].origin + t * rays[i].direction); };
        for (const Partition& p : answers[i].partitions) {
            ++hits;
            INFO("ray " << i << " partition " << p.in << " " << p.out);
            CHECK(std::abs(at(p.in)) < 1e-9);
            CHECK(std::abs(at(p.out)) < 1e-9);
            // No piece of the definition changes sides within.
            for (int k = 1; k < 40; ++k) {
                CHECK(at(p.in + (p.out - p.in) * k / 40) < 1e-9);
                CHECK(at(before + (p.in - before) * k / 40) > -1e-9);
            }
            before = p.out;
        }
        for (int k = 1; k < 40; ++k) CHECK(at(before + (2500 - before) * k / 40) > -1e-9);
    }
    CHECK(hits > 300);
}

}  // namespace

TEST_CASE("pipes: cones and bends, solid, hollow, tapered, straight", "[promise:solids]") {
    check_pipe({{{{-75, -60, 75}, 22, 0, 35},
                 {{60, -60, 75}, 22, 0, 35},
                 {{60, 60, 75}, 22, 0, 35},
                 {{-30, 60, 185}, 22, 0, 30},
                 {{-70, 20, 185}, 22, 0, 30}}},
               1);
    check_pipe({{{{180, -60, 75}, 30, 20, 45},
                 {{300, -70, 95}, 30, 20, 45},
                 {{320, 55, 145}, 24, 14, 40},
                 {{200, 60, 195}, 24, 14, 40}}},
               2);
    check_pipe({{{{0, 0, 0}, 10, 4, 30}, {{50, 0, 0}, 50, 4, 30}, {{90, 0, 0}, 30, 28, 30}, {{160, 0, 0}, 30, 28, 30}}},
               3);
    check_pipe({{{{0, 0, 0}, 10, 0, 0}, {{0, 0, 80}, 20, 6, 0}}}, 4);
}

TEST_CASE("a cline is a cylinder, with a bore if it has a thickness", "[promise:solids]") {
    for (const double thickness : {0.0, 3.0}) {
        Scene scene{.objects = {Solid{"line", Cline{{0, 0, -40}, {0, 0, 80}, 18, thickness}, {}}}};
        Settings settings{.reference = true};
        Renderer renderer(scene, {}, settings);
        const auto answers = renderer.shoot({{{-100, 0, 0}, {1, 0, 0}}, {{1, 2, -100}, {0, 0, 1}}});
        const auto& across = answers[0].partitions;
        REQUIRE(across.size() == (thickness > 0 ? 2u : 1u));
        CHECK(std::abs(across.front().in - 82) < 1e-12);
        CHECK(std::abs(across.back().out - 118) < 1e-12);
        if (thickness > 0) CHECK(std::abs(across.front().out - 85) < 1e-12);
        CHECK(answers[1].partitions.size() == (thickness > 0 ? 0u : 1u));
    }
}
