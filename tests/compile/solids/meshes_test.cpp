// Solids that triangles make, as they are packed: shared by their places, boxed tightly, and what is not closed.

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "compile/tables.hpp"
#include "reference/intersect.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

Bot cube(double low = -1, double high = 1) {
    Bot bot;
    for (const double z : {low, high})
        for (const double y : {low, high})
            for (const double x : {low, high}) bot.vertices.push_back({x, y, z});
    bot.faces = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    return bot;
}
Vol one_cell(std::size_t solid_cells) {
    Vol vol;
    vol.width = 4, vol.depth = 3, vol.height = 2;
    vol.low = 1;
    vol.cell = {2, 2, 5};
    vol.cells.resize(24);
    for (std::size_t i = 0; i < solid_cells; ++i) vol.cells[4 * 1 + 2] = 9;  // x 2, y 1, z 0
    return vol;
}
CompiledScene alone(const Shape& shape, const Matrix& matrix = identity) {
    return compile(scene({solid("s", shape), region("r", {leg("s", matrix)})}), {"r"});
}
bool near_box(const Box& a, const Box& b) {
    const auto close = [](const Vec3& p, const Vec3& q) {
        return p.x == Approx(q.x).margin(1e-12) && p.y == Approx(q.y).margin(1e-12) && p.z == Approx(q.z).margin(1e-12);
    };
    return close(a.low, b.low) && close(a.high, b.high);
}

}  // namespace

TEST_CASE("meshes: places of one mesh share it, and two meshes do not", "[compile]") {
    const Matrix aside{0, -2, 0, 40, 2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    Bot plates = cube();
    plates.mode = Bot::Mode::plate;
    plates.thickness.assign(plates.faces.size(), 0.1);
    for (const Shape& shape : {Shape(cube()), Shape(plates), Shape(one_cell(1))}) {
        const CompiledScene one = alone(shape);
        const CompiledScene two = compile(
            scene({solid("s", shape), region("r", {leg("s"), leg("s", aside), op(Operator::union_, 2)})}), {"r"});
        CHECK(two.words.size() == one.words.size());
        CHECK(two.inner_nodes.size() == one.inner_nodes.size());
        CHECK(two.reals.size() - one.reals.size() <= 13);
        REQUIRE(two.solids.size() == 2);
        CHECK(two.solids[0].first_word == two.solids[1].first_word);
        CHECK(two.solids[0].first_real != two.solids[1].first_real);
        const CompiledScene other = compile(scene({solid("s", shape), solid("t", shape),
                                                   region("r", {leg("s"), leg("t", aside), op(Operator::union_, 2)})}),
                                            {"r"});
        CHECK(other.words.size() == 2 * one.words.size());
    }
}

TEST_CASE("meshes: boxes", "[compile]") {
    const Matrix m{0, -2, 0, 10, 2, 0, 0, 20, 0, 0, 3, 30, 0, 0, 0, 1};  // (10 - 2 y, 20 + 2 x, 30 + 3 z)
    Bot bot = cube();
    bot.vertices.push_back({1000, 1000, 1000});  // in no face
    CHECK(near_box(solid_box(bot, m), {{8, 18, 27}, {12, 22, 33}}));
    bot.mode = Bot::Mode::plate;
    bot.thickness.assign(bot.faces.size(), 0.25);
    bot.thickness[5] = 0.5;
    CHECK(near_box(solid_box(bot, m), {{7, 17, 25.5}, {13, 23, 34.5}}));

    const std::vector<Vec3> low(3, Vec3{0, 0, -1}), high(3, Vec3{0, 0, 4});
    const Ars ars{{low, {{1, 0, 0}, {0, 2, 0}, {-3, 0, 0}}, high}};
    CHECK(near_box(solid_box(ars, m), {{6, 14, 27}, {10, 22, 42}}));

    const Nmg nmg{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}},
                  {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 2, 3}}, {{1, 2, 3}}}};
    CHECK(near_box(solid_box(nmg, identity), {{0, 0, 0}, {1, 1, 1}}));

    const Vol vol = one_cell(1);
    CHECK(near_box(solid_box(vol, identity), {{4, 2, 0}, {6, 4, 5}}));
    CHECK(near_box(brlcad_box(vol, identity), {{0, 0, 0}, {8, 6, 10}}));  // all its cells

    Dsp dsp;
    dsp.width = 3, dsp.depth = 2;
    dsp.heights = {5, 1, 0, 7, 7, 7};
    dsp.matrix = {10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1};
    CHECK(near_box(solid_box(dsp, identity), {{0, 0, 0}, {20, 10, 3.5}}));
}

TEST_CASE("meshes: what is not closed leaves a crossing over, which claims nothing", "[compile]") {
    Bot open = cube();
    open.faces.erase(open.faces.begin(), open.faces.begin() + 2);  // no floor
    const CompiledScene one = alone(open);
    const Ray down{{0.2, 0.1, 5}, {0, 0, -1}};
    const auto segments = intersect_solid(one, 0, down);
    REQUIRE(segments.size() == 1);
    CHECK(segments[0].in == segments[0].out);
    Settings settings{.reference = true};
    Renderer renderer(scene({solid("s", open), region("r", {leg("s")})}), {"r"}, settings);
    CHECK(renderer.shoot({down})[0].partitions.empty());
    CHECK(renderer.shoot({{{5, 0.1, 0.3}, {-1, 0, 0}}})[0].partitions.size() == 1);
}

TEST_CASE("meshes: with gaps, an in and the very next out are a pair if the triangles face one way", "[compile]") {
    Bot bot = cube(-1, 1);
    for (auto& face : bot.faces) {  // counterclockwise from outside
        const Vec3 &a = bot.vertices[face[0]], &b = bot.vertices[face[1]], &c = bot.vertices[face[2]];
        const Wide p = wide(a), n = glm::cross(wide(b) - p, wide(c) - p);
        if (glm::dot(n, p) < 0) std::swap(face[1], face[2]);
    }
    Bot second = bot;
    for (Vec3& v : second.vertices) v.z += 3;
    for (auto face : second.faces) bot.faces.push_back({face[0] + 8, face[1] + 8, face[2] + 8});
    bot.vertices.insert(bot.vertices.end(), second.vertices.begin(), second.vertices.end());
    const auto without = [&](const std::vector<std::size_t>& walls) {  // two faces each; 0: z = low, 1: z = high
        Bot open = bot;
        for (auto wall = walls.rbegin(); wall != walls.rend(); ++wall)
            open.faces.erase(open.faces.begin() + static_cast<int>(2 * *wall),
                             open.faces.begin() + static_cast<int>(2 * *wall + 2));
        return open;
    };
    const auto lengths = [&](const Bot& one, const Ray& ray, const Matrix& matrix = identity) {
        Settings settings{.reference = true};
        Renderer renderer(scene({solid("s", one), region("r", {leg("s", matrix)})}), {"r"}, settings);
        std::vector<std::pair<double, double>> all;
        const std::vector<RayPartitions> answer = renderer.shoot({ray});
        for (const Partition& p : answer[0].partitions) all.emplace_back(p.in, p.out);
        return all;
    };
    using Lengths = std::vector<std::pair<double, double>>;
    const Ray up{{0.2, 0.1, -10}, {0, 0, 1}};
    const Lengths lower{{9, 11}}, upper{{12, 14}}, neither, both_of{{9, 11}, {12, 14}};
    for (const bool clockwise : {false, true}) {
        Bot closed = bot;
        closed.orientation = clockwise ? Bot::Orientation::counterclockwise : Bot::Orientation::clockwise;
        CHECK(lengths(closed, up) == both_of);  // whatever it says
        for (const auto& [walls, expected] :
             std::vector<std::pair<std::vector<std::size_t>, Lengths>>{{{0}, upper},
                                                                       {{1}, upper},
                                                                       {{6}, lower},
                                                                       {{7}, lower},
                                                                       {{0, 6}, neither},
                                                                       {{1, 7}, neither},
                                                                       {{0, 1}, upper}}) {
            Bot open = without(walls);
            open.orientation = clockwise ? Bot::Orientation::clockwise : Bot::Orientation::counterclockwise;
            if (clockwise)
                for (auto& face : open.faces) std::swap(face[0], face[1]);
            CHECK(lengths(open, up) == expected);
            const Matrix mirror{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
            CHECK(lengths(open, {{0.2, 0.1, 10}, {0, 0, -1}}, mirror) == expected);
            // In both of the kernels' passes, from anywhere: as many, in order, and what ends before t_min is left out.
            const CompiledScene compiled = alone(open);
            const kernel::Geometry g = tables(compiled);
            for (const double t_min : {-1.0, 10.0, 11.5, 13.0, 15.0}) {
                const kernel::ray3 r{{0.2, 0.1, -10}, {0, 0, 1}};
                const auto count = kernel::collect(g, compiled.solids[0], 0, r, t_min, nullptr);
                std::vector<kernel::Boundary> boundaries(2 * count);
                REQUIRE(kernel::collect(g, compiled.solids[0], 0, r, t_min, boundaries.data()) == count);
                Lengths found, wanted;
                for (std::size_t i = 0; i < boundaries.size(); i += 2) {
                    CHECK(boundaries[i].t <= boundaries[i + 1].t);
                    if (i > 0) CHECK(boundaries[i - 1].t <= boundaries[i].t);
                    if (boundaries[i].t < boundaries[i + 1].t) found.emplace_back(boundaries[i].t, boundaries[i + 1].t);
                }
                for (const auto& one : expected)
                    if (one.second >= t_min) wanted.push_back(one);
                CHECK(found == wanted);
            }
        }
    }
}

TEST_CASE("meshes: from t_min on, the solid is known to be entered before it", "[compile]") {
    const CompiledScene one = alone(cube());
    const kernel::Geometry g = tables(one);
    const kernel::ray3 r{{0.2, 0.1, -5}, {0, 0, 1}};
    for (const double t_min : {-1e300, 3.9, 4.1, 5.9, 6.1}) {
        kernel::Boundary boundaries[2] = {};
        const auto count = kernel::collect(g, one.solids[0], 0, r, t_min, nullptr);
        CHECK(count == (t_min < 6 ? 1u : 0u));
        CHECK(kernel::collect(g, one.solids[0], 0, r, t_min, boundaries) == count);
        if (count == 0) continue;
        CHECK(boundaries[0].t == 4);
        CHECK(boundaries[1].t == 6);
        CHECK((boundaries[0].surface & LEAVES) == 0);
        CHECK((boundaries[1].surface & LEAVES) != 0);
    }
}

TEST_CASE("meshes: any size within the limits, and none beyond", "[compile]") {
    for (const double size : {1e-100, 1e100}) CHECK_THROWS_AS(alone(cube(-size, size)), Error);
    for (const double size : {Limits::least_length, 1e-10, 1.0, 1e10, Limits::length}) {
        Bot bot = cube(-size, size);
        const auto segments = intersect_solid(alone(bot), 0, {{0.3 * size, 0.2 * size, -3 * size}, {0, 0, 1}});
        REQUIRE(segments.size() == 1);
        CHECK(segments[0].in == Approx(2 * size));
        CHECK(segments[0].out == Approx(4 * size));
        CHECK(segments[0].in_normal.z == Approx(-1));
        CHECK(segments[0].out_normal.z == Approx(1));
    }
}
