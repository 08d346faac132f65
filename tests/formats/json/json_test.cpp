// The scene format: what each form means, and where its mistakes are reported.
#include "catch.hpp"

#include <cmath>

#include "formats/json/simple_solids.hpp"
#include "formats/json/parse_text.hpp"
#include "formats/same_scene.hpp"
#include "scene/vector.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

const std::string ball = R"({"type": "sphere", "center": [1, 2, 3], "radius": 4})";

bool near(const Vec3& a, const Vec3& b, double gap = 1e-15) { return length(a - b) <= gap; }

std::string one_matrix(const Tree& tree) {
    REQUIRE(tree.nodes.size() == 1);
    std::string text;
    for (const double number : tree.nodes[0].matrix) text += (text.empty() ? "" : " ") + std::to_string(number);
    return text;
}

}  // namespace

TEST_CASE("json: settings", "[promise:scenes]") {
    const Scene scene = scene_of(R"({
        "csgrt": 1, "title": "t", "units": "cm", "ambient": 0.5, "background": [0, 0.5, 1], "tolerance": 0.01,
        "camera": {"azimuth": 1, "elevation": 2, "perspective": 3, "center": [4, 5, 6], "size": 7},
        "lights": [{"position": [1, 2, 3], "color": [1, 0, 0], "intensity": 2}, {"position": [0, 0, 0]}],
        "solids": {"s": )" + ball +
                                 R"(}, "objects": ["s"],
        "region_colors": [{"low": 1, "high": 2, "color": [0, 1, 0]}]
    })");
    CHECK(scene.title == "t");
    CHECK(scene.units == "cm");
    CHECK(scene.unit_length == 10);
    CHECK(scene.ambient == 0.5);
    CHECK(scene.background == Vec3{0, 0.5, 1});
    CHECK(scene.tolerance == 0.1);
    CHECK(scene.camera.azimuth == 1);
    CHECK(scene.camera.elevation == 2);
    CHECK(scene.camera.perspective == 3);
    CHECK(scene.camera.center == Vec3{40, 50, 60});
    CHECK(scene.camera.view_size == 70);
    REQUIRE(scene.lights.size() == 2);
    CHECK(scene.lights[0].position == Vec3{10, 20, 30});
    CHECK(scene.lights[0].color == Vec3{1, 0, 0});
    CHECK(scene.lights[0].intensity == 2);
    CHECK(scene.lights[1].intensity == 1);
    CHECK(scene.top == std::vector<std::string>{"s"});
    REQUIRE(scene.region_colors.size() == 1);
    CHECK(scene.region_colors[0].high == 2);
}

TEST_CASE("json: what is rendered may be placed as a leg is", "[promise:scenes]") {
    const std::string head = R"({"csgrt": 1, "units": "cm", "solids": {"s": )" + ball + R"(, "t": )" + ball + "}, ";
    const Scene scene = scene_of(head + R"("objects": ["s", {"object": "t", "scale": 2, "translate": [1, 2, 3]}]})");
    CHECK(scene.top == std::vector<std::string>{"s", "t"});
    REQUIRE(scene.top_matrices.size() == 2);
    CHECK(scene.top_matrices[0] == identity);
    CHECK(scene.top_matrices[1] == Matrix{2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1});
    CHECK(scene_of(head + R"("objects": ["s", {"object": "t"}]})").top_matrices.empty());
    for (const auto& [objects, message] : {std::pair{R"([{"object": "u"}])", "there is no object 'u'"},
                                           std::pair{R"([{"translate": [1, 2, 3]}])", "'object'"},
                                           std::pair{R"([{"object": "t", "name": "x"}])", "'name'"},
                                           std::pair{R"([{"object": "t", "scale": 0}])", "a scale must not be 0"}})
        CHECK(test::says(
            test::failure(Status::scene, [&, of = objects] { scene_of(head + "\"objects\": " + of + "}"); }), message));
}

TEST_CASE("json: cylinders and cones stand upright on their base, round") {
    for (const char* height : {"[0, 0, 2]", "[0, -3, 0]", "[1, 2, -3]", "[1e-3, 5, 1e6]"}) {
        const Tgc cone = std::get<Tgc>(shape_of(std::string(R"({"type": "cone", "base": [0, 0, 0], "height": )") +
                                                height + R"(, "radius": 5, "top_radius": 2})"));
        const Vec3 u = unit(cone.h);
        CHECK(std::abs(length(cone.a) - 5) < 1e-14);
        CHECK(std::abs(length(cone.b) - 5) < 1e-14);
        CHECK(std::abs(dot(cone.a, cone.b)) < 1e-13);
        CHECK(std::abs(dot(cone.a, u)) < 1e-14);
        CHECK(std::abs(dot(cone.b, u)) < 1e-14);
        CHECK(near(cone.c, 0.4 * cone.a, 1e-14));
        CHECK(near(cone.d, 0.4 * cone.b, 1e-14));
    }
    // Along an axis the circle's axes are exact, so that equal cylinders are equal to the bit.
    const Tgc upright =
        std::get<Tgc>(shape_of(R"({"type": "cylinder", "base": [0, 0, 0], "height": [0, 0, 3], "radius": 0.1})"));
    CHECK(upright.a == Vec3{0.1, 0, 0});
    CHECK(upright.b == Vec3{0, 0.1, 0});
    const Tgc pointed =
        std::get<Tgc>(shape_of(R"({"type": "cone", "base": [0, 0, 0], "height": [0, 0, 3], "radius": 1})"));
    CHECK(pointed.c == Vec3{});
}

TEST_CASE("json: arbs of fewer vertices repeat them in BRL-CAD's order", "[promise:scenes]") {
    const auto vertices = [](int count) {
        std::string list;
        for (int i = 0; i < count; ++i) list += (i ? ", [" : "[") + std::to_string(i) + ", 0, 0]";
        const std::string name = "arb" + std::to_string(count);
        const Arb solid = std::get<Arb>(shape_of(R"({"type": ")" + name + R"(", "vertices": [)" + list + "]}"));
        std::string order;
        for (const Vec3& vertex : solid.vertices) order += std::to_string(static_cast<int>(vertex.x));
        return order;
    };
    CHECK(vertices(4) == "01203333");
    CHECK(vertices(5) == "01234444");
    CHECK(vertices(6) == "01234455");
    CHECK(vertices(7) == "01234564");
    CHECK(vertices(8) == "01234567");
}

TEST_CASE("json: every length is in the file's units, no direction and no factor is", "[promise:scenes]") {
    CHECK(
        same_shape(shape_of(R"({"type": "tor", "center": [1, 0, 0], "axis": [0, 0, 1], "radius": 2, "tube": 1})", "in"),
                   Tor{{25.4, 0, 0}, {0, 0, 1}, 50.8, 25.4}));
    CHECK(std::get<Half>(shape_of(R"({"type": "half", "normal": [1, 0, 0], "distance": 2})", "m")).plane.distance ==
          2000);
    CHECK(one_matrix(tree_of(R"({"object": "a", "translate": [1, 2, 3], "scale": 2})", "cm")) ==
          one_matrix(tree_of(R"({"object": "a", "matrix": [2, 0, 0, 10, 0, 2, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1]})")));
    CHECK(tree_of(R"({"object": "a", "matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})", "ft")
              .nodes[0]
              .matrix[3] == 304.8);
}

TEST_CASE("json: trees become postfix, with a place for each node") {
    const Tree tree = tree_of(R"({"difference": ["a", {"union": ["b", {"not": "c"}]}, {"object": "d"}]})");
    std::string text;
    for (const TreeNode& node : tree.nodes) {
        text += node.object + std::to_string(static_cast<int>(node.op)) + "/" + std::to_string(node.arity) + " ";
    }
    CHECK(text == "a0/0 b0/0 c0/0 5/1 1/2 d0/0 3/3 ");
    CHECK(tree.nodes[2].place.pointer == "/combinations/c/tree/difference/1/union/1/not");
    CHECK(tree.nodes[0].place.line == 1);
    CHECK(tree_of("null").nodes.empty());
    CHECK(tree_of(R"({"postfix": ["a", "b", {"operator": "xor", "operands": 2}]})").nodes.size() == 3);
}

TEST_CASE("json: placement is scale, then rotation, then translation, and from the outside in", "[promise:scenes]") {
    CHECK(one_matrix(tree_of(
              R"({"object": "a", "rotate": {"axis": [0, 0, 2], "angle": 90}, "scale": [2, 3, 4],
                "translate": [5, 6, 7]})")) ==
          one_matrix(tree_of(R"({"object": "a", "matrix": [0, -3, 0, 5, 2, 0, 0, 6, 0, 0, 4, 7, 0, 0, 0, 1]})")));
    const Tree nested =
        tree_of(R"({"union": [{"object": "a", "translate": [1, 0, 0]}], "rotate": {"axis": [0, 0, 1], "angle": 180}})");
    REQUIRE(nested.nodes.size() == 2);
    CHECK(nested.nodes[0].matrix == Matrix{-1, 0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

TEST_CASE("json: quarter turns are exact, others are rotations", "[promise:scenes]") {
    for (const double angle : {90., -90., 180., 270., 360., 450., -180.}) {
        const Tree tree =
            tree_of(R"({"object": "a", "rotate": {"axis": [1, 0, 0], "angle": )" + std::to_string(angle) + "}}");
        for (const double number : tree.nodes[0].matrix) CHECK(number == std::trunc(number));
    }
    const Matrix m = tree_of(R"({"object": "a", "rotate": {"axis": [1, 2, -2], "angle": 40}})").nodes[0].matrix;
    const Vec3 x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]}, axis{1, 2, -2};
    CHECK(near(cross(x, y), z));
    CHECK(std::abs(dot(x, y)) < 1e-15);
    CHECK(std::abs(length(x) - 1) < 1e-15);
    CHECK(near({dot({m[0], m[1], m[2]}, axis), dot({m[4], m[5], m[6]}, axis), dot({m[8], m[9], m[10]}, axis)}, axis));
    CHECK(std::abs((m[0] + m[5] + m[10] - 1) / 2 - std::cos(40 * std::acos(-1) / 180)) < 1e-15);
}

TEST_CASE("json: combinations and materials") {
    const Vec3 red{1, 0, 0};
    const Scene scene = scene_of(R"({"csgrt": 1,
        "materials": {"red": {"color": [1, 0, 0]}, "dull": {"specular": 0, "shine": 3}},
        "combinations": {
            "a": {"tree": null, "region": true, "id": 7, "air": 1, "material_id": 2, "los": 50, "material": "red",
                "inherit": ["color"]},
            "b": {"tree": null, "material": "dull", "inherit": ["finish"]},
            "c": {"tree": null, "material": {"color": [0, 1, 0], "shader": "glass", "transmit": 0.8}},
            "d": {"tree": null}
        }})");
    const auto is = [&](std::size_t i, const Combination& expected) {
        INFO(i);
        CHECK(same_attributes(std::get<Combination>(scene.objects[i]), expected));
    };
    is(0,
       {.region = true, .region_id = 7, .air = 1, .material_id = 2, .los = 50, .color = red, .color_inherits = true});
    is(1, {.finish = Finish{.specular = 0, .shine = 3}, .finish_inherits = true});
    is(2, {.color = Vec3{0, 1, 0}, .finish = Finish{.shader = "glass", .transmit = 0.8}});
    is(3, {.material_id = 1, .los = 100});
}

TEST_CASE("json: the order of objects is that of the file, or the one that is given") {
    const std::string solids = R"("solids": {"s": )" + ball + R"(, "t": )" + ball + "}";
    const std::string combinations = R"("combinations": {"c": {"tree": "s"}})";
    const auto names = [](const std::string& text) {
        std::string list;
        for (const Object& object : scene_of(text).objects) list += name_of(object);
        return list;
    };
    CHECK(names(R"({"csgrt": 1, )" + solids + ", " + combinations + "}") == "stc");
    CHECK(names(R"({"csgrt": 1, )" + combinations + ", " + solids + "}") == "cst");
    CHECK(names(R"({"csgrt": 1, "order": ["t", "c", "s"], )" + solids + ", " + combinations + "}") == "tcs");
}

TEST_CASE("json: places count from the first byte of a value, after a byte order mark as well") {
    const auto found = findings_of(
        "\xEF\xBB\xBF{\"csgrt\": 1, \"solids\": {\n\t\"a/b~\": {\"type\": \"sphere\", \"center\": [0, 0, 0],\r\n  "
        "\"radius\": -2}}}");
    REQUIRE(found.size() == 1);
    CHECK(found[0].place.file == "scene.json");
    CHECK(found[0].place.line == 3);
    CHECK(found[0].place.column == 13);
    CHECK(found[0].place.pointer == "/solids/a~1b~0/radius");
    CHECK(found[0].excerpt == "  \"radius\": -2}}}\n            ^");

    const auto at_start = findings_of("\xEF\xBB\xBF[1]");
    REQUIRE(at_start.size() == 1);
    CHECK(at_start[0].place.column == 4);
}

TEST_CASE("json: the place of every value is where it starts, whatever stands before it") {
    // Values of every kind behind each other, so that none hides that the one before ended too late.
    for (const char* filler :
         {"0", "-1.5e3", "true", "null", "\"a\\\"b\\\\\"", "[]", "{}", "[1,[2]]", "{\"x\":{\"y\":3}}"}) {
        for (const char* gap : {",", " , ", ",\n", "\t,\r\n"}) {
            const std::string before = std::string("{\"csgrt\":1,\"objects\":[") + filler + gap;
            std::vector<Diagnostic> found = findings_of(before + "false]}");
            const Diagnostic& last = found.back();
            INFO(before);
            CHECK(last.place.pointer == "/objects/1");
            const std::size_t line_start =
                before.find_last_of('\n') == std::string::npos ? 0 : before.find_last_of('\n') + 1;
            CHECK(last.place.column == static_cast<int>(before.size() - line_start + 1));
        }
    }
}

TEST_CASE("json: numbers are read to the last bit, signs of zeros too") {
    const Ell ell = std::get<Ell>(shape_of(
        R"({"type": "ell", "center": [-0, -0.0, 0], "a": [0.1, 1e-320, 123456789012345678901234567890],
            "b": [1.7976931348623157e308, 5e-324, 1e-400], "c": [9007199254740993, 1, 1]})"));
    CHECK(std::signbit(ell.v.x));
    CHECK(std::signbit(ell.v.y));
    CHECK_FALSE(std::signbit(ell.v.z));
    CHECK(ell.a == Vec3{0.1, 1e-320, 123456789012345678901234567890.0});
    CHECK(ell.b == Vec3{1.7976931348623157e308, 5e-324, 0});
    CHECK(ell.c.x == 9007199254740992.0);
}

TEST_CASE("json: brackets nest up to the limit, and no deeper", "[promise:limits]") {
    const auto nested = [](std::size_t depth) {
        std::string text = R"({"csgrt": 1, "combinations": {"c": {"tree": )";  // three brackets
        for (std::size_t i = 3; i < depth; ++i) text += "{\"not\": ";
        text += "\"a\"";
        return text + std::string(depth, '}');
    };
    CHECK(findings_of(nested(Limits::file_nesting)).empty());
    const auto found = findings_of(nested(Limits::file_nesting + 1));
    REQUIRE(found.size() == 1);
    CHECK(found[0].message.find("more than 512 deep") != std::string::npos);
    CHECK(findings_of(std::string(1'000'000, '[')).size() == 1);
}

TEST_CASE("json: every mistake of a file is reported, in the order of the file", "[promise:refusals]") {
    const auto found = findings_of(R"({"csgrt": 1, "titel": "t",
        "solids": {"a": {"type": "sphere", "center": [0, 0], "radius": 0},
                   "b": {"type": "box", "low": [0, 0, 0]},
                   "a": 3},
        "combinations": {"c": {"tree": {"difference": ["a"]}, "region": "yes", "material": "none"}},
        "objects": ["d"]})");
    std::string places;
    for (const Diagnostic& finding : found) places += finding.place.pointer + " ";
    CHECK(places ==
          "/titel /solids/a/center /solids/a/radius /solids/b /solids/a /combinations/c/tree/difference "
          "/combinations/c/region /combinations/c/material /objects/0 ");
}

TEST_CASE("json: a thousand mistakes are cut off") {
    std::string text = R"({"csgrt": 1, "objects": [0)";
    for (int i = 0; i < 1000; ++i) text += ",0";
    CHECK(findings_of(text + "]}").size() == FindingList::most + 1);  // the last tells how many more
}
