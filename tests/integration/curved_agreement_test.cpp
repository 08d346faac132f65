// Solids of a closed form: the device gives what the reference gives, to the last bit.
#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "integration/same_answers.hpp"
#include "integration/scene_of_kinds.hpp"

using namespace csgrt;

TEST_CASE("device and reference agree on solids of a closed form", "[agreement]") {
    using oracle::Kind;
    std::vector<Ray> rays;
    const Scene scene = test::scene_of(
        {Kind::part, Kind::epa, Kind::rpc, Kind::rhc, Kind::eto, Kind::hyp, Kind::superell, Kind::hrt, Kind::metaball},
        rays);
    Settings settings = test::on_device();
    const auto by_device = Renderer(scene, {"all"}, settings).shoot(rays);
    settings.reference = true;
    settings.device.clear();
    const auto by_reference = Renderer(scene, {"all"}, settings).shoot(rays);
    test::require_same(by_device, by_reference);
    std::size_t partitions = 0;
    for (const RayPartitions& ray : by_device) partitions += ray.partitions.size();
    CHECK(partitions > rays.size() / 2);
}
