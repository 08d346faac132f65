// The volumes in the cells of a grid.
#include <csgrt/measure.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "bodies.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::block, test::leg, test::region, test::thrown_by;

namespace {

using Sides = std::array<std::uint32_t, 3>;

Measurement measured(const Scene& scene, const MeasureRequest& request,
                     const Settings& settings = {.device = "native"}) {
    return Measurer(Model(scene, {}, settings), settings).measure(request);
}

std::string bytes_of(const CellVolumes& v) {
    std::string bytes;
    const auto add = [&bytes](const auto& list) {
        bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
    };
    add(v.cells);
    add(v.ids);
    add(v.volumes);
    add(v.half_widths);
    return bytes;
}
std::string bytes_of(const Measurement& result) {
    return bytes_of(result.grid.regions) + bytes_of(result.grid.materials);
}

/// Two blocks that touch and one far away, of two materials.
const std::vector<Box> boxes = {{{0, 0, 0}, {10, 10, 10}}, {{10, 0, 0}, {15, 10, 5}}, {{50, 3, 2}, {60, 9, 7}}};

Scene blocks() {
    Scene scene;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::string name(1, static_cast<char>('a' + i));
        scene.objects.push_back(block(name, boxes[i].low, boxes[i].high));
        Combination part = region(name + ".r", {leg(name)}, static_cast<int>(1000 + i));
        part.material_id = i == 0 ? 2 : 3;
        scene.objects.push_back(part);
    }
    return scene;
}

/// The length that two intervals share.
double shared(double low, double high, double other_low, double other_high) {
    return std::max(0.0, std::min(high, other_high) - std::max(low, other_low));
}

}  // namespace

TEST_CASE("blocks have their volumes in each cell, and none where they are not", "[promise:measure]") {
    const double size[] = {60, 10, 10};
    // Of the second grid, planes lie in faces of the blocks.
    for (const Sides& sides : {Sides{17, 3, 4}, Sides{12, 2, 2}, Sides{1, 1, 1}}) {
        const Measurement result = measured(blocks(), {.rel_error = 1e-3, .grid = sides});
        const MeasuredGrid& grid = result.grid;
        CHECK(grid.sides == sides);
        CHECK((grid.box.low == Vec3{0, 0, 0} && grid.box.high == Vec3{60, 10, 10}));
        std::map<std::pair<std::int32_t, std::array<std::int32_t, 3>>, double> truths;
        for (std::int32_t r = 0; r < 3; ++r) {
            const auto& [low, high] = boxes[static_cast<std::size_t>(r)];
            for (std::int32_t i = 0; i < int(sides[0]); ++i)
                for (std::int32_t j = 0; j < int(sides[1]); ++j)
                    for (std::int32_t k = 0; k < int(sides[2]); ++k) {
                        const auto at = [&](std::size_t axis, int n) { return n * size[axis] / sides[axis]; };
                        const double truth = shared(at(0, i), at(0, i + 1), low.x, high.x) *
                                             shared(at(1, j), at(1, j + 1), low.y, high.y) *
                                             shared(at(2, k), at(2, k + 1), low.z, high.z);
                        if (truth > 0) truths[{r, {i, j, k}}] = truth;
                    }
        }
        const CellVolumes& found = grid.regions;
        CAPTURE(sides);
        REQUIRE(found.ids.size() == truths.size());
        std::size_t inside = 0;
        for (std::size_t row = 0; row < found.ids.size(); ++row) {
            REQUIRE(truths.count({found.ids[row], found.cells[row]}) == 1);
            const double truth = truths.at({found.ids[row], found.cells[row]});
            const double off = std::abs(found.volumes[row] - truth), half_width = found.half_widths[row];
            CAPTURE(found.cells[row], truth, off, half_width);
            CHECK(half_width < 0.2 * truth);
            CHECK(off < 3 * half_width);
            inside += off < half_width;
        }
        CHECK(static_cast<double>(inside) > 0.85 * static_cast<double>(truths.size()));
        // Rows of materials have the sums of their regions.
        CHECK(std::is_sorted(grid.materials.ids.begin(), grid.materials.ids.end()));
        CHECK(grid.materials.ids.front() == 2);
        CHECK(grid.materials.ids.back() == 3);
        if (sides == Sides{1, 1, 1}) {
            REQUIRE(grid.materials.ids.size() == 2);
            CHECK(std::abs(grid.materials.volumes[1] - found.volumes[1] - found.volumes[2]) < 1e-9);
            CHECK(grid.materials.half_widths[1] < found.half_widths[1] + found.half_widths[2]);
        }
    }
}

TEST_CASE("a face in a plane of the grid leaves nothing beyond it", "[promise:measure]") {
    // Each of the three rods ends where the next one and the next cells begin, up to rounding.
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        const std::string name(1, static_cast<char>('a' + i));
        const double h = 0.7;
        scene.objects.push_back(
            test::solid(name, Tgc{{0.1, 0.2, 0.3 + i * h}, {0, 0, h}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}}));
        scene.objects.push_back(region(name + ".r", {leg(name)}));
    }
    const Measurement result = measured(scene, {.grid = {1, 1, 3}});
    CHECK(result.grid.regions.ids == std::vector{0, 1, 2});
    for (std::int32_t i = 0; i < 3; ++i) CHECK(result.grid.regions.cells.at(std::size_t(i))[2] == i);
}

TEST_CASE("a ball's cells have 95 % intervals", "[promise:measure]") {
    constexpr double r = 10, pi = std::numbers::pi;
    Scene scene = test::scene({test::ball("a", {1, 2, 3}, r), region("ball", {leg("a")})});
    const auto slab = [](double low, double high) {  // of the ball
        return pi * (r * r * (high - low) - (high * high * high - low * low * low) / 3);
    };
    std::size_t inside = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Measurement result = measured(scene, {.seed = seed, .grid = {2, 2, 5}});
        const CellVolumes& found = result.grid.regions;
        REQUIRE(found.ids.size() == 20);
        for (std::size_t row = 0; row < 20; ++row) {
            const double low = 4.0 * found.cells[row][2] - 10, truth = slab(low, low + 4) / 4;
            inside += std::abs(found.volumes[row] - truth) <= found.half_widths[row];
            ++all;
        }
    }
    CAPTURE(inside, all);
    CHECK(static_cast<double>(inside) > 0.92 * static_cast<double>(all));
    CHECK(static_cast<double>(inside) < 0.98 * static_cast<double>(all));
}

TEST_CASE("the volumes in the cells sum to the regions' and materials'", "[promise:measure]") {
    std::vector<Scene> scenes = {blocks()};
    for (test::Body& body : test::bodies()) scenes.push_back(std::move(body.scene));
    for (const Scene& scene : scenes) {
        // The first request takes rays through the whole model, the second one also rays of regions' own, with finer
        // grids, and the third one more replicates for the shell.
        for (const MeasureRequest& request :
             {MeasureRequest{.rays = 20000, .grid = {5, 6, 7}}, MeasureRequest{.rel_error = 5e-3, .grid = {9, 8, 1}},
              MeasureRequest{.rel_error = 7e-3, .grid = {2, 1, 3}}}) {
            const Measurement result = measured(scene, request);
            std::map<std::pair<MeasuredKind, std::int32_t>, double> sums;
            for (const auto& [kind, list] : {std::pair{MeasuredKind::region, &result.grid.regions},
                                             std::pair{MeasuredKind::material, &result.grid.materials}})
                for (std::size_t row = 0; row < list->ids.size(); ++row)
                    sums[{kind, list->ids[row]}] += list->volumes[row];
            for (const Measured& m : result.parts) {
                if (m.kind != MeasuredKind::region && m.kind != MeasuredKind::material) continue;
                CAPTURE(m.name, m.volume.value);
                CHECK(std::abs(sums[{m.kind, m.id}] - m.volume.value) <= 1e-12 * m.volume.value);
            }
        }
    }
}

TEST_CASE("cells have the same bits on every device and number of threads, and change no other", "[promise:measure]") {
    const Scene scene = blocks();
    const MeasureRequest request{.rel_error = 1e-3, .grid = {13, 5, 4}};
    const Measurement first = measured(scene, request);
    const std::string bytes = bytes_of(first);
    REQUIRE(bytes.size() > 1000);
    for (const unsigned threads : {1u, 2u, 16u})
        CHECK(bytes_of(measured(scene, request, {.device = "native", .threads = threads})) == bytes);
    CHECK(bytes_of(measured(scene, {.rel_error = 1e-3, .seed = 2, .grid = request.grid})) != bytes);
    const Measurement plain = measured(scene, {.rel_error = 1e-3});
    CHECK(plain.grid.sides == Sides{});
    CHECK(bytes_of(plain).empty());
    CHECK(plain.rays == first.rays);
    CHECK(plain.parts[0].volume.value == first.parts[0].volume.value);
    const MeasureRequest few{.rays = 5000, .grid = {13, 5, 4}};
    const std::string few_bytes = bytes_of(measured(scene, few));
    CHECK(bytes_of(measured(scene, few, {.reference = true})) == few_bytes);
    for (const DeviceInfo& device : devices())
        CHECK(bytes_of(measured(scene, few, {.device = device.name})) == few_bytes);
    Measurer measurer(Model(scene, {}, {.device = "native"}), {.device = "native"});
    CHECK(bytes_of(measurer.measure(request)) == bytes);
    CHECK(bytes_of(measurer.measure()).empty());
    CHECK(bytes_of(measurer.measure(request)) == bytes);
}

TEST_CASE("a renderer's own rays measure as a measurer's", "[promise:measure]") {
    const Settings settings{.device = "native"};
    Renderer renderer(Model(blocks(), {}, settings), settings);
    const MeasureRequest request{.rel_error = 1e-3, .grid = {3, 2, 1}};
    const Measurement result = Measurer(renderer).measure(request);
    CHECK(bytes_of(result) == bytes_of(measured(blocks(), request)));
    CHECK(result.parts[0].volume.value == measured(blocks(), request).parts[0].volume.value);
}

TEST_CASE("a grid of no cells, or of too many, is refused", "[promise:measure]") {
    const auto refusal = [](const Sides& sides) {
        const test::Thrown thrown = thrown_by([&] { measured(blocks(), {.grid = sides}); });
        CHECK(thrown.status == Status::usage);
        return thrown.text;
    };
    CHECK(test::says(refusal({3, 0, 4}), "needs 1 or more along x, y and z"));
    CHECK(test::says(refusal({0, 0, 4}), "needs 1 or more along x, y and z"));
    CHECK(test::says(refusal({4096, 4096, 2}), "16,777,216"));
    CHECK(test::says(refusal({0xffffffff, 0xffffffff, 0xffffffff}), "16,777,216"));
}
