// What each precision is worth: regions before the oracle from afar, and 113 bits against what is known exactly.
#include "catch.hpp"
#include "integration/lists.hpp"

#include <cmath>

#include <csgrt/csgrt.hpp>

#include "compile/records/converter.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/random.hpp"
#include "oracle/rays.hpp"
#include "oracle/scene_oracle.hpp"
#include "oracle/solids/all.hpp"
#include "integration/scenes.hpp"
#include "rays/frame.hpp"
#include "reference/reference_kernels.hpp"
#include "thrown.hpp"

using namespace csgrt;
using oracle::quad;
using oracle::QVec;

namespace {

const Settings in_double{}, in_single{.precision = Precision::single}, in_world = with_methods({.single_world = true}),
                                                                       in_quad{.precision = Precision::quad};

/// Rays through a box from `away` times its diagonal.
std::vector<Ray> rays_from(double away, const Box& box, std::size_t count) {
    oracle::Random random(31);
    const QVec low = box.low, high = box.high, center = quad(0.5) * (low + high), half = quad(0.5) * (high - low);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const QVec p = random.in_cube(), d = random.direction();
        const QVec through = center + QVec{half.x * p.x, half.y * p.y, half.z * p.z};
        rays.push_back({oracle::to_vec3(through - quad(2 * away) * oracle::length(half) * d), oracle::to_vec3(d)});
    }
    return rays;
}

struct Score {
    std::size_t decided = 0, wrong = 0;
};

/// How often the sequence of regions along a ray is not the oracle's, on rays that it can decide.
Score score(const Scene& scene, Settings settings, double away) {
    const oracle::SceneOracle judge(scene);
    settings.reference = true;
    settings.threads = 1;
    Renderer renderer(scene, {}, settings);
    const std::vector<Ray> rays = rays_from(away, renderer.model().bounds(), 800);
    const std::vector<RayPartitions> found = renderer.shoot(rays);
    Score score;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const oracle::SceneAnswer answer = judge.shoot(rays[i], 0.0005);
        std::vector<std::string> expected, seen;
        bool decided = !answer.tie;
        double end = 0;
        for (const oracle::Piece& piece : answer.pieces) {
            if (piece.claims.empty()) continue;
            decided = decided && piece.claims.size() == 1 && piece.claims[0].certain;
            const std::string& path = judge.regions()[piece.claims[0].region].path;
            if (expected.empty() || expected.back() != path || piece.in != end) expected.push_back(path);
            end = piece.out;
        }
        if (!decided) continue;
        for (const Partition& p : found[i].partitions) seen.push_back(renderer.model().regions()[p.region].path);
        ++score.decided;
        score.wrong += seen != expected;
    }
    INFO("from " << away << ": " << score.wrong << " wrong of " << score.decided);
    CHECK(score.decided > 200);
    return score;
}

}  // namespace

TEST_CASE(
    "single precision relative to the eye sees from afar what double sees; in the world's coordinates it does not",
    "[pipeline][oracle][promise:rounding]") {
    const std::string folder = test::folder("CSGRT_SCENES");
    if (folder.empty()) return;
    const Scene scene = load_scene(folder + "/gear.json");
    for (const double away : {3.0, 1e5}) {
        INFO("from " << away << " sizes");
        CHECK(score(scene, in_double, away).wrong == 0);
        CHECK(score(scene, in_single, away).wrong == 0);
        const Score world = score(scene, in_world, away);
        if (away > 100) CHECK(world.wrong * 100 > world.decided);
    }
    // The model far from the world's origin, the eye near it.
    const Scene far = load_scene(folder + "/far_origin.json");
    CHECK(score(far, in_single, 3).wrong == 0);
    CHECK(score(far, in_world, 3).wrong > 0);
}

TEST_CASE("113 bits give the true ends to the last bit of a double", "[geometry][promise:rounding]") {
    // Of these every parameter is exact, so that the oracle and the kernels speak of the same solid.
    const std::pair<const char*, Shape> solids[] = {
        {"sphere", Ell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {"torus", Tor{{0, 0, 0}, {0, 0, 1}, 1, 0.25}},
        {"superellipsoid", Superell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.5, 0.5}},
    };
    for (const auto& [name, shape] : solids) {
        const CompiledScene compiled = compile_alone(shape, identity);
        const kernel::Frame frame = prepare_rays(compiled, 1).frame;
        const oracle::ImplicitSolid solid = oracle::implicit(shape, identity);
        const NearSolids near(compiled);
        oracle::Random random(3);
        oracle::RayMaker maker(shape, solid, random);
        // In units of the last place of where the end lies; the worst, and how many were looked at.
        const auto worst = [&](const Settings& settings, const std::vector<Ray>& rays, std::size_t& ends_seen) {
            const auto kernels = make_kernels(compiled, settings);
            double most = 0;
            for (const Ray& ray : rays) {
                const oracle::Answer answer = oracle::intersect(solid, ray);
                if (answer.tie) continue;
                std::vector<kernel::Boundary> boundaries;
                Weaver weaver;
                kernels->trace(frame, test::records_of({ray}).front(), near, boundaries, weaver);
                REQUIRE(boundaries.size() == 2 * answer.intervals.size());
                for (std::size_t i = 0; i < boundaries.size(); ++i, ++ends_seen) {
                    const auto& interval = answer.intervals[i / 2];
                    const double t = i % 2 ? interval.out.t : interval.in.t;
                    const double ulp = std::nextafter(std::fabs(t), 1e300) - std::fabs(t);
                    most = std::fmax(most, std::fabs(boundaries[i].t - t) / ulp);
                }
            }
            return most;
        };
        std::vector<Ray> rays;
        for (int i = 0; i < 200; ++i) rays.push_back(maker.make(oracle::RayFamily::ordinary));
        std::size_t boundaries = 0;
        const double by_quad = worst(in_quad, rays, boundaries), by_double = worst(in_double, rays, boundaries);
        INFO(name << ": worst error in ulps, 113 bits " << by_quad << ", double " << by_double);
        CHECK(boundaries > 300);
        CHECK(by_quad == 0);
        CHECK(by_double >= 1);
    }
}

TEST_CASE("a precision where it is not is refused", "[pipeline][promise:rounding]") {
    const auto refusal = [](const Settings& wanted) {
        return test::failure(Status::usage, [&] { Renderer(Scene(), {}, wanted); });
    };
    CHECK(refusal(in_quad).find("113-bit precision is on the reference only") != std::string::npos);
    CHECK(refusal(with_methods({.contraction = true}, {.reference = true})).find("contraction is on a device only") !=
          std::string::npos);

    const CompiledScene compiled = compile_alone(Ell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, identity);
    const std::vector<kernel::RayRecord> faint = {{-9, 0, 0, 1e-40, 0, 0, 0, 1}};
    CHECK_THROWS_AS(make_converter(compiled, in_world)->check(faint, 0), Error);
    CHECK_THROWS_AS(make_kernels(compiled, in_world)->check(faint.front(), 0), Error);
    CHECK_NOTHROW(make_converter(compiled, in_single)->check(faint, 0));
}
