// Which faces share a record of the table of planes.
#include <random>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "compile/solids/planes.hpp"
#include "compile/solids/polyhedron.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr Vec3 center{3, 2, 1};
constexpr double radius = 1000;

/// Adds the faces of blocks; returns the references of each.
std::vector<std::vector<kernel::PlaneRef>> add_all(PlaneTable& table, const std::vector<std::pair<Arb, Matrix>>& arbs) {
    std::vector<std::vector<kernel::PlaneRef>> refs;
    for (const auto& [arb, matrix] : arbs) {
        const Box box = solid_box(arb, matrix);
        refs.emplace_back();
        for (const Plane& plane : arb_faces(arb, matrix).planes) refs.back().push_back(table.add(plane, box));
    }
    return refs;
}

std::size_t shared(const std::vector<std::vector<kernel::PlaneRef>>& refs, bool opposite) {
    std::size_t count = 0;
    for (const auto a : refs[0])
        for (const auto b : refs[1])
            if (a >> 1 == b >> 1 && (a != b) == opposite) ++count;
    return count;
}

}  // namespace

TEST_CASE("abutting blocks share the plane between them, and those that they are flush in") {
    for (const Matrix& m :
         {identity, moved(0.1, 0.7, 1e3), turned(0.3), askew(1.1), askew(2.7, {123.456, -77.7, 0.1})}) {
        PlaneTable table(center, radius);
        const auto refs =
            add_all(table, {{block_shape({0, 0, 0}, {1, 2, 3}), m}, {block_shape({1, 0, 0}, {5, 2, 3}), m}});
        CHECK(shared(refs, true) == 1);   // x = 1, from both sides
        CHECK(shared(refs, false) == 4);  // y and z, flush
        CHECK(table.records().size() == 7);
    }
}

TEST_CASE("planes are shared in any orientation of the solid, and however the same place was reached",
          "[promise:coincidence]") {
    const double quarter = std::acos(0.0);
    for (int turn = 0; turn < 4; ++turn) {
        // A cube on its place, turned about the middle of another's top; the turned one's own corners come in another
        // order.
        const Matrix m = askew(0.7, {10, 20, 30});
        Matrix t = turned(turn * quarter);
        PlaneTable table(center, radius);
        const Arb cube = block_shape({-1, -1, -1}, {1, 1, 1});
        Matrix lifted{}, up = moved(0, 0, 2);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                for (std::size_t k = 0; k < 4; ++k)
                    for (std::size_t l = 0; l < 4; ++l)
                        lifted[4 * i + j] += m[4 * i + k] * up[4 * k + l] * t[4 * l + j];
        const auto refs = add_all(table, {{cube, m}, {cube, lifted}});
        CHECK(shared(refs, true) == 1);
        CHECK(shared(refs, false) == 4);
    }
}

TEST_CASE("a modelled gap is kept, rounding is not", "[promise:coincidence]") {
    const double size = std::sqrt(3.0);  // the diagonal of the smaller block
    for (const double sign : {1.0, -1.0}) {
        for (const auto& [gap, joined] :
             {std::pair{0.3 * PlaneTable::gap, true}, std::pair{3 * PlaneTable::gap, false}}) {
            PlaneTable table(center, radius);
            const double x = 1 + sign * gap * size;
            const auto refs = add_all(table, {{block_shape({-9, 0, 0}, {1, 10, 10}), identity},
                                              {block_shape({x, 3, 3}, {x + 1, 4, 4}), identity}});
            CHECK(shared(refs, true) == (joined ? 1 : 0));
        }
    }
    // Turned about an edge in the common plane, the far edge leaves it.
    for (const auto& [angle, joined] : {std::pair{2e-11, true}, std::pair{1e-9, false}}) {
        PlaneTable table(center, radius);
        const auto refs = add_all(table, {{block_shape({0, -1, 0}, {1, 0, 1}), identity},
                                          {block_shape({0, 0, 0}, {1, 1, 1}), turned(angle)}});
        CHECK(shared(refs, true) == (joined ? 1 : 0));
    }
}

TEST_CASE("the later face takes over the earlier record, bit by bit", "[promise:coincidence]") {
    PlaneTable table(center, radius);
    const Box box{{0, 0, 0}, {1, 1, 1}};
    CHECK(table.add({{0, 0, 1}, 1}, box) == 0);
    CHECK(table.add({{0, 0, 1}, 1 + 1e-12}, box) == 0);
    CHECK(table.add({{0, 0, -1}, -1 + 1e-12}, box) == 1);
    CHECK(table.add({{0, 1, 0}, 1}, box) == 2);
    CHECK(table.add({{1e-12, 0, 1}, 1}, box) == 0);
    const auto records = table.records();
    REQUIRE(records.size() == 2);
    CHECK(records[0].nz == 1);
    CHECK(records[0].d == 1);
}

TEST_CASE("half-spaces far outside the scene do no harm") {
    PlaneTable table(center, 1e-3);
    const Box box{{-1, -1, -1}, {1, 1, 1}};
    CHECK(table.add({{0, 0, 1}, 1e300}, box) == 0);
    CHECK(table.add({{0, 0, 1}, -1e300}, box) == 2);
    CHECK(table.add({{0, 0, 1}, 1e300}, box) == 0);
}

TEST_CASE("a wall of blocks under a rotation: each seam is one plane, for a million faces") {
    // 64 x 64 x 40 blocks of different depths; 983,040 faces in 65 + 65 + 41 planes.
    constexpr int layers = test::tries(40);
    const Matrix m = askew(0.9, {5, -3, 2});
    PlaneTable table(Vec3{}, 200);
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j)
            for (int k = 0; k < layers; ++k) {
                const Box own{{1.0 * i, 1.0 * j, 1.0 * k}, {i + 1.0, j + 1.0, k + 1.0}};
                Box box = empty_box;
                for (const Vec3& p : block_shape(own.low, own.high).vertices)
                    extend(box, narrow(transform_point(m, wide(p))));
                for (const Plane& plane :
                     {Plane{{1, 0, 0}, own.high.x}, Plane{{-1, 0, 0}, -own.low.x}, Plane{{0, 1, 0}, own.high.y},
                      Plane{{0, -1, 0}, -own.low.y}, Plane{{0, 0, 1}, own.high.z}, Plane{{0, 0, -1}, -own.low.z}})
                    table.add(transform_plane(m, plane), box);
            }
    CHECK(table.records().size() == 65 + 65 + layers + 1);
}

TEST_CASE("a million different planes stay apart") {
    std::mt19937 random(3);
    std::normal_distribution<double> gauss;
    PlaneTable table(Vec3{}, 100);
    const Box box{{-1, -1, -1}, {1, 1, 1}};
    constexpr std::size_t count = test::tries(1'000'000);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = gauss(random), y = gauss(random), x = gauss(random);
        const Wide n(x, y, z);
        table.add(i % 2 == 0 ? plane_through(Wide(gauss(random)), n) : Plane{{0, 0, 1}, static_cast<double>(i) * 1e-4},
                  box);
    }
    CHECK(table.records().size() == count);
}
