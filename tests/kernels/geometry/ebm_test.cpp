#include "compile/solids/cell_outline.hpp"
#include "kernels/geometry/check_outlines.hpp"
#include "oracle/extruded_cells.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;

namespace {

Ebm picture(std::uint32_t width, std::uint32_t depth, std::vector<std::uint8_t> cells) {
    Ebm shape;
    shape.width = width, shape.depth = depth, shape.height = 1;
    shape.cells = std::move(cells);
    return shape;
}

OutlineCase ebm_case(std::size_t index, oracle::Random& random) {
    using namespace oracle;
    const std::size_t place = index % std::size(oracle::detail::placements);
    const auto depth = 1 + static_cast<std::uint32_t>(random.below(9));
    Ebm shape = picture(1 + static_cast<std::uint32_t>(random.below(9)), depth, {});
    const double share = random.between(0.2, 1.1);
    for (std::uint32_t i = 0; i < shape.width * shape.depth; ++i)
        shape.cells.push_back(random.unit() < share ? static_cast<std::uint8_t>(1 + random.below(255)) : 0);
    shape.cells[0] = 1;
    shape.height = random.power(-2, 1);
    if (index % 3 != 0) shape.matrix = oracle::detail::placement(random.below(7), 4, random);
    OutlineCase one;
    one.name =
        std::to_string(shape.width) + " x " + std::to_string(shape.depth) + ", " + oracle::detail::placements[place];
    one.matrix = oracle::detail::placement(place, 4, random);
    one.solid = extruded_cells(shape, oracle::to_affine(one.matrix));
    for (int i = 0; i < 12; ++i)
        one.features.points.push_back(one.solid.frame.point({static_cast<double>(random.below(shape.width + 1)),
                                                             static_cast<double>(random.below(shape.depth + 1)),
                                                             random.coin() ? 0 : shape.height}));
    one.features.directions = {one.solid.frame.x, one.solid.frame.y, one.solid.frame.z,
                               one.solid.frame.x + one.solid.frame.y};
    one.shape = std::move(shape);
    return one;
}

}  // namespace

TEST_CASE("geometry: ebm agrees with the oracle", "[geometry][promise:solids]") { check_outlines(ebm_case, 6'000, 1); }
TEST_CASE("geometry: ebm agrees with the oracle on a million rays", "[.long][promise:solids]") {
    check_outlines(ebm_case, 1'000'000, 2);
}

TEST_CASE("ebm: the outline of its cells") {
    CHECK(cell_outline(picture(2, 2, {0, 0, 0, 0})).empty());
    CHECK(cell_outline(picture(2, 2, {1, 1, 1, 1})).size() == 4);
    CHECK(cell_outline(picture(3, 3, {1, 1, 1, 1, 0, 1, 1, 1, 1})).size() == 8);
    // Two cells that meet in a corner: the lines run on through it.
    const auto lines = cell_outline(picture(2, 2, {1, 0, 0, 1}));
    CHECK(lines.size() == 6);
    for (const StraightLine& line : lines) CHECK((line.u0 == line.u1) != (line.v0 == line.v1));
}
