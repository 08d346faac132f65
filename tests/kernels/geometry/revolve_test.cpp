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
    Revolve shape;
    shape.v = to_vec3(local.at);
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

TEST_CASE("geometry: revolve agrees with the oracle", "[geometry]") {
    check_outlines(revolve_case, test::sanitized ? 1'000 : 4'000, 1);
}
// Its closest approach to the axis lies within the tube, where no crossing is near: rounding made two there.
TEST_CASE("geometry: a ray across the axis of a revolved circle meets it once") {
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
TEST_CASE("geometry: a ray along the axis of a revolve has normals along it, too") {
    Revolve shape;
    shape.axis = {0, 0, 1}, shape.r = {1, 0, 0};
    shape.angle = 2 * pi;
    shape.sketch.vertices = {{0, 0}, {2, 0}, {2, 3}, {0, 3}};
    for (std::uint32_t i = 0; i < 3; ++i) shape.sketch.curves.push_back(Sketch::Line{i, i + 1});
    Scene scene;
    scene.objects.push_back(Solid{"drum", shape, {}});
    for (const bool reference : {true, false}) {
        Settings settings;
        settings.reference = reference;
        Renderer renderer(scene, {}, settings);
        for (const double way : {1.0, -1.0}) {
            const RayPartitions found = renderer.shoot({{{0, 0, 1.5 - 10 * way}, {0, 0, way}}}).front();
            REQUIRE(found.partitions.size() == 1);
            CHECK(found.partitions.front().in_normal == Vec3{0, 0, -way});
            CHECK(found.partitions.front().out_normal == Vec3{0, 0, way});
        }
    }
}
TEST_CASE("geometry: revolve agrees with the oracle on 100,000 rays", "[.long]") {
    check_outlines(revolve_case, 100'000, 2);
}
