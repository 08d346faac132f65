// Interval arithmetic and the functions of solids along rays.
#include <cmath>

#include "bench/methods/interval.hpp"
#include "bench/methods/ray_forms.hpp"
#include "bench/methods/scene_rays.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "method_solids.hpp"

using namespace csgrt;
using namespace csgrt::bench;

TEST_CASE("an interval's result holds every result of its numbers, in more digits than they have") {
    std::mt19937_64 random(7);
    const auto number = [&] {
        const double part = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
        return std::ldexp(part, static_cast<int>(random() % 40) - 20);
    };
    std::size_t rounded = 0;
    for (int i = 0; i < 20000; ++i) {
        const double a0 = number(), a1 = number(), b0 = number(), b1 = number();
        const Interval a(std::min(a0, a1), std::max(a0, a1)), b(std::min(b0, b1), std::max(b0, b1));
        const double part = static_cast<double>(random() >> 11) * 0x1p-53;
        const double x = std::clamp(a.low + part * (a.high - a.low), a.low, a.high);
        const double y = std::clamp(b.low + (1 - part) * (b.high - b.low), b.low, b.high);
        const auto holds = [](const Interval& in, long double exact) { return in.low <= exact && exact <= in.high; };
        const long double lx = x, ly = y;
        REQUIRE(holds(a + b, lx + ly));
        REQUIRE(holds(a - b, lx - ly));
        REQUIRE(holds(a * b, lx * ly));
        REQUIRE(holds(square(a), lx * lx));
        REQUIRE(holds(power(size_of(a), 1.7), std::pow(std::abs(lx), 1.7L)));
        REQUIRE(holds(Interval(x) * Interval(y), lx * ly));
        rounded += static_cast<long double>(x * y) != lx * ly;
    }
    CHECK(rounded > 10000);  // where outward rounding is needed
}

TEST_CASE("a polynomial's range on a piece holds its values, and is not much wider") {
    Polynomial f;  // (u - 1) (u - 2) (u - 3) (u - 4)
    f.degree = 4;
    const double c[] = {24, -50, 35, -10, 1};
    for (int i = 0; i <= 4; ++i) f.c[i] = Interval(c[i]);
    for (double at = 0; at < 5; at += 0.125) {
        const Interval range = f.over({at, at + 0.125});
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (double u = at; u <= at + 0.125; u += 0.0078125) {
            const double value = (u - 1) * (u - 2) * (u - 3) * (u - 4);
            low = std::min(low, value);
            high = std::max(high, value);
            REQUIRE(range.low <= value + 1e-12);
            REQUIRE(value - 1e-12 <= range.high);
        }
        CHECK(range.high - range.low < 1.2 * (high - low) + 0.5);
    }
}

TEST_CASE("what a solid's form calls outside or inside is so by the library's segments, and it is called so nearby") {
    const CompiledScene scene = compile(test::closed_forms(true));
    REQUIRE(type_without_form(scene).empty());
    const SceneRays rays(scene);
    std::mt19937_64 random(11);
    RayForm form;
    std::vector<kernel::Boundary> boundaries;
    for (std::uint32_t solid = 0; solid < scene.solids.size(); ++solid) {
        CAPTURE(type_name(scene.solids[solid].type), solid);
        std::size_t met = 0, undecided = 0, decided = 0;
        for (int i = 0; i < 400; ++i) {
            const Vec3 a = test::point_near(scene.solid_boxes[solid], random);
            const Vec3 b = test::point_near(scene.solid_boxes[solid], random);
            const Ray ray{a, {b.x - a.x, b.y - a.y, b.z - a.z}};
            boundaries.clear();
            rays.append_boundaries(solid, ray, -HUGE_VAL, boundaries);
            met += !boundaries.empty();
            form.set(scene, solid, ray);
            for (int k = 0; k < 16; ++k) {
                const double width = k % 2 ? 1e-4 : 0.3;
                const double from = static_cast<double>(random() >> 11) * 0x1p-52 - 0.5, to = from + width;
                double inside = 0;
                bool near = false;
                for (std::size_t e = 0; e < boundaries.size(); e += 2) {
                    inside += std::max(0.0, std::min(to, boundaries[e + 1].t) - std::max(from, boundaries[e].t));
                    for (std::size_t side = e; side < e + 2; ++side)
                        near = near || (boundaries[side].t > from - 0.01 && boundaries[side].t < to + 0.01);
                }
                const int sign = form.sign(from, to);
                if (sign > 0) REQUIRE(inside < 1e-9);
                if (sign < 0) REQUIRE(inside > width - 1e-9);
                if (k % 2 && !near) ++(sign == 0 ? undecided : decided);
            }
        }
        CHECK(met > 40);
        CHECK(undecided * 50 < decided);  // it grazes some
    }
}

TEST_CASE("solids without a form are named") {
    Scene scene = test::closed_forms(false);
    CHECK(type_without_form(compile(scene)).empty());
    Metaball blob;
    blob.points = {{{}, 1, 0}};
    scene.objects.emplace_back(test::solid("blob", blob));
    scene.objects.emplace_back(test::region("r.blob", {test::leg("blob")}));
    CHECK(type_without_form(compile(scene)) == "metaball");
}
