// The methods whose error is turned by a knob: the finest is right where the coarsest is not, a wrong operator is seen,
// and what they cannot do they say.
#include <cmath>

#include <csgrt/csgrt.hpp>

#include "bench/chart/truth.hpp"
#include "bench/methods/list.hpp"
#include "bench/methods/stretches.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "method_solids.hpp"

using namespace csgrt;
using namespace csgrt::bench;
using test::ball, test::leg, test::less, test::region;

namespace {

/// A plate of 0.004 behind a shell whose hollow is opened by a cylinder, and a ball that sticks out of a block.
Scene small() {
    return test::scene({test::block("plate", {-4, 3, -4}, {4, 3.004, 4}), ball("outer", {}, 2), ball("inner", {}, 1.9),
                        test::solid("drill", Tgc{{0, 0, -3}, {0, 0, 6}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}}),
                        test::block("block", {-4, 5, -4}, {4, 7, 4}), ball("knob", {2, 5, 2}, 1),
                        region("far", {leg("plate")}),
                        region("shell", {leg("outer"), leg("inner"), less, leg("drill"), less}),
                        region("body", {leg("block"), leg("knob"), test::either})});
}

std::vector<Ray> grid() {
    std::vector<Ray> rays;
    for (int x = -20; x <= 20; ++x)
        for (int z = -20; z <= 20; ++z)
            rays.push_back({{0.1923 * x + 0.011, -20, 0.1977 * z + 0.007}, {0.01, 2, 0.02}});
    return rays;
}

TraceOptions with_knob(double knob) {
    TraceOptions options;
    options.knob = knob;
    return options;
}

struct Judged {
    std::size_t decided = 0, wrong = 0, answered = 0;
    double error_mm = 0;
};

/// A scene, rays, and what they meet by 113-bit arithmetic.
struct Trial {
    Scene scene;
    std::vector<Ray> rays;
    std::vector<std::string> objects = {};
    CompiledScene compiled = compile(scene);
    std::vector<TrueRay> truth = true_rays(scene, objects, rays);

    std::unique_ptr<Tracer> prepare(const Method& method, const TraceOptions& options) const {
        return method.prepare({scene, objects, compiled}, options);
    }
};

Judged judge(const Method& method, const Trial& trial, const TraceOptions& options) {
    const std::vector<Ray>& rays = trial.rays;
    const std::vector<TrueRay>& truth = trial.truth;
    const auto tracer = trial.prepare(method, options);
    const std::vector<Answer> answers = tracer->trace(rays);
    REQUIRE(answers.size() == rays.size());
    CHECK(tracer->seconds() > 0);
    Judged j;
    Accuracy all;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        j.answered += answers[i].answered;
        if (!answers[i].answered) continue;
        const Sequence found = joined(answers[i].stretches);
        if (!options.first_hits) {
            all.add(truth[i], found);
            continue;
        }
        if (truth[i].verdict != TrueRay::Verdict::decided) continue;
        ++j.decided;
        const Sequence& should = truth[i].sequence;
        const bool same = found.empty() ? should.empty()
                                        : !should.empty() && found.front().region == should.front().region &&
                                              std::abs(found.front().in - should.front().in) < 0.1;
        j.wrong += !same;
    }
    if (!options.first_hits) {
        j.decided = all.decided;
        j.wrong = all.wrong;
        j.error_mm = all.error_mm.quantile(0.5);
    }
    return j;
}

}  // namespace

TEST_CASE("with a finer knob a method is right, with a coarser one it is not, and one wrong operator is seen") {
    const Trial trial{small(), grid()};
    for (const Method& method : {kensler(), bisection(), sphere_tracing(), depth_buffer()}) {
        CAPTURE(method.name);
        TraceOptions options;
        options.knob = method.knob_values.back();
        const Judged fine = judge(method, trial, options);
        CHECK(fine.decided > 1600);
        CHECK(fine.wrong * 500 <= fine.decided);
        CHECK(fine.answered == trial.rays.size());
        CHECK(fine.error_mm < 1e-4);
        options.first_hits = true;
        CHECK(judge(method, trial, options).wrong * 500 <= fine.decided);
        options.first_hits = false;
        options.planted = true;
        CHECK(judge(method, trial, options).wrong > 100);
        options.planted = false;
        options.knob = method.name == "depth buffer" ? 10 : method.knob_values.front();
        CHECK(judge(method, trial, options).wrong > 100);
    }
}

TEST_CASE("the answer does not depend on the number of threads") {
    const Scene scene = small();
    const std::vector<Ray> rays = grid();
    const std::vector<std::string> objects;
    const CompiledScene compiled = compile(scene);
    for (const Method& method : {kensler(), bisection(), sphere_tracing(), depth_buffer()}) {
        CAPTURE(method.name);
        TraceOptions options;
        options.knob = method.knob_values[1];
        options.threads = 1;
        const std::vector<Answer> one = method.prepare({scene, objects, compiled}, options)->trace(rays);
        options.threads = 3;
        const std::vector<Answer> three = method.prepare({scene, objects, compiled}, options)->trace(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) REQUIRE(one[i].stretches == three[i].stretches);
    }
}

TEST_CASE("every solid with a closed form is met by every method as by the library") {
    const Scene scene = test::closed_forms(false);
    const CompiledScene compiled = compile(scene);
    std::mt19937_64 random(3);
    std::vector<Ray> rays;
    for (const Box& box : compiled.solid_boxes)
        for (int i = 0; i < 20; ++i) {
            const Vec3 a = test::point_near(box, random), b = test::point_near(box, random);
            rays.push_back({a, {b.x - a.x, b.y - a.y, b.z - a.z}});
        }
    const Trial trial{scene, rays};
    for (const Method& method : {kensler(), bisection(), sphere_tracing(), depth_buffer()}) {
        CAPTURE(method.name);
        TraceOptions options;
        options.knob = method.knob_values.back();
        const Judged fine = judge(method, trial, options);
        CHECK(fine.answered == trial.rays.size());
        CHECK(fine.wrong == 0);
        CHECK(fine.error_mm < 1e-4);
    }
}

TEST_CASE("a method that searches refuses a solid without what it needs, by its type") {
    const Scene scene = test::closed_forms(true);
    const std::vector<std::string> objects;
    const CompiledScene compiled = compile(scene);
    const std::string said = test::error_of([&] {
        sphere_tracing().prepare({scene, objects, compiled}, with_knob(1e-3));
    });
    CHECK(test::says(said, "sphere tracing"));
    CHECK(test::says(said, "hrt"));
    CHECK(test::says(test::error_of([&] {
                         bisection().prepare({scene, objects, compiled}, with_knob(60));
                     }),
                     "48 bits"));
    CHECK(test::says(test::error_of([&] {
                         depth_buffer().prepare({scene, objects, compiled}, with_knob(40));
                     }),
                     "32 bits"));
}

TEST_CASE("a tree that is too deep for a method's stack, or too long for its normal form, is given up, not wrong") {
    // ((s0 + s1 - s2) + s3 - s4) ..., all on one ray; the last is a union.
    constexpr int links = 2401;
    Scene scene;
    std::vector<TreeNode> nodes;
    for (int i = 0; i <= links; ++i) {
        const std::string name = "s" + std::to_string(i);
        scene.objects.emplace_back(test::block(name, {static_cast<double>(i), -1, -1}, {i + 1.5, 1, 1}));
        nodes.push_back(leg(name));
        if (i > 0) nodes.push_back(i % 2 ? test::either : less);
    }
    scene.objects.emplace_back(region("r", nodes));
    const std::vector<std::string> objects;
    const CompiledScene compiled = compile(scene);
    const std::vector<Ray> ray{{{-1, 0, 0}, {1, 0, 0}}};
    TraceOptions options = with_knob(1e-8);
    CHECK_FALSE(kensler().prepare({scene, objects, compiled}, options)->trace(ray)[0].answered);
    options.knob = 32;
    const Answer layers = depth_buffer().prepare({scene, objects, compiled}, options)->trace(ray)[0];
    CHECK(layers.answered);
    CHECK(layers.stretches.size() == (links + 1) / 2);  // each odd one, and s0 before the first
    options.first_hits = true;
    CHECK_FALSE(depth_buffer().prepare({scene, objects, compiled}, options)->trace(ray)[0].answered);
}

TEST_CASE("bisection certifies a miss that it may") {
    const Scene scene = test::scene({ball("b"), region("r", {leg("b")})});
    const std::vector<std::string> objects;
    const CompiledScene compiled = compile(scene);
    const auto tracer = bisection().prepare({scene, objects, compiled}, with_knob(24));
    const auto certified = [&](double x) {
        tracer->trace({{{x, -5, 0}, {0, 1, 0}}});
        return std::pair(tracer->figures().at("misses, share of rays"),
                         tracer->figures().at("certified misses, share of rays"));
    };
    CHECK(certified(0.5) == std::pair(0.0, 0.0));
    CHECK(certified(1 + 1e-6) == std::pair(1.0, 1.0));
    CHECK(certified(3) == std::pair(1.0, 1.0));
}

TEST_CASE("of regions in one place the least has it; ends within epsilon are one") {
    const std::vector<Stretch> claimed = {{2, 1, 5}, {1, 3, 4}, {4, 5.001, 6}, {3, 7, 7.001}};
    CHECK(owners(claimed, 0, false) == Sequence{{2, 1, 3}, {1, 3, 4}, {2, 4, 5}, {4, 5.001, 6}, {3, 7, 7.001}});
    CHECK(owners(claimed, 0.01, false) == Sequence{{2, 1, 3}, {1, 3, 4}, {2, 4, 5}, {4, 5, 6}});
    CHECK(owners({{0, -3, -1}, {1, -1, 2}, {0, 2, 3}}, 0, true) == Sequence{{1, -1, 2}});
    CHECK(owners({}, 0, false).empty());
}
