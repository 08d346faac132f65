// The verifier through the library.
#include <csgrt/verify.hpp>

#include <cmath>

#include "base/laboratory.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

Scene ball(Vec3 center) {
    Scene scene;
    scene.objects.push_back(test::ball("ball.s", center, 10));
    return scene;
}

Settings on_reference() { return {.reference = true}; }

bool same(const Ray& a, const Ray& b) { return a.origin == b.origin && a.direction == b.direction; }

}  // namespace

TEST_CASE("a sample is half a view and half random, and the seed decides it", "[promise:verify]") {
    const Scene scene = ball({0, 0, 0});
    const Verifier verifier(scene, {}, on_reference());
    const std::vector<Ray> rays = verifier.sample(scene.camera, 50, 7);
    REQUIRE(rays.size() == 50);
    const std::vector<Ray> view =
        verifier.renderer().model().grid_of({.width = 5, .height = 5, .camera = scene.camera}).rays();
    REQUIRE(view.size() == 25);
    for (std::size_t i = 0; i < view.size(); ++i) CHECK(same(rays[i], view[i]));
    const std::vector<Ray> again = verifier.sample(scene.camera, 50, 7), other = verifier.sample(scene.camera, 50, 8);
    for (std::size_t i = 0; i < rays.size(); ++i) CHECK(same(rays[i], again[i]));
    for (std::size_t i = view.size(); i < rays.size(); ++i) CHECK(!same(rays[i], other[i]));
    for (std::size_t i = view.size(); i < rays.size(); ++i)  // from outside the box
        CHECK(std::hypot(rays[i].origin.x, rays[i].origin.y, rays[i].origin.z) > 10 * std::sqrt(3.0));
    CHECK(verifier.sample(scene.camera, 1).size() == 1);
}

TEST_CASE("what ends where the ray starts may be there or not") {
    Scene scene;
    scene.objects.push_back(test::ball("ball.s", {0, 0, 0}, 0.5));
    Verifier verifier(scene, {}, on_reference());
    const Ray leaving{{0.5, 0, 0}, {1, 0, 0}};
    REQUIRE(Renderer(scene, {}, on_reference()).shoot({leaving})[0].partitions.size() == 1);
    verifier.shoot({leaving, {{0.3, 0.4, 0}, {3, 4, 0}}, {{0.5, 0, 0}, {-1, 0, 0}}});
    CHECK(verifier.result().decided == 3);
    CHECK(verifier.result().passed());
}

TEST_CASE("what is shot in parts adds up", "[promise:verify]") {
    const Scene scene = ball({7e7 + 0.3, -7e7 - 0.7, 1e7});
    const Settings settings = with_methods({.single_world = true}, on_reference());
    Verifier whole(scene, {}, settings), parts(scene, {}, settings);
    const std::vector<Ray> rays = whole.sample(scene.camera, 200);
    whole.shoot(rays);
    parts.shoot({rays.begin(), rays.begin() + 80});
    parts.shoot({rays.begin() + 80, rays.end()});
    const Verification &a = whole.result(), &b = parts.result();
    CHECK(a.rays == 200);
    CHECK(a.hits > 50);
    CHECK(a.decided + a.ties == 200);
    CHECK(a.wrong > 0);
    CHECK(!a.passed());
    CHECK(a.bit_differences == 0);
    CHECK(a.hits == b.hits);
    CHECK(a.decided == b.decided);
    CHECK(a.wrong == b.wrong);
    CHECK(a.ends == b.ends);
    CHECK(a.worst.index == b.worst.index);
    REQUIRE(a.wrong_rays.size() == b.wrong_rays.size());
    for (std::size_t i = 0; i < a.wrong_rays.size(); ++i) {
        const WrongRay& wrong = a.wrong_rays[i];
        CHECK(wrong.index == b.wrong_rays[i].index);
        CHECK(same(wrong.ray, rays[wrong.index]));
        CHECK(wrong.on_reference);
        CHECK(!wrong.on_device);
        CHECK(wrong.difference.exact.size() + wrong.difference.found.size() == 1);
    }
}

TEST_CASE("distances are measured in what rounding must be expected to do", "[promise:verify]") {
    const Scene scene = ball({0, 0, 0});
    Settings settings = on_reference();
    Verifier twice(scene, {}, settings);
    settings.precision = Precision::single;
    Verifier once(scene, {}, settings);
    for (Verifier* verifier : {&twice, &once}) verifier->shoot(verifier->sample(scene.camera, 200));
    CHECK(twice.result().passed());
    CHECK(twice.result().ends == 2 * twice.result().hits);
    CHECK(twice.result().worst.ulps < 4);
    CHECK(once.result().passed());
    CHECK(once.result().worst.ulps > 1e6);  // 2^29 double ulps are one of single precision
    CHECK(once.result().farthest.millimetres > 1e-7);
    CHECK(once.result().farthest.millimetres < 1e-3);
}

TEST_CASE("what cannot be judged is refused, and progress can stop it", "[promise:verify]") {
    const Scene scene = ball({0, 0, 0});
    Settings settings = on_reference();
    settings.precision = Precision::quad;
    CHECK_THROWS_AS(Verifier(scene, {}, settings), Error);

    settings = on_reference();
    double last = 0;
    bool backwards = false;
    settings.progress = [&](double fraction) {
        backwards = backwards || fraction < last || fraction > 1;
        last = fraction;
        return fraction < 0.5;
    };
    Verifier verifier(scene, {}, settings);
    CHECK(test::thrown_by([&] { verifier.shoot(verifier.sample(scene.camera, 1000)); }).status == Status::interrupted);
    CHECK(last >= 0.5);
    CHECK(!backwards);
}
