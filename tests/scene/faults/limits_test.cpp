// Limits: each is in docs/limits.md with its number; what is at it is accepted, and what is just past it refused. Other
// tests of this folder, of formats/json and of integration/field have those that are not here.
#include "catch.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>

#include <csgrt/renderer.hpp>

#include "compile/flatten/region_forest.hpp"
#include "integration/scenes.hpp"
#include "scene/instances.hpp"
#include "scene/faults/check_faults.hpp"
#include "scene/make_scene.hpp"
#include "scene/vector.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

const Vec3 none{}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

Settings on_reference(std::uint64_t max_instances = 0) { return {.reference = true, .max_instances = max_instances}; }

/// Names and numbers, in order. The text has them as `pattern` finds them.
std::vector<std::pair<std::string, double>> numbers_in(const std::string& path, const std::string& pattern) {
    std::ifstream file(path);
    std::vector<std::pair<std::string, double>> found;
    for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, std::regex(pattern))) continue;
        const std::string digits = std::regex_replace(match[2].str(), std::regex("[',]"), "");
        found.emplace_back(match[1], std::strtod(digits.c_str(), nullptr));
    }
    return found;
}

std::string refusal(const Scene& scene, const Settings& settings = on_reference()) {
    return test::thrown_by([&] { Renderer(scene, {}, settings); }).text;
}
using test::says;

double above(double number) { return std::nextafter(number, HUGE_VAL); }
double below(double number) { return std::nextafter(number, 0); }

/// Balls, `thousands` x 1,000 + `more` of them.
Scene balls(std::size_t thousands, std::size_t more) {
    const auto many = [](const char* name, std::size_t count) {
        return union_of(std::vector<std::string>(count, name));
    };
    return make_scene({ball("s"), combination("k", many("s", 1'000)), combination("few", many("s", more)),
                       combination("all", many("k", thousands)), combination("top", union_of({"all", "few"}))});
}

}  // namespace

TEST_CASE("limits: docs/limits.md has each of them with its number", "[promise:limits]") {
    const std::string root = test::folder("CSGRT_SCENES") + "/..";
    const auto limits =
        numbers_in(root + "/include/csgrt/scene.hpp", "^    static constexpr [a-z0-9:_]+ ([a-z_]+) = ([0-9.e'-]+);");
    CHECK(limits.size() == 22);
    CHECK(numbers_in(root + "/docs/limits.md", "^\\| `([a-z_]+)` \\| ([0-9.e,-]+) \\|") == limits);
}

TEST_CASE("limits: instances", "[promise:limits]") {
    const auto found = [](std::size_t thousands, std::size_t more, std::uint64_t max_instances) {
        return validate(balls(thousands, more), {}, false, nullptr, max_instances).size();
    };
    CHECK(found(299, 1'000, 0) == 0);
    CHECK(found(299, 1'001, 0) == 1);
    CHECK(found(19'999, 1'000, Limits::most_instances) == 0);
    CHECK(found(19'999, 1'001, Limits::most_instances) == 1);
    CHECK(refusal(balls(1, 2), on_reference(1'002)).empty());
    CHECK(says(refusal(balls(1, 3), on_reference(1'002)), "'top' expands to 1003 instances; at most 1002 are allowed"));
    CHECK(says(refusal(balls(1, 1), on_reference(Limits::most_instances + 1)),
               "the setting max_instances is 20000001, and must be from 1 to 20000000"));
}

TEST_CASE("limits: solids of many parts count as docs/limits.md says", "[promise:limits]") {
    const auto count = [](Shape shape, std::string name = "s") {
        return instances_of({std::move(name), std::move(shape), {}});
    };
    const auto points = [](Metaball::Method method) { return Metaball{method, 1, std::vector<Metaball::Point>(10)}; };
    CHECK(count(Ell{}) == 1);
    CHECK(count(Ell{}, std::string(2'100, 'n')) == 3);
    CHECK(count(Hrt{}) == 150);
    CHECK(count(Arbn{std::vector<Plane>(1'300)}) == 3'900);
    CHECK(count(Pipe{std::vector<Pipe::Point>(10)}) == 80);
    CHECK(count(points(Metaball::Method::metaball)) == 18);
    CHECK(count(points(Metaball::Method::blob)) == 88);
    CHECK(count(points(Metaball::Method::isopotential)) == 1'610);
    Sketch sketch;
    sketch.curves.resize(10);
    CHECK(count(Extrude{none, z, x, y, sketch}) == 18);
    CHECK(count(Revolve{none, z, x, 1, sketch}) == 18);
    Bot bot;
    bot.faces.resize(640);
    CHECK(count(bot) == 10);
    CHECK(count(Ars{std::vector(20, std::vector<Vec3>(32))}) == 10);
    CHECK(count(Nmg{std::vector<Vec3>(640), {}}) == 10);
    CHECK(count(Ebm{"", 640, 1, 1, identity, std::vector<std::uint8_t>(640)}) == 18);
    CHECK(count(Vol{"", 5, 1, 1, 1, 1, {1, 1, 1}, identity, {0, 1, 0, 1, 0}}) == 3);
    CHECK(count(Dsp{"", 20, 1, false, Dsp::Cut::adaptive, identity, std::vector<std::uint16_t>(20)}) == 10);
}

TEST_CASE("limits: bytes of paths", "[promise:limits]") {
    CHECK_NOTHROW(check_path_bytes(Limits::path_bytes));
    CHECK_THROWS_WITH(check_path_bytes(Limits::path_bytes + 1), Catch::Contains("more than 256000000 bytes"));
}

TEST_CASE("limits: parts of solids", "[promise:limits]") {
    std::vector<Plane> cube = {{x, 1}, {y, 1}, {z, 1}, {-1 * x, 1}, {-1 * y, 1}, {-1 * z, 1}};
    cube.resize(Limits::faces, {z, 1});
    check_sound(Arbn{cube});
    cube.push_back({z, 1});
    check_fault(Arbn{cube}, "it has 16385 planes; at most 16384");
    check_fault(Ebm{"", Limits::cells, 1, 1, identity, {1}}, "200000000 x 1 are 200000000 cells, found 1");
    check_fault(Ebm{"", Limits::cells + 1, 1, 1, identity, {1}}, "at most 200000000");
    const auto steep = [](std::uint32_t degree) {
        std::vector<std::uint32_t> points(degree + 1, 1);
        points.front() = 0;
        points.back() = 2;
        return Extrude{none, z, x, y, {"", {{0, 0}, {1, 0}, {0, 1}}, {Sketch::Bezier{points}, Sketch::Line{2, 0}}, {}}};
    };
    check_sound(steep(Limits::curve_degree));
    check_fault(steep(Limits::curve_degree + 1), "is of degree 13; at most 12");
    check_sound(Superell{none, x, y, z, Limits::least_exponent, Limits::greatest_exponent});
    check_fault(Superell{none, x, y, z, below(Limits::least_exponent), 1}, "from 1/100 to 20");
    check_fault(Superell{none, x, y, z, 1, above(Limits::greatest_exponent)}, "from 1/100 to 20");
}

TEST_CASE("limits: sizes, and the finish", "[promise:limits]") {
    const auto refusal_of = [](const Vec3& center, double radius) {
        return refusal(make_scene({solid("s", Ell{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}})}));
    };
    CHECK(refusal_of({0, 0, 0}, Limits::length).empty());
    CHECK(says(refusal_of({0, 0, 0}, above(Limits::length)), "the largest size"));
    CHECK(refusal_of({Limits::length, 0, 0}, 1).empty());
    CHECK(says(refusal_of({above(Limits::length), 0, 0}, 1), "the largest size"));
    const double least = Limits::least_length / (2 * std::sqrt(3.0));  // the radius whose box has that diagonal
    CHECK(refusal_of({0, 0, 0}, 1.000001 * least).empty());
    CHECK(says(refusal_of({0, 0, 0}, 0.999999 * least), "the least size"));
    for (const int shine : {Limits::shine, Limits::shine + 1}) {
        Combination region = std::get<Combination>(combination("r", union_of({"s"})));
        region.region = true;
        region.finish = Finish{};
        region.finish->shine = shine;
        CHECK(says(refusal(make_scene({ball("s"), region})), "'shine'") == (shine > Limits::shine));
    }
}

TEST_CASE("limits: rays", "[promise:limits]") {
    Renderer renderer(make_scene({ball("s")}), {}, on_reference());
    const auto is_refused = [&](const Ray& ray) {
        return test::thrown_by([&] { renderer.shoot({ray}); }).status != Status::ok;
    };
    for (const bool past : {false, true}) {
        CHECK(is_refused({{past ? above(Limits::ray_origin) : Limits::ray_origin, 0, 0}, x}) == past);
        CHECK(is_refused({none, {past ? above(Limits::greatest_direction) : Limits::greatest_direction, 0, 0}}) ==
              past);
        CHECK(is_refused({none, {past ? below(Limits::least_direction) : Limits::least_direction, 0, 0}}) == past);
    }
}

TEST_CASE("limits: triangles of a mesh", "[.long][promise:limits]") {
    Bot bot{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    bot.faces.resize(Limits::triangles, {0, 1, 2});
    check_sound(bot);
    bot.faces.push_back({0, 1, 2});
    check_fault(bot, "at most 20000000");
}
