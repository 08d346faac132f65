// Bots in plate mode: every triangle that a ray crosses is a segment from one parallel plane to another, or of a
// length.
#include "kernels/geometry/check_meshes.hpp"

using namespace csgrt;
using oracle::quad;
using oracle::QVec;
using oracle::Random;
using oracle::to_double;

namespace {

struct Slab {
    quad in, face, out;
};

/// In the mesh's own space, where thickness is measured.
Slab slab_of(const Bot& bot, const oracle::QAffine& place, std::size_t i, const Ray& ray) {
    const oracle::QAffine inverse = place.inverse();
    const QVec o = inverse.point(ray.origin), d = inverse.direction(ray.direction);
    const QVec a = bot.vertices[bot.faces[i][0]], b = bot.vertices[bot.faces[i][1]], c = bot.vertices[bot.faces[i][2]];
    const QVec n = unit(cross(b - a, c - a));
    const quad face = dot(n, a - o) / dot(n, d);
    const quad rate = bot.mode == Bot::Mode::plate ? oracle::absolute(dot(n, d)) : length(d);
    const quad thickness = bot.thickness[i];
    const bool append = !bot.append.empty() && bot.append[i] != 0;
    return {face - (append ? quad(0) : thickness / 2 / rate), face, face + (append ? thickness : thickness / 2) / rate};
}

/// Is it across some triangle?
bool is_normal(const oracle::MeshSurface& surface, const Vec3& given) {
    const QVec n = given;
    for (std::size_t f = 0; f < surface.size(); ++f) {
        const QVec across = surface.normal(f);
        const double off = to_double(length(dot(n, across) > 0 ? n - across : n + across));
        if (off <= surface.condition *
                       (oracle::normal_precision + 64 * oracle::double_epsilon * surface.radius / surface.height(f)))
            return true;
    }
    return false;
}

struct Tally {
    std::size_t rays = 0, hits = 0, ties = 0;
};

void shoot(const oracle::Case& one, Random& random, Tally& tally) {
    const Bot& bot = std::get<Bot>(one.shape);
    const oracle::QAffine place = oracle::to_affine(one.matrix);
    const oracle::MeshSurface surface(bot.vertices, bot.faces, place);
    const auto solve = kernel_answer(one.shape, one.matrix);
    oracle::MeshRayMaker maker(surface, random);
    for (std::size_t i = 0; i < 42; ++i) {
        const Ray ray = maker.make(static_cast<oracle::RayFamily>(i % oracle::ray_families));
        const auto segments = solve(ray);
        const QVec o = ray.origin, d = ray.direction;
        const double speed = to_double(length(d));
        const quad way = oracle::absolute(dot(surface.center - o, d)) / quad(speed);
        const double numbers = surface.placement + to_double(way) + surface.radius;
        const double moved = surface.condition * (oracle::precision * surface.radius +
                                                  oracle::margin * oracle::ulps * oracle::double_epsilon * numbers);
        const oracle::MeshCrossings crossings = surface.cross_all(o, d, moved);
        bool tie = crossings.edge_distance <= quad(moved);
        bool grazes = false;  // some plate as good as edge-on; it may reach anywhere
        for (const auto& c : crossings.all) grazes = grazes || c.cosine < quad(1e-3);
        tie = tie || grazes;
        std::ostringstream told;
        told.precision(17);
        told << one.name << "\n  " << oracle::describe(ray) << "\n  solver:";
        for (const auto& s : segments) told << " [" << s.in << ", " << s.out << ']';
        told << "\n  oracle:";
        for (const auto& c : crossings.all) {
            const Slab slab = slab_of(bot, place, c.triangle, ray);
            told << " [" << to_double(slab.in) << ", " << to_double(slab.out) << ']';
        }
        INFO(told.str());
        ++tally.rays;
        tally.hits += crossings.all.empty() ? 0 : 1;
        tally.ties += tie ? 1 : 0;
        if (!tie) REQUIRE(segments.size() == crossings.all.size());
        for (std::size_t k = 0; k < segments.size(); ++k) {
            const auto& s = segments[k];
            REQUIRE(s.in <= s.out);
            if (k > 0) REQUIRE(segments[k - 1].in <= s.in);
            REQUIRE(to_double(dot(QVec(s.in_normal), d)) <= 1e-12 * speed);  // edge-on it is rounding
            // Where a ray touches the line between two plates both are met, and one segment here: it has normals of
            // both.
            if (tie)
                REQUIRE((is_normal(surface, s.in_normal) && is_normal(surface, s.out_normal)));
            else
                REQUIRE(to_double(length(QVec(s.in_normal) + QVec(s.out_normal))) < 1e-15);
            // Some triangle there has just this extent; where a ray touches the line between two plates, these have it.
            bool begins = grazes, ends = grazes, found = grazes;
            for (std::size_t f = 0; f < surface.size() && !found; ++f) {
                const quad cosine = oracle::absolute(dot(surface.normal(f), d)) / quad(speed);
                if (cosine < quad(1e-3)) {
                    found = tie;
                    continue;
                }
                const Slab slab = slab_of(bot, place, f, ray);
                const double turn =
                    surface.condition * 64 * oracle::double_epsilon * surface.radius / surface.height(f);
                const double slack =
                    2 * moved / to_double(cosine) / speed +
                    to_double(slab.out - slab.in) * (turn / to_double(cosine) + 1e-12 * surface.condition) +
                    4 * oracle::double_epsilon * std::max(std::abs(s.in), std::abs(s.out));
                if (!surface.is_near(f, o + slab.face * d, quad(2 * moved / to_double(cosine) + slack * speed)))
                    continue;
                const bool in = oracle::absolute(quad(s.in) - slab.in) <= quad(slack);
                const bool out = oracle::absolute(quad(s.out) - slab.out) <= quad(slack);
                begins = begins || in;
                ends = ends || out;
                found = (in && out) || (tie && begins && ends);
            }
            INFO("segment " << k);
            REQUIRE(found);
        }
    }
}

void check_plates(std::size_t solids, std::uint64_t seed) {
    Random random(seed);
    Tally tally;
    for (std::size_t i = 0; i < solids; ++i) {
        oracle::Case one = oracle::make_mesh_case(i + (i % 10 > 4 ? 5 : 0), random);
        Bot& bot = std::get<Bot>(one.shape);
        double size = 0;
        for (const Vec3& v : bot.vertices) size = std::max(size, to_double(length(QVec(v) - QVec(bot.vertices[0]))));
        bot.mode = i % 3 == 0 ? Bot::Mode::plate_nocos : Bot::Mode::plate;
        for (std::size_t f = 0; f < bot.faces.size(); ++f) {
            bot.thickness.push_back(size * random.power(-4, -1));
            if (i % 4 != 0) bot.append.push_back(random.coin() ? 1 : 0);
        }
        shoot(one, random, tally);
    }
    CHECK(tally.hits * 2 > tally.rays);
    CHECK(tally.ties * 2 < tally.rays);
}

Bot one_triangle() { return {.vertices = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, .faces = {{0, 1, 2}}}; }

}  // namespace

TEST_CASE("geometry: plates agree with the oracle", "[geometry][promise:solids]") { check_plates(40, 51); }
TEST_CASE("geometry: plates agree with the oracle on 250,000 rays", "[.long][promise:solids]") {
    check_plates(6'000, 52);
}

TEST_CASE("geometry: surfaces, and faces without thickness, are seen as a skin", "[geometry][promise:solids]") {
    Bot bot = one_triangle();
    for (const Bot::Mode mode : {Bot::Mode::surface, Bot::Mode::plate, Bot::Mode::plate_nocos}) {
        bot.mode = mode;
        if (mode != Bot::Mode::surface) bot.thickness = {0};
        const auto segments = kernel_answer(bot, identity)({{1, 1, 5}, {0, 0.3, -0.5}});
        REQUIRE(segments.size() == 1);
        CHECK(segments[0].in == Approx(10));
        CHECK((segments[0].out - segments[0].in) * std::hypot(0.3, 0.5) == Approx(0.001).epsilon(1e-9));
        CHECK(kernel_answer(bot, identity)({{1, 1, 0}, {1, 0, 0}}).empty());  // edge-on
    }
}
