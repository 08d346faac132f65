// Every way to solve a quartic: the device gives what the reference gives, to the last bit, and the oracle counts where
// each goes wrong.
#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "base/laboratory.hpp"
#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/campaign.hpp"
#include "integration/same_answers.hpp"
#include "integration/scene_of_kinds.hpp"

using namespace csgrt;
using oracle::Kind;

TEST_CASE("device and reference agree however quartics are solved", "[.pocl][agreement]") {
    std::vector<Ray> rays;
    const Scene scene = test::scene_of({Kind::tor, Kind::eto, Kind::tgc}, rays);
    for (const auto& [name, quartic] : quartic_names) {
        INFO(name);
        Settings settings = with_methods({.quartic = quartic}, test::on_device());
        Renderer device(scene, {"all"}, settings);
        settings.reference = true;
        settings.device.clear();
        Renderer reference(scene, {"all"}, settings);
        // From afar the unshifted method finds roots beyond the solid's box: the device's hierarchy spares it those.
        const std::vector<Ray> asked = quartic == Quartic::bracketed_unshifted ? test::near_only(rays) : rays;
        test::require_same(device.shoot(asked), reference.shoot(asked));
    }
}

namespace {

/// Rays with a wrong answer in one family at tori.
std::array<oracle::Tally, oracle::ray_families> judged(Quartic quartic, std::size_t rays) {
    const auto solver = [quartic](const Shape& shape, const Matrix& matrix) {
        auto scene = std::make_shared<CompiledScene>(compile_alone(shape, matrix));
        return [scene, quartic](const Ray& ray) {
            std::vector<oracle::Segment> segments;
            for (const SolidSegment& s : intersect_solid(*scene, 0, ray, quartic))
                segments.push_back({s.in, s.out, s.in_normal, s.out_normal});
            return segments;
        };
    };
    return oracle::run_campaign(Kind::tor, rays, 3, solver).tally;
}

}  // namespace

TEST_CASE("tori before the oracle: what each way to solve a quartic is worth", "[geometry]") {
    using oracle::RayFamily;
    const auto at = [](const auto& tally, RayFamily family) { return tally[static_cast<std::size_t>(family)]; };
    const auto bracketed = judged(Quartic::bracketed, 5000), unshifted = judged(Quartic::bracketed_unshifted, 5000);
    const auto ferrari = judged(Quartic::ferrari, 5000), yuksel = judged(Quartic::yuksel, 5000);
    for (std::size_t i = 0; i < oracle::ray_families; ++i)
        UNSCOPED_INFO(oracle::ray_family_names[i]
                      << ", wrong of " << bracketed[i].rays << ": bracketed " << bracketed[i].wrong << ", unshifted "
                      << unshifted[i].wrong << ", Ferrari " << ferrari[i].wrong << ", Yuksel " << yuksel[i].wrong);
    for (const oracle::Tally& tally : bracketed) CHECK(tally.wrong == 0);
    // From afar the coefficients of an origin that was not moved hold nothing.
    CHECK(2 * at(unshifted, RayFamily::far).wrong > at(unshifted, RayFamily::far).hits);
    // Ordinary rays are no trouble to the others; the closed form loses roots of rays that run edge-on.
    CHECK(100 * at(ferrari, RayFamily::ordinary).wrong <= at(ferrari, RayFamily::ordinary).rays);
    CHECK(at(ferrari, RayFamily::edge).wrong > 0);
    CHECK(100 * at(yuksel, RayFamily::ordinary).wrong <= at(yuksel, RayFamily::ordinary).rays);
}
