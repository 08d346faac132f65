// How far each way to solve a quartic carries where tori are hard: wrong numbers of roots on decided rays, and how far
// off the ends are. Judged by the oracle's torus, which knows nothing of the kernels.
//
//   generic   through the tube, from some radii away; r/R from 0.1 to 0.9
//   thin      the same, r/R = 10^-3
//   grazing   10^-6 r inside or outside a tangent
//   far       the first, from 10^5 R away
//   edge-on   across the axis, through the tube
//
// bench/chart/README.md has the table for 200,000 rays a case, which the long test prints.
#include <array>
#include <cstdio>

#include "base/laboratory.hpp"
#include "catch.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/random.hpp"
#include "oracle/solids/all.hpp"

using namespace csgrt;
using oracle::quad;
using oracle::QVec;
using oracle::Random;

namespace {

enum class Where { generic, thin, grazing, far, edge_on };
constexpr std::array<const char*, 5> names{"generic", "thin", "grazing", "far", "edge-on"};
constexpr std::size_t methods = std::size(quartic_names);

struct Figures {
    std::size_t rays = 0, hits = 0, ties = 0;
    std::array<std::size_t, methods> wrong{};  ///< decided rays with another number of segments
    std::array<double, methods> worst{};       ///< on the others, an end's error in units of R
};

Tor some_torus(Where where, Random& random) {
    Tor tor;
    tor.v = oracle::to_vec3(quad(5) * random.in_cube());
    tor.h = oracle::to_vec3(random.direction());
    tor.r_a = random.power(-1, 1);
    tor.r_h = tor.r_a * (where == Where::thin ? 1e-3 : random.between(0.1, 0.9));
    return tor;
}

Ray some_ray(Where where, const Tor& tor, Random& random) {
    const QVec axis = oracle::unit(QVec(tor.h)), x = oracle::any_across(axis), y = oracle::cross(axis, x);
    const QVec c = random.direction();  // for two angles, and for a place in the tube
    const QVec out = oracle::unit(dot(c, x) * x + dot(c, y) * y);
    const QVec p = random.in_cube();
    const QVec from_circle = oracle::unit(p.x * out + p.y * axis);  // of the tube, outward
    const QVec circle = QVec(tor.v) + quad(tor.r_a) * out;
    QVec through = circle + quad(0.95 * random.unit() * tor.r_h) * from_circle;
    QVec d = random.direction();
    if (where == Where::edge_on) d = oracle::unit(dot(d, x) * x + dot(d, y) * y);
    if (where == Where::grazing) {
        const QVec other = random.direction();
        d = oracle::unit(oracle::cross(from_circle, other));
        through = circle + quad(tor.r_h * (1 + random.sign() * 1e-6)) * from_circle;
    }
    const double back = tor.r_a * (where == Where::far ? 1e5 : random.between(2, 10));
    return {oracle::to_vec3(through - quad(back) * d), oracle::to_vec3(d)};
}

Figures measure(Where where, std::size_t rays, std::uint64_t seed) {
    constexpr std::size_t rays_a_torus = 50;
    Random random(seed);
    Figures figures;
    while (figures.rays < rays) {
        const Tor tor = some_torus(where, random);
        const oracle::ImplicitSolid solid = oracle::implicit(tor, oracle::to_affine(identity));
        const CompiledScene scene = compile_alone(tor, identity);
        for (std::size_t i = 0; i < rays_a_torus; ++i) {
            const Ray ray = some_ray(where, tor, random);
            const oracle::Answer answer = oracle::intersect(solid, ray);
            ++figures.rays;
            figures.hits += !answer.intervals.empty();
            figures.ties += answer.tie;
            if (answer.tie) continue;
            const double speed = oracle::to_double(oracle::length(QVec(ray.direction)));
            for (std::size_t m = 0; m < methods; ++m) {
                const auto found = intersect_solid(scene, 0, ray, quartic_names[m].second);
                if (found.size() != answer.intervals.size()) {
                    ++figures.wrong[m];
                    continue;
                }
                for (std::size_t k = 0; k < found.size(); ++k)
                    for (const double off :
                         {found[k].in - answer.intervals[k].in.t, found[k].out - answer.intervals[k].out.t})
                        figures.worst[m] = std::max(figures.worst[m], std::abs(off) * speed / tor.r_a);
            }
        }
    }
    return figures;
}

void check(std::size_t rays, bool print) {
    if (print) {
        std::printf("| case | hits | ties |");
        for (const auto& [name, quartic] : quartic_names) std::printf(" %s |", std::string(name).c_str());
        std::printf("\n");
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto where = static_cast<Where>(c);
        const Figures figures = measure(where, rays, 100 + c);
        if (print) {
            std::printf("| %s | %zu | %zu |", names[c], figures.hits, figures.ties);
            for (std::size_t m = 0; m < methods; ++m) std::printf(" %zu, %.1e |", figures.wrong[m], figures.worst[m]);
            std::printf("\n");
            std::fflush(stdout);
        }
        INFO(names[c]);
        CHECK(3 * figures.hits > figures.rays);
        CHECK(1000 * figures.ties <= figures.rays);
        static_assert(quartic_names[0].second == Quartic::bracketed);  // the default
        CHECK(figures.wrong[0] == 0);
        CHECK(figures.worst[0] <= 1e-10);
        // What the shift is for.
        if (where == Where::far) CHECK(figures.wrong[1] * 2 > figures.rays);
    }
}

}  // namespace

TEST_CASE("geometry: tori are met as often as they are, within 1e-10 of their radii", "[geometry][promise:rounding]") {
    check(1'000, false);
}
TEST_CASE("geometry: tori, every way to solve a quartic on a million rays", "[.long]") { check(200'000, true); }
