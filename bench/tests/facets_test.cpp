// The laboratory's meshes of solids: closed, turned outward, and as near to the surface as is asked for.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "bench/methods/facets.hpp"
#include "catch.hpp"
#include "scene/vector.hpp"
#include "stress/random.hpp"

using namespace csgrt;
using namespace csgrt::bench;

namespace {

constexpr double pi = std::numbers::pi;
const Matrix placed = {0.8, -0.6, 0, 5, 0.6, 0.8, 0.3, -2, 0, 0, 1.5, 1, 0, 0, 0, 1};  // turned, sheared, stretched

struct Case {
    std::string name;
    Shape shape;
};
const std::vector<Case>& curved() {
    static const std::vector<Case> all = {
        {"ell", Ell{{1, 2, 3}, {10, 0, 0}, {0, 4, 0}, {0, 0, 2}}},
        {"cylinder", Tgc{{0, 0, 0}, {0, 0, 9}, {3, 0, 0}, {0, 3, 0}, {3, 0, 0}, {0, 3, 0}}},
        {"cone", Tgc{{0, 0, 0}, {1, 0, 9}, {5, 0, 0}, {0, 3, 0}, {0, 0, 0}, {0, 0, 0}}},
        {"other ellipse above", Tgc{{0, 0, 0}, {0, 0, 9}, {6, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 5, 0}}},
        {"edge above", Tgc{{0, 0, 0}, {0, 0, 9}, {6, 0, 0}, {0, 2, 0}, {4, 0, 0}, {0, 0, 0}}},
        {"tor", Tor{{0, 1, 0}, {1, 1, 1}, 8, 3}},
        {"eto", Eto{{0, 1, 0}, {0, 0, 2}, {2, 0, 3}, 8, 1}},
        {"ehy", Ehy{{0, 0, 0}, {0, 0, 7}, {1, 0, 0}, 4, 2, 1.5}},
        {"epa", Epa{{0, 0, 0}, {0, 0, 7}, {1, 0, 0}, 4, 2}},
        {"hyp", Hyp{{0, 0, 0}, {0, 0, 7}, {4, 0, 0}, 3, 0.4}},
        {"part", Part{{0, 0, 0}, {0, 5, 7}, 3, 1}},
        {"part with a tip", Part{{0, 0, 0}, {0, 5, 7}, 3, 0}},
        {"part that is a ball", Part{{0, 0, 0}, {0, 1, 0}, 1, 3}},
        {"rpc", Rpc{{0, 0, 0}, {0, 0, 7}, {0, 5, 0}, 3}},
        {"rhc", Rhc{{0, 0, 0}, {0, 0, 7}, {0, 5, 0}, 3, 1}},
        {"superell", Superell{{0, 0, 0}, {5, 0, 0}, {0, 4, 0}, {0, 0, 3}, 0.4, 1.5}},
    };
    return all;
}
const std::vector<Case>& flat() {
    static const std::vector<Case> all = {
        {"half", Half{{{0, 0.6, 0.8}, 2}}},
        {"arb8", Arb{{{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}}}}},
        {"arb4", Arb{{{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {2, 3, 0}, {0, 0, 4}, {0, 0, 4}, {0, 0, 4}, {0, 0, 4}}}}},
        {"arb6", Arb{{{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {1, 0, 4}, {1, 0, 4}, {1, 3, 4}, {1, 3, 4}}}}},
        {"arbn", Arbn{{{{1, 0, 0}, 2},
                       {{-1, 0, 0}, 2},
                       {{0, 1, 0}, 2},
                       {{0, -1, 0}, 2},
                       {{0, 0, 1}, 2},
                       {{0, 0, -1}, 2},
                       {{0.6, 0.8, 0}, 2},
                       {{0.6, 0, 0.8}, 2.4}}}},
        {"bot", Bot{Bot::Mode::volume,
                    Bot::Orientation::unoriented,
                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}},
    };
    return all;
}
const FacetOptions to(double chord) { return {chord, {{-60, -60, -60}, {60, 60, 60}}, 1'000'000}; }

Scene scene_of(const Shape& shape) {
    Scene scene;
    scene.objects.push_back(Solid{"s", shape, {}});
    Combination all;
    all.name = "r";
    all.region = true;
    all.tree.nodes.push_back({Operator::leaf, 0, "s", placed, {}});
    scene.objects.emplace_back(all);
    return scene;
}

/// The largest distance, along the triangle's normal, between a triangle's points and the surface that csgrt's
/// reference finds.
double error_of(const Triangles& mesh, const Shape& shape) {
    stress::Random random(7);
    std::vector<Ray> rays;
    const std::size_t stride = 1 + mesh.faces.size() / 400;
    for (std::size_t i = 0; i < mesh.faces.size(); i += stride) {
        const auto& f = mesh.faces[i];
        const Vec3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
        const Vec3 normal = cross(b - a, c - a);
        if (length(normal) < 1e-6) continue;  // it has no direction to look in
        double u = random.between(0, 1), v = random.between(0, 1);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        for (const auto& [s, t] : {std::pair{1 / 3.0, 1 / 3.0}, {0.49, 0.49}, {0.02, 0.49}, {0.49, 0.02}, {u, v}})
            rays.push_back({a + s * (b - a) + t * (c - a) + 1000 * unit(normal), -1 * unit(normal)});
    }
    Settings settings;
    settings.reference = true;
    const Scene scene = scene_of(shape);
    double worst = 0;
    for (const RayPartitions& found : Renderer(scene, {}, settings).shoot(rays)) {
        double nearest = 1e9;
        for (const Partition& p : found.partitions)
            nearest = std::min({nearest, std::abs(p.in - 1000), std::abs(p.out - 1000)});
        worst = std::max(worst, nearest);
    }
    return worst;
}

}  // namespace

TEST_CASE("meshes of solids are closed, turned outward, and within the error that is asked for") {
    for (const Case& c : curved())
        for (const double chord : {0.3, 0.03}) {
            CAPTURE(c.name, chord);
            const Triangles mesh = facets(c.shape, placed, to(chord));
            CHECK(is_closed(mesh));
            CHECK(volume(mesh) > 0);
            const double error = error_of(mesh, c.shape);
            CAPTURE(mesh.faces.size(), error);
            CHECK(error < 1.02 * chord + 1e-9);
            CHECK(error > 0.1 * chord);  // no finer than need be
        }
    for (const Case& c : flat()) {
        CAPTURE(c.name);
        const Triangles mesh = facets(c.shape, placed, to(1));
        CHECK(is_closed(mesh));
        CHECK(volume(mesh) > 0);
        if (c.name != "half") CHECK(error_of(mesh, c.shape) < 1e-9);
    }
}

TEST_CASE("volumes of meshes converge to those of their solids") {
    const double determinant = 1.5;  // of `placed`: (0.64 + 0.36) 1.5
    const auto relative = [&](const Shape& shape, double chord, double exact) {
        return std::abs(volume(facets(shape, placed, to(chord))) / (determinant * exact) - 1);
    };
    const Shape ball = Ell{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
    const Shape ring = Tor{{0, 0, 0}, {0, 0, 1}, 8, 2};
    const double in_ball = 4 * pi / 3 * 125, in_ring = 2 * pi * pi * 8 * 4;
    CHECK(relative(ball, 0.001, in_ball) < 0.001);
    CHECK(relative(ring, 0.001, in_ring) < 0.001);
    CHECK(relative(ball, 0.1, in_ball) > 10 * relative(ball, 0.001, in_ball));
    CHECK(relative(ring, 0.1, in_ring) > 10 * relative(ring, 0.001, in_ring));
}

TEST_CASE("what cannot be a mesh is refused in words") {
    CHECK_THROWS_WITH(facets(Hrt{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1}, identity, to(1)), ContainsSubstring("hrt"));
    CHECK_THROWS_WITH(
        facets(Bot{Bot::Mode::surface, {}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, identity, to(1)),
        ContainsSubstring("without an inside"));
    CHECK_THROWS_WITH(facets(Ell{{}, {50, 0, 0}, {0, 50, 0}, {0, 0, 50}}, identity, to(1e-6)),
                      ContainsSubstring("more triangles than there may be"));
}
