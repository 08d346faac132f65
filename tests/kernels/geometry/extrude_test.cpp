#include "kernels/geometry/check_outlines.hpp"
#include "oracle/extruded.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;

namespace {

OutlineCase extrude_case(std::size_t index, oracle::Random& random) {
    using namespace oracle;
    const std::size_t form = index % sketch_form_count, round = index / sketch_form_count;
    const std::size_t place = round % std::size(oracle::detail::placements);
    const double size = round % 3 == 1 ? 1e-3 : round % 3 == 2 ? 1e4 : 1;
    const LocalFrame local = place <= 1 ? aligned_local_frame(random) : random_local_frame(random, size);
    const double height = random.below(4) == 0 ? 1e-3 : random.between(0.3, 2);
    const bool lean = random.coin();
    Extrude shape{.v = to_vec3(local.at)};
    shape.a = to_vec3(local.vector(1, 0, 0)), shape.b = to_vec3(local.vector(lean ? 0.3 : 0, lean ? 0.8 : 1, 0));
    shape.h = to_vec3(local.vector(lean ? 0.5 : 0, lean ? -0.2 : 0, height));
    shape.sketch = SketchMaker(random).make(form);

    OutlineCase one;
    one.name = std::string(sketch_forms[form]) + ", " + oracle::detail::placements[place];
    one.matrix = oracle::detail::placement(place, local.size, random);
    one.solid = extruded(shape, oracle::to_affine(one.matrix));
    const QAffine map = to_affine(one.matrix);
    for (const Sketch::Point& p : shape.sketch.vertices)
        for (const double z : {0, 1})
            one.features.points.push_back(map.point(QVec(shape.v) + quad(p.u) * QVec(shape.a) +
                                                    quad(p.v) * QVec(shape.b) + quad(z) * QVec(shape.h)));
    for (std::size_t i = 0; i + 2 < one.features.points.size(); i += 2)
        one.features.directions.push_back(one.features.points[i + 2] - one.features.points[i]);
    for (const Vec3& v : {shape.h, shape.h, shape.a, shape.b}) one.features.directions.push_back(map.direction(v));
    std::erase_if(one.features.directions, [](const QVec& d) { return !(dot(d, d) > 0); });
    one.shape = std::move(shape);
    return one;
}

}  // namespace

TEST_CASE("geometry: extrude agrees with the oracle", "[geometry][promise:solids]") {
    check_outlines(extrude_case, test::sanitized ? 1'000 : 3'000, 1);
}
TEST_CASE("geometry: extrude agrees with the oracle on 200,000 rays", "[.long][promise:solids]") {
    check_outlines(extrude_case, 200'000, 2);
}
