// The judge of arbs that are not convex, judged: by a membership function that shares no triangles with it, and by arbs
// that are convex. The intersection of the half-spaces that its faces bound is no answer.
#include "catch.hpp"

#include "oracle/concave_arb.hpp"
#include "oracle/intersect.hpp"
#include "oracle/mesh_answer.hpp"
#include "oracle/mesh_judge.hpp"
#include "oracle/rays.hpp"
#include "oracle/scene_solid.hpp"
#include "oracle/shapes.hpp"
#include "oracle/solids/all.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

const Arb dart{{{{0, 0, 0}, {10, 0, 0}, {3, 3, 0}, {0, 10, 0}, {0, 0, 5}, {10, 0, 5}, {3, 3, 5}, {0, 10, 5}}}};

/// The planes of the faces, outward as seen from the mean of the vertices.
Arbn half_spaces_of(const Arb& arb) {
    QVec mean;
    for (const Vec3& vertex : arb.vertices) mean = mean + quad(0.125) * QVec(vertex);
    Arbn arbn;
    for (const ArbOutline& face : outlines_of(arb)) {
        const QVec n = dot(face.normal, face.on - mean) < 0 ? -face.normal : face.normal;
        arbn.planes.push_back({to_vec3(n), to_double(dot(n, face.on))});
    }
    return arbn;
}

std::vector<Segment> segments_of(const Answer& answer) {
    std::vector<Segment> segments;
    for (const Interval& i : answer.intervals) segments.push_back({i.in.t, i.out.t, i.in.normal, i.out.normal});
    return segments;
}

/// A dart whose reflex vertex lies anywhere in the triangle of the others, drawn out to a prism that leans.
Arb some_dart(Random& random) {
    const double u = random.between(0.05, 0.9), v = random.between(0.05, 0.95) * (1 - u);
    const auto somewhere = [&] { return to_vec3(random.in_cube()); };
    const Vec3 a = somewhere(), b = somewhere(), c = somewhere(), h = somewhere();
    const auto mix = [&](double Vec3::*k) { return a.*k + v * (b.*k - a.*k) + (1 - u - v) * (c.*k - a.*k); };
    const std::array<Vec3, 4> base{a, b, {mix(&Vec3::x), mix(&Vec3::y), mix(&Vec3::z)}, c};
    Arb arb;
    for (std::size_t i = 0; i < 4; ++i) {
        arb.vertices[i] = base[i];
        arb.vertices[i + 4] = {base[i].x + h.x, base[i].y + h.y, base[i].z + h.z};
    }
    return arb;
}

}  // namespace

TEST_CASE("oracle: a dart is what its faces enclose, and its half-spaces are rejected", "[oracle]") {
    REQUIRE(is_concave(dart));
    CHECK_THROWS_AS(implicit(dart, identity), std::invalid_argument);
    const SceneSolid solid = scene_solid(dart, QAffine{}, 0, false);
    const Parts parts = parts_of(dart);
    const MeshSurface surface = parts.surface(identity);
    const ImplicitSolid half_spaces = implicit(half_spaces_of(dart), identity);
    struct Known {
        double x, y;
        bool inside;
    };
    for (const Known& k :
         {Known{8, 0.5, true}, Known{0.5, 8, true}, Known{2, 2.25, true}, Known{5, 5, false}, Known{3.5, 3.5, false}}) {
        INFO(k.x << " " << k.y);
        const Ray ray{{k.x, k.y, -10}, {0, 0, 1}};
        CHECK(contains(dart, {k.x, k.y, 2.5}) == k.inside);
        const Answer answer = solid(ray);
        CHECK_FALSE(answer.tie);
        REQUIRE(answer.intervals.size() == (k.inside ? 1 : 0));
        if (k.inside) {
            CHECK(answer.intervals[0].in.t == 10);
            CHECK(answer.intervals[0].out.t == 15);
        }
        CHECK(MeshJudge(surface, ray).judge(segments_of(answer)).wrong.empty());
        CHECK_FALSE(MeshJudge(surface, ray).judge(segments_of(intersect(half_spaces, ray))).wrong.empty());
    }
}

TEST_CASE("oracle: darts of any shape hold the points that their membership function says", "[oracle]") {
    Random random(81);
    std::size_t inside = 0, rejected = 0, decided = 0;
    for (int i = 0; i < 60; ++i) {
        const Arb arb = some_dart(random);
        REQUIRE(is_concave(arb));
        const SceneSolid solid = scene_solid(arb, QAffine{}, 0, false);
        const MeshSurface surface = parts_of(arb).surface(identity);
        const ImplicitSolid half_spaces = implicit(half_spaces_of(arb), identity);
        for (int k = 0; k < 20; ++k) {
            const QVec p = random.in_cube(), d = random.direction();
            const Ray ray{to_vec3(p - quad(5) * d), to_vec3(d)};
            const Answer answer = solid(ray);
            if (answer.tie) continue;
            ++decided;
            // Between two ends, and beside the outer ones, membership does not change.
            std::vector<double> ends{0};
            for (const Interval& met : answer.intervals) ends.push_back(met.in.t), ends.push_back(met.out.t);
            ends.push_back(10);
            for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
                const QVec middle = QVec(ray.origin) + quad(0.5 * (ends[e] + ends[e + 1])) * QVec(ray.direction);
                CHECK(contains(arb, middle) == (e % 2 == 1));
                inside += e % 2;
            }
            rejected += !MeshJudge(surface, ray).judge(segments_of(intersect(half_spaces, ray))).wrong.empty();
        }
    }
    CHECK(decided > 1000);
    CHECK(inside > 100);
    CHECK(rejected > 100);
}

TEST_CASE("oracle: the polyhedron of a convex arb's faces is the intersection of their half-spaces", "[oracle]") {
    Random random(82);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < 120; ++i) {
        const Case one = make_case(Kind::arb, i, random);
        const Arb& arb = std::get<Arb>(one.shape);
        CHECK_FALSE(is_concave(arb));
        const ImplicitSolid solid = implicit(one.shape, one.matrix);
        const MeshSolid faces(parts_of(arb), to_affine(one.matrix));
        RayMaker rays(one.shape, solid, random);
        for (int k = 0; k < 12; ++k) {
            const Ray ray = rays.make(RayFamily::ordinary);
            const Answer a = intersect(solid, ray), b = faces.along(ray);
            if (a.tie || b.tie) continue;
            REQUIRE(a.intervals.size() == b.intervals.size());
            if (a.intervals.empty()) continue;
            ++hits;
            CHECK(std::abs(a.intervals[0].in.t - b.intervals[0].in.t) <=
                  a.intervals[0].in.tolerance + b.intervals[0].in.tolerance);
            CHECK(std::abs(a.intervals[0].out.t - b.intervals[0].out.t) <=
                  a.intervals[0].out.tolerance + b.intervals[0].out.tolerance);
        }
    }
    CHECK(hits > 300);
}
