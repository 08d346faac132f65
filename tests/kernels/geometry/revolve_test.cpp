#include "kernels/geometry/check_outlines.hpp"
#include "oracle/profiles.hpp"
#include "oracle/revolved.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;

namespace {

constexpr double pi = 3.14159265358979323846;

double some_angle(oracle::Random& random) {
    switch (random.below(6)) {
        case 0:
            return pi;
        case 1:
            return random.between(0.05, 1);
        case 2:
            return random.between(1, 3);
        case 3:
            return random.between(3.2, 6.2);
        default:
            return 2 * pi;
    }
}

OutlineCase revolve_case(std::size_t index, oracle::Random& random) {
    using namespace oracle;
    const std::size_t form = index % profile_form_count, round = index / profile_form_count;
    const std::size_t place = round % std::size(oracle::detail::placements);
    const double size = round % 3 == 1 ? 1e-3 : round % 3 == 2 ? 1e4 : 1;
    const LocalFrame local = place <= 1 ? aligned_local_frame(random) : random_local_frame(random, size);
    Revolve shape{.v = to_vec3(local.at)};
    shape.axis = to_vec3(local.vector(0, 0, 1)), shape.r = to_vec3(local.vector(1, 0, 0));
    shape.angle = some_angle(random);
    shape.sketch = ProfileMaker(random).make(form);
    for (Sketch::Point& p : shape.sketch.vertices) p = {p.u * local.size, p.v * local.size};
    for (Sketch::Curve& curve : shape.sketch.curves)
        if (auto* arc = std::get_if<Sketch::Arc>(&curve)) arc->radius *= local.size;

    OutlineCase one;
    one.name = std::string(profile_forms[form]) + ", " + oracle::detail::placements[place] + ", angle " +
               std::to_string(shape.angle);
    one.matrix = oracle::detail::placement(place, local.size, random);
    one.solid = revolved(shape, oracle::to_affine(one.matrix));
    const QAffine map = to_affine(one.matrix);
    const auto at = [&](const Sketch::Point& p, double turn) {
        return map.point(local.at + quad(p.u * std::cos(turn)) * local.x + quad(p.u * std::sin(turn)) * local.y +
                         quad(p.v) * local.z);
    };
    const double turn = random.between(0, 6);
    for (const Sketch::Point& p : shape.sketch.vertices)
        for (const double angle : {0.0, shape.angle, turn, turn + pi}) one.features.points.push_back(at(p, angle));
    for (std::size_t i = 0; i + 4 < one.features.points.size(); ++i)
        one.features.directions.push_back(one.features.points[i + 4] - one.features.points[i]);
    for (const Vec3& v : {shape.axis, shape.axis, shape.r}) one.features.directions.push_back(map.direction(v));
    for (int i = 0; i < 4; ++i) {  // across the axis, up to rounding
        const double y = random.between(-1, 1), x = random.between(-1, 1);
        one.features.directions.push_back(map.direction(local.vector(x, y, 0)));
    }
    std::erase_if(one.features.directions, [](const QVec& d) { return !(dot(d, d) > 0); });
    one.shape = std::move(shape);
    return one;
}

}  // namespace

TEST_CASE("geometry: revolve agrees with the oracle", "[geometry][promise:solids]") {
    check_outlines(revolve_case, test::sanitized ? 1'000 : 2'000, 1);
}
// Its closest approach to the axis lies within the tube, where no crossing is near: rounding made two there.
TEST_CASE("geometry: a ray across the axis of a revolved circle meets it once", "[promise:rounding]") {
    Revolve shape;
    shape.v = {2, 1, -2}, shape.axis = {0, 1, 0}, shape.r = {0, 0, -1};
    shape.angle = 2 * pi;
    shape.sketch.vertices = {{1, 0}, {1, 0.42888632783537489}};
    shape.sketch.curves.push_back(Sketch::Arc{1, 0, -1, false, false});
    const auto segments = kernel_answer(shape, identity)({{4.7407523035025561, 1.1371009140235888, 3.8055683118477521},
                                                          {-0.30542438655070508, 0, -0.95221633261571681}});
    REQUIRE(segments.size() == 1);
    CHECK(segments.front().in == Approx(5.2347773776262159).epsilon(1e-15));
    CHECK(segments.front().out == Approx(7.4957217376585543).epsilon(1e-15));
}
// The first one's height is that of the vertex nearest to the axis, but for a bit; and it is all but flat.
TEST_CASE("geometry: flat rays at the height of a vertex of a revolve", "[promise:rounding]") {
    Revolve shape;
    shape.v = {-0.00096497293617720686, 0.0016327828372127819, -0.0025316160922581364};
    shape.axis = {0.00014555532940381533, 0.00058929476650774386, 0.00079469825987523747};
    shape.r = {-0.00073285040176237787, 0.00060384023123976141, -0.00031353989183680102};
    shape.angle = 3.1415926535897931;
    shape.sketch.vertices = {{1e-6, -0.001}, {2e-6, -0.001}, {7.8095821412742907e-07, 0}, {0.001, 0.001}};
    for (std::uint32_t i = 0; i < 4; ++i) shape.sketch.curves.push_back(Sketch::Line{i, (i + 1) % 4});
    const Matrix placed = {-0.30869652632506039,
                           0.87506102803092745,
                           -0.37279304158781945,
                           0.0023504218303414255,
                           0.25502857335111018,
                           -0.30143730625196458,
                           -0.91874696036180536,
                           0.00054419863011208954,
                           0.91633338988020008,
                           0.37868687278675994,
                           0.13011291622911839,
                           -0.0017776207319761259,
                           0,
                           0,
                           0,
                           1};
    const auto segments =
        kernel_answer(shape, placed)({{0.011345194438456142, 0.0039264811751535582, -0.0013749058021665134},
                                      {-0.95111883229963345, -0.26989728442950267, -0.15009471244038505}});
    REQUIRE(segments.size() == 1);
    // From the vertex's radius to where the last line crosses its height, 0.0005005.
    CHECK(segments.front().out - segments.front().in == Approx(0.0005005 - 7.8095821412742907e-07).epsilon(1e-9));
    // At the very height of the vertex, a bit above and below, and as little inclined.
    shape.v = {}, shape.axis = {0, 0, 1}, shape.r = {1, 0, 0}, shape.angle = 2 * pi;
    shape.sketch.vertices = {{0.001, -1}, {0.002, -1}, {0.0008, 0}, {1, 1}};
    for (const double height : {0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-13, -1e-13})
        for (const double slope : {0.0, 1e-17, -1e-17, 3e-16, -3e-16, 1e-12, -1e-12})
            for (const double aside : {0.0, 1e-16, 1e-5, 5e-4}) {
                INFO("height " << height << ", slope " << slope << ", aside " << aside);
                const auto found = kernel_answer(shape, identity)({{0, aside, height}, {1, 0, slope}});
                REQUIRE(found.size() == 2);
                CHECK(found[0].in == Approx(-0.5005).epsilon(1e-6));
                CHECK(found[0].out == Approx(-std::sqrt(0.0008 * 0.0008 - aside * aside)).epsilon(1e-6));
                CHECK(found[1].in == Approx(std::sqrt(0.0008 * 0.0008 - aside * aside)).epsilon(1e-6));
                CHECK(found[1].out == Approx(0.5005).epsilon(1e-6));
            }
}
TEST_CASE("geometry: a ray along the axis of a revolve has normals along it, too") {
    Revolve shape;
    shape.axis = {0, 0, 1}, shape.r = {1, 0, 0};
    shape.angle = 2 * pi;
    shape.sketch.vertices = {{0, 0}, {2, 0}, {2, 3}, {0, 3}};
    for (std::uint32_t i = 0; i < 3; ++i) shape.sketch.curves.push_back(Sketch::Line{i, i + 1});
    Scene scene;
    scene.objects.push_back(Solid{"drum", shape, {}});
    for (const bool reference : {true, false}) {
        Settings settings{.reference = reference};
        Renderer renderer(scene, {}, settings);
        for (const double way : {1.0, -1.0}) {
            const RayPartitions found = renderer.shoot({{{0, 0, 1.5 - 10 * way}, {0, 0, way}}}).front();
            REQUIRE(found.partitions.size() == 1);
            CHECK(found.partitions.front().in_normal == Vec3{0, 0, -way});
            CHECK(found.partitions.front().out_normal == Vec3{0, 0, way});
        }
    }
}
TEST_CASE("geometry: revolve agrees with the oracle on 100,000 rays", "[.long][promise:solids]") {
    check_outlines(revolve_case, 100'000, 2, 1);
}
