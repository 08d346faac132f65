// The judge judged: it accepts the oracle's own answers, its ties are where rounding decides, and it finds planted
// faults.
#include "catch.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include "oracle/campaign.hpp"
#include "oracle/print.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

constexpr std::array kinds{Kind::ell, Kind::tgc,  Kind::arb, Kind::arbn, Kind::half, Kind::tor, Kind::ehy,
                           Kind::epa, Kind::part, Kind::rpc, Kind::rhc,  Kind::eto,  Kind::hyp};

/// The oracle's answers, rounded to double, as a solver would give them.
std::vector<Segment> segments_of(const Answer& answer) {
    std::vector<Segment> segments;
    for (const Interval& i : answer.intervals) segments.push_back({i.in.t, i.out.t, i.in.normal, i.out.normal});
    return segments;
}

/// A solver that answers with the oracle for a (possibly changed) shape, and spoils each answer.
template <class Spoil, class Change>
auto spoiled(const Spoil& spoil, const Change& change) {
    return [&](const Shape& shape, const Matrix& matrix) {
        auto solid = std::make_shared<ImplicitSolid>(implicit(change(shape), matrix));
        return [solid, &spoil](const Ray& ray) {
            std::vector<Segment> segments = segments_of(intersect(*solid, ray));
            spoil(ray, segments);
            return segments;
        };
    };
}
const auto as_it_is = [](const Shape& shape) { return shape; };
const auto leave = [](const Ray&, std::vector<Segment>&) {};

bool tie(const Shape& shape, const Ray& ray) { return intersect(implicit(shape, identity), ray).tie; }

/// The ray with its last bits changed; `each`: each component of the direction by itself, so that zeros stay.
Ray nudged(const Ray& ray, double size, bool each, Random& random) {
    const QVec o = ray.origin, d = ray.direction, by = random.in_cube();
    const quad e = 2 * quad(double_epsilon);
    const QVec turned = each ? d + e * QVec{d.x * by.x, d.y * by.y, d.z * by.z} : d + e * length(d) * by;
    return {to_vec3(o + e * larger(length(o), quad(size)) * random.in_cube()), to_vec3(turned)};
}

}  // namespace

TEST_CASE("judge: the oracle's own answers pass", "[oracle]") {
    for (const Kind kind : kinds) {
        const Campaign campaign = run_campaign(kind, 1000, 11, spoiled(leave, as_it_is));
        for (const std::string& failure : campaign.failures) FAIL_CHECK(failure);
        CHECK(campaign.total().wrong == 0);
        CHECK(campaign.total().hits > 300);
        CHECK(campaign.tally[static_cast<std::size_t>(RayFamily::ordinary)].ties == 0);
        CHECK(campaign.tally[static_cast<std::size_t>(RayFamily::far)].ties <= 3);
        // A grazing ray is a tie only where it comes within the rounding, 1e-12 to 1e-14 sizes, not as a rule.
        CHECK(campaign.tally[static_cast<std::size_t>(RayFamily::tangent)].ties < 75);
    }
}

TEST_CASE("judge: a grazing ray is decided just off the surface and a tie on it", "[oracle]") {
    const Shape sphere = Ell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Shape torus = Tor{{0, 0, 0}, {0, 0, 1}, 1, 0.25};
    for (const double off : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13}) {
        INFO(off);
        const Answer in = intersect(implicit(sphere, identity), {{1 - off, -3, 0}, {0, 1, 0}});
        const Answer out = intersect(implicit(sphere, identity), {{1 + off, -3, 0}, {0, 1, 0}});
        CHECK_FALSE(in.tie);
        CHECK_FALSE(out.tie);
        CHECK(in.intervals.size() == 1);
        CHECK(out.intervals.empty());
        const Answer apart = intersect(implicit(torus, identity), {{0.75 - off, -3, 0}, {0, 1, 0}});
        const Answer joined = intersect(implicit(torus, identity), {{0.75 + off, -3, 0}, {0, 1, 0}});
        CHECK_FALSE(apart.tie);
        CHECK_FALSE(joined.tie);
        CHECK(apart.intervals.size() == 2);
        CHECK(joined.intervals.size() == 1);
    }
    CHECK(tie(sphere, {{1, -3, 0}, {0, 1, 0}}));
    CHECK(tie(torus, {{0.75, -3, 0}, {0, 1, 0}}));
    CHECK(tie(torus, {{-3, 0.25, 0.25}, {1, 0, 0}}));  // in the plane that touches its top circle
}

TEST_CASE("judge: rays in faces, through edges and corners, and past an apex are ties", "[oracle]") {
    const Shape cube = Arb{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
    CHECK(tie(cube, {{-1, 0.5, 0}, {1, 0, 0}}));         // in a face
    CHECK(tie(cube, {{-1, 0, 0}, {1, 0, 0}}));           // along an edge
    CHECK(tie(cube, {{-1, 1, 0.5}, {1, -1, 0}}));        // touches an edge
    CHECK_FALSE(tie(cube, {{-1, -1, 0.5}, {1, 1, 0}}));  // enters through an edge: one interval in any case
    CHECK_FALSE(tie(cube, {{-1, 0.5, 1e-12}, {1, 0, 0}}));
    CHECK_FALSE(tie(cube, {{-1, 0.5, 1.5}, {1, 0, 0}}));
    const Shape cone = Tgc{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}};
    CHECK(tie(cone, {{-1, 0, 1}, {1, 0, 0}}));
    CHECK_FALSE(tie(cone, {{0, 0, 3}, {0, 0, -1}}));
    const Shape half = Half{{{0.6, 0.8, 0}, 0}};
    CHECK(tie(half, {{0, 0, 0}, {0, 0, 1}}));
    CHECK_FALSE(tie(half, {{1, 1, 0}, {0.8, -0.6, 0}}));  // parallel up to the rounding of 0.6 and 0.8, outside
    CHECK(intersect(implicit(half, to_affine(identity)), {{1, 1, 0}, {0.8, -0.6, 0}}).intervals.empty());
    CHECK(tie(half, {{1, 1, 0}, {0.8, -0.6 - 1e-15, 0}}));  // some roundings off: may meet far away
    CHECK_FALSE(tie(half, {{1, 1, 0}, {0, 0, 1}}));
}

TEST_CASE("judge: decided rays keep their count when their last bits change", "[oracle]") {
    Random random(12);
    for (const Kind kind : kinds)
        for (std::size_t i = 0; i < 40; ++i) {
            const Case one = make_case(kind, i, random);
            const ImplicitSolid solid = implicit(one.shape, one.matrix);
            RayMaker maker(one.shape, solid, random);
            for (std::size_t k = 0; k < 28; ++k) {
                const Ray ray = maker.make(static_cast<RayFamily>(k % ray_families));
                const Answer answer = intersect(solid, ray);
                if (answer.tie) continue;
                const Answer near = intersect(solid, nudged(ray, solid.size, !solid.bounded, random));
                INFO(one.name << "\n"
                              << describe(one.shape, one.matrix) << "\n"
                              << describe(ray) << "\n"
                              << describe(answer));
                REQUIRE(near.intervals.size() == answer.intervals.size());
                for (std::size_t n = 0; n < near.intervals.size(); ++n)
                    if (std::isfinite(near.intervals[n].in.t))
                        CHECK(std::abs(near.intervals[n].in.t - answer.intervals[n].in.t) <=
                              answer.intervals[n].in.tolerance);
            }
        }
}

TEST_CASE("judge: planted faults are found", "[oracle]") {
    const auto drop = [](const Ray&, std::vector<Segment>& s) {
        if (!s.empty()) s.pop_back();
    };
    const auto add = [](const Ray&, std::vector<Segment>& s) {
        const double t = s.empty() ? 0 : s.back().out;
        if (std::isfinite(t)) s.push_back({t + 1e-9, t + 1e-6, {1, 0, 0}, {1, 0, 0}});
    };
    const auto flip = [](const Ray&, std::vector<Segment>& s) {
        for (Segment& one : s) one.out_normal = {-one.out_normal.x, -one.out_normal.y, -one.out_normal.z};
    };
    const auto stretch = [](const Ray&, std::vector<Segment>& s) {
        for (Segment& one : s) one.in_normal.x *= 1 + 1e-9, one.in_normal.y *= 1 + 1e-9, one.in_normal.z *= 1 + 1e-9;
    };
    const auto shift = [](const Ray& ray, std::vector<Segment>& s) {
        const double speed = std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
        for (Segment& one : s) one.in += std::isinf(one.in) ? 0 : 1e-6 * (std::abs(one.in) + 1 / speed);
    };
    const auto swap = [](const Ray&, std::vector<Segment>& s) {
        for (Segment& one : s) std::swap(one.in, one.out);
    };
    const auto nan = [](const Ray&, std::vector<Segment>& s) {
        for (Segment& one : s) one.out = std::numeric_limits<double>::quiet_NaN();
    };
    const auto wrong = [&](Kind kind, const auto& spoil, const auto& change) {
        const Campaign c = run_campaign(kind, 147, 13, spoiled(spoil, change));
        return static_cast<double>(c.total().wrong) /
               static_cast<double>(c.total().hits);  // ties are judged less strictly
    };
    for (const Kind kind : kinds) {
        INFO(static_cast<int>(kind));
        const double most = kind == Kind::half ? 0.3 : 0.5;  // of the rays that hit; a half-space has ends at infinity
        CHECK(wrong(kind, leave, as_it_is) == 0);
        CHECK(wrong(kind, drop, as_it_is) > 0.7);
        CHECK(wrong(kind, add, as_it_is) > most);
        CHECK(wrong(kind, flip, as_it_is) > most);
        CHECK(wrong(kind, stretch, as_it_is) > most);
        CHECK(wrong(kind, shift, as_it_is) > most);
        CHECK(wrong(kind, swap, as_it_is) > most);
        CHECK(wrong(kind, nan, as_it_is) > most);
    }
}

TEST_CASE("judge: a solid that is off by a part in 10^9 is found", "[oracle]") {
    constexpr double grown = 1 + 1e-9;
    const auto change = [](Shape shape) {
        if (auto* ell = std::get_if<Ell>(&shape)) ell->a.x *= grown, ell->a.y *= grown, ell->a.z *= grown;
        if (auto* tgc = std::get_if<Tgc>(&shape)) tgc->h.x *= grown, tgc->h.y *= grown, tgc->h.z *= grown;
        if (auto* tor = std::get_if<Tor>(&shape)) tor->r_h *= tor->r_h < tor->r_a ? grown : 1 / grown;
        if (auto* ehy = std::get_if<Ehy>(&shape)) ehy->c *= 1 + 1e-8;
        if (auto* arbn = std::get_if<Arbn>(&shape)) arbn->planes[0].distance += 1e-9;
        return shape;
    };
    for (const Kind kind : {Kind::ell, Kind::tgc, Kind::tor, Kind::ehy, Kind::arbn}) {
        const Campaign c = run_campaign(kind, 588, 14, spoiled(leave, change));
        INFO(static_cast<int>(kind));
        CHECK(c.total().wrong > c.total().hits / 10);
    }
}
