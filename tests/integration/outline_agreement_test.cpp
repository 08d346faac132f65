// Solids that outlines make, on the device and by the reference: to the last bit.
#include <cstring>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "oracle/profiles.hpp"
#include "oracle/sketches.hpp"

using namespace csgrt;

namespace {

void add_region(Scene& scene, const std::string& name, Shape shape) {
    scene.objects.push_back(Solid{"s." + name, std::move(shape), {}});
    Combination region{.name = "r." + name, .region = true};
    region.tree.nodes.push_back({Operator::leaf, 0, "s." + name, identity, {}});
    scene.objects.push_back(region);
}

}  // namespace

TEST_CASE("device and reference agree on what outlines make", "[agreement]") {
    oracle::Random random(3);
    Scene scene;
    std::vector<std::string> regions;
    const auto add = [&](const std::string& name, Shape shape) {
        add_region(scene, name, std::move(shape));
        regions.push_back("r." + name);
    };
    for (std::size_t i = 0; i < oracle::sketch_form_count; ++i) {
        Extrude shape{{3.0 * static_cast<double>(i), 0, 0}, {0.2, 0.1, 2}, {1, 0, 0}, {0.2, 1, 0}, {}};
        shape.sketch = oracle::SketchMaker(random).make(i);
        add("extrude" + std::to_string(i), std::move(shape));
    }
    for (std::size_t i = 0; i < oracle::profile_form_count; ++i) {
        Revolve shape{{3.0 * static_cast<double>(i), 4, 0},
                      {0.1, 0, 1},
                      {1, 0, -0.1},
                      i % 2 ? 1.5 * static_cast<double>(i % 4) : 6.283185307179586,
                      {}};
        shape.sketch = oracle::ProfileMaker(random).make(i);
        add("revolve" + std::to_string(i), std::move(shape));
    }
    Ebm picture;
    picture.width = 12, picture.depth = 3, picture.height = 2;
    for (int i = 0; i < 36; ++i) picture.cells.push_back(random.coin() ? 1 : 0);
    picture.matrix[7] = -6;
    add("ebm", picture);

    Settings by_reference{.reference = true};
    Renderer reference(scene, regions, by_reference), device(scene, regions);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
        // Along the axes, too.
        const Vec3 at{random.between(-1, 42), random.between(-6, 5), random.between(-1, 2)};
        oracle::QVec d = i % 3 == 0 ? random.axis() : random.direction();
        const Vec3 direction = to_vec3(d);
        rays.push_back({{at.x - 50 * direction.x, at.y - 50 * direction.y, at.z - 50 * direction.z}, direction});
    }
    const auto expected = reference.shoot(rays), found = device.shoot(rays);
    std::size_t partitions = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        INFO("ray " << i);
        REQUIRE(found[i].partitions.size() == expected[i].partitions.size());
        for (std::size_t k = 0; k < found[i].partitions.size(); ++k) {
            const Partition &p = found[i].partitions[k], &q = expected[i].partitions[k];
            CHECK(p.region == q.region);
            const double mine[] = {p.in,          p.out,          p.in_normal.x,  p.in_normal.y,
                                   p.in_normal.z, p.out_normal.x, p.out_normal.y, p.out_normal.z};
            const double its[] = {q.in,          q.out,          q.in_normal.x,  q.in_normal.y,
                                  q.in_normal.z, q.out_normal.x, q.out_normal.y, q.out_normal.z};
            CHECK(std::memcmp(mine, its, sizeof mine) == 0);
        }
        partitions += found[i].partitions.size();
    }
    CHECK(partitions * 2 > rays.size());
}
