// Solids of a closed form: the device gives what the reference gives, to the
// last bit.
#include <cstdlib>
#include <cstring>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "oracle/rays.hpp"
#include "oracle/shapes.hpp"
#include "pipeline/scene_of_kind.hpp"

using namespace csgrt;

namespace {

bool same(const Vec3 &a, const Vec3 &b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

TEST_CASE("device and reference agree on solids of a closed form",
          "[agreement]") {
  using oracle::Kind;
  for (const Kind kind :
       {Kind::part, Kind::epa, Kind::rpc, Kind::rhc, Kind::eto, Kind::hyp,
        Kind::superell, Kind::hrt, Kind::metaball}) {
    INFO(static_cast<int>(kind));
    std::vector<Ray> rays;
    const Scene scene = test::scene_of(kind, rays);
    Settings settings;
    if (const char *choice = std::getenv("CSGRT_DEVICE"))
      settings.device = choice;
    const auto by_device = Renderer(scene, {"all"}, settings).shoot(rays);
    settings.reference = true;
    const auto by_reference = Renderer(scene, {"all"}, settings).shoot(rays);
    std::size_t partitions = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      REQUIRE(by_device[i].partitions.size() ==
              by_reference[i].partitions.size());
      for (std::size_t k = 0; k < by_device[i].partitions.size();
           ++k, ++partitions) {
        const Partition &p = by_device[i].partitions[k],
                        &q = by_reference[i].partitions[k];
        REQUIRE(std::memcmp(&p.in, &q.in, sizeof p.in) == 0);
        REQUIRE(std::memcmp(&p.out, &q.out, sizeof p.out) == 0);
        REQUIRE((same(p.in_normal, q.in_normal) &&
                 same(p.out_normal, q.out_normal) && p.region == q.region));
      }
    }
    CHECK(partitions > rays.size() / 2);
  }
}
