// Arbs with flat faces that are not convex: a dart in any pair of faces, drawn out straight, leaning, tapering, to a
// point or cut askew, with six, seven or eight vertices; convex ones among them.
#include "catch.hpp"

#include <algorithm>

#include "integration/field/judge.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::test;
using namespace csgrt::stress;

namespace {

/// Four points of a plane in order; the third lies within the triangle of the others, or beyond it: a convex outline.
std::array<Vec3, 4> outline(Random& random) {
    const Vec3 x = random.direction(), y = unit(cross(x, random.direction()));
    const auto at = [&](double u, double v) { return u * x + v * y; };
    const Vec3 a = at(random.between(-4, 4), random.between(-4, 4)),
               b = a + at(random.between(3, 8), random.between(-2, 2)),
               c = a + at(random.between(-2, 2), random.between(3, 8));
    // From sickles over darts and notches as shallow as 1e-7 to convex. In a sickle as slim as that, a ray close to the
    // tip may be inside for less than ends may be apart.
    const double notch = random.coin() ? random.between(0.05, 0.9) : random.power_of_ten(-7, -1);
    const double depth = random.below(4) == 0 ? -notch : random.coin() ? notch : 1 - std::max(notch, 1e-3);
    const double along = random.between(0.2, 0.8);
    return {a, b, a + (1 - depth) * (along * (b - a) + (1 - along) * (c - a)), c};
}

/// The symmetries of a cube that leave its corners numbered as an arb's.
std::array<std::size_t, 8> renumbering(Random& random) {
    static constexpr std::array<std::array<std::size_t, 8>, 3> turns{
        {{1, 2, 3, 0, 5, 6, 7, 4}, {4, 5, 1, 0, 7, 6, 2, 3}, {4, 5, 6, 7, 0, 1, 2, 3}}};  // the last one mirrors
    std::array<std::size_t, 8> all{0, 1, 2, 3, 4, 5, 6, 7};
    for (int i = random.whole(0, 7); i > 0; --i) {
        const auto& turn = turns[random.below(3)];
        std::array<std::size_t, 8> next;
        for (std::size_t k = 0; k < 8; ++k) next[k] = all[turn[k]];
        all = next;
    }
    return all;
}

/// Of flat faces: does one cross itself?
bool crosses_itself(const Arb& arb) {
    const auto& v = arb.vertices;
    const auto apart = [](const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
        return dot(cross(q - p, a - p), cross(q - p, b - p)) < 0;
    };
    const auto cross_at = [&](const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
        return apart(p, q, a, b) && apart(a, b, p, q);
    };
    for (const auto& f :
         {std::array{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}}) {
        const auto at = [&](std::size_t i) { return v[static_cast<std::size_t>(f[i])]; };
        if (cross_at(at(0), at(1), at(2), at(3)) || cross_at(at(1), at(2), at(3), at(0))) return true;
    }
    return false;
}

/// Of any form; one of its faces may cross itself.
Arb any_arb(Random& random) {
    std::array<Vec3, 4> base = outline(random);
    std::rotate(base.begin(), base.begin() + random.below(4), base.end());
    if (random.coin()) std::reverse(base.begin(), base.end());
    const Vec3 normal = unit(cross(base[2] - base[0], base[3] - base[1]));
    const double thin = random.below(4) == 0 ? random.power_of_ten(-6, -1) : random.between(1, 6);
    const Vec3 h = thin * (normal + 0.5 * random.in_cube());
    Arb arb;
    auto& v = arb.vertices;
    std::copy(base.begin(), base.end(), v.begin());
    const int form = random.whole(0, 6);
    if (form <= 1) {  // a prism
        for (std::size_t i = 0; i < 4; ++i) v[i + 4] = base[i] + h;
    } else if (form == 2) {  // a frustum, or to a point
        const Vec3 apex = base[0] + 0.5 * (base[2] - base[0]) + h;
        const double taper = random.coin() ? 0 : random.between(0.1, 0.9);
        for (std::size_t i = 0; i < 4; ++i) v[i + 4] = apex + taper * (base[i] - apex);
        if (taper == 0) return arb;
    } else if (form == 3) {  // a prism cut askew
        const Vec3 slope = 0.08 * random.in_cube();
        for (std::size_t i = 0; i < 4; ++i) v[i + 4] = base[i] + (1 + dot(slope, base[i] - base[0])) * h;
    } else if (form <= 5) {  // arb6: an edge over the base, towards where its lines 0 3 and 1 2 meet
        const Vec3 u = base[3] - base[0], w = base[2] - base[1], n = cross(u, w);
        const double bent = dot(n, n) / (dot(u, u) * dot(w, w));
        const Vec3 from = base[0] + 0.5 * (base[1] - base[0]) + h;
        const double beyond = bent < 1e-4 ? 0 : dot(cross(base[1] - base[0], w), n) / dot(n, n);
        v[4] = v[5] = from;
        v[6] = v[7] = from + (beyond < 0 ? -1 : 1) * random.between(0.1, 0.8) * (base[0] + beyond * u - from);
        if (bent < 1e-4) v[6] = v[7] = from + u;
        return arb;
    } else {  // arb7: vertex 5 in the plane of 0 1 4, vertex 6 on the line through 2 in which the planes of its faces
              // meet
        v[4] = v[7] = base[0] + 0.2 * (base[1] - base[0]) + 0.2 * (base[3] - base[0]) + h;
        v[5] = base[1] + random.between(0.3, 0.9) * (v[4] - base[0]);
        const Vec3 p = cross(base[1] - base[2], v[5] - base[2]), q = cross(base[3] - base[2], v[4] - base[2]);
        Vec3 line = cross(p, q);
        if (!(dot(line, line) > 1e-12 * dot(p, p) * dot(q, q))) line = h;
        if (dot(line, h) < 0) line = -1 * line;
        v[6] = base[2] + random.between(0.3, 0.9) * std::sqrt(dot(h, h)) * unit(line);
        return arb;
    }
    const auto number = renumbering(random);
    Arb renumbered;
    for (std::size_t i = 0; i < 8; ++i) renumbered.vertices[i] = v[number[i]];
    return renumbered;
}

Arb some_arb(Random& random) {
    for (;;)
        if (const Arb arb = any_arb(random); !crosses_itself(arb)) return arb;
}

StressScene make_arbs(std::uint64_t seed, std::size_t times) {
    Builder to("concave_arbs", seed, times);
    Random& random = to.random();
    std::vector<Vec3> corners, normals;
    const int count = random.whole(1, 3);
    // All of them together: ends closer than a part of the whole scene are one.
    const Vec3 place = random.below(5) == 0 ? random.power_of_ten(2, 6) * random.in_cube() : Vec3{};
    for (int i = 0; i < count; ++i) {
        Arb arb = some_arb(random);
        Matrix m = identity;
        if (random.coin()) m = rotation(random) * m;
        m = translation(place + 3 * random.in_cube()) * m;
        if (random.below(3) == 0) m = m * Matrix{-1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
        const std::string name = to.solid(arb);
        Tree tree = leaf(name, m);
        if (random.below(3) == 0) {
            const Vec3 at = moved_point(m, arb.vertices[random.below(8)]);
            tree = operate(random.coin() ? Operator::difference : Operator::intersection,
                           {tree, leaf(to.solid(ball(at, random.between(1, 4))))});
        }
        to.region(tree);
        for (const Vec3& v : arb.vertices) corners.push_back(moved_point(m, v));
    }
    const auto corner = [&](std::size_t arb) -> const Vec3& { return corners[8 * arb + random.below(8)]; };
    for (int i = 0; i < to.rays(40); ++i) {
        const std::size_t arb = random.below(static_cast<std::uint32_t>(count));
        const Vec3 a = corner(arb), b = corner(arb), c = corner(arb), middle = a + random.unit() * (b - a);
        const Vec3 through = middle + random.unit() * (c - middle);
        switch (i % 5) {
            case 0:  // through a face or the inside
            case 1:
                to.ray_through(through, random.direction(), random.between(5, 30));
                break;
            case 2:  // through an edge or a diagonal, or close by
                to.ray_through(middle + (random.coin() ? 0 : random.power_of_ten(-6, -1)) * random.direction(),
                               random.direction(), random.between(5, 30));
                break;
            case 3: {  // in the plane of three vertices: that of a face, often
                // Not along an edge: the oracle tries rays beside it in eight directions, and may miss a slim wedge.
                const Vec3 d = random.between(-1, 1) * (b - a) + random.between(-1, 1) * (c - a),
                           n = cross(b - a, c - a);
                if (dot(n, n) > 1e-9 * dot(b - a, b - a) * dot(c - a, c - a)) to.ray_through(through, unit(d), 20);
                break;
            }
            default:  // from within, along an axis, or along another's edge
                to.ray(through, random.coin() ? random.axis() : random.direction());
        }
    }
    return to.take();
}

FieldTally judged(std::uint64_t scenes, std::size_t times) {
    FieldTally tally;
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) judge_field(make_arbs(seed, times), tally);
    return tally;
}

}  // namespace

TEST_CASE("field: arbs that are not convex", "[field][promise:solids]") { require_all_right(judged(12, 1)); }

TEST_CASE("field: arbs that are not convex, 10^5 rays", "[.long][promise:solids]") {
    require_all_right(judged(250, 10));
}
