// What is written reads back to the same bits: made-up scenes, the examples, and BRL-CAD's models.
#include "catch.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include <csgrt/scene_io.hpp>

#include "formats/json/simple_solids.hpp"
#include "formats/json/parse_text.hpp"
#include "formats/json/write/writer.hpp"
#include "formats/json/random_shape.hpp"
#include "formats/same_scene.hpp"
#include "integration/scenes.hpp"
#include "scene/make_scene.hpp"
#include "sanitized.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

void check_round_trip(const Scene& scene) {
    const std::string text = json_scene_text(scene);
    const Scene again = scene_of(text);
    CHECK(same_scene(scene, again));
    CHECK(json_scene_text(again) == text);
}

Matrix random_matrix(Numbers& n) {
    Matrix m = identity;
    if (n.coin()) m[3] = n();
    if (n.coin()) {
        for (std::size_t k = 0; k < 12; ++k) m[k] = n();
    }
    return m;
}

Tree random_tree(Numbers& n) {
    Tree tree;
    std::size_t waiting = 0;
    const std::size_t leaves = n.below(12);
    for (std::size_t i = 0; i < leaves; ++i) {
        tree.nodes.push_back(leaf("object " + std::to_string(i), random_matrix(n)));
        ++waiting;
        if (n.coin()) tree.nodes.push_back(node(Operator::not_, 1));
        if (waiting >= 2 && n.coin()) {
            const auto arity = static_cast<std::uint32_t>(2 + n.below(waiting - 1));
            tree.nodes.push_back(node(static_cast<Operator>(1 + n.below(4)), arity));
            waiting -= arity - 1;
        }
    }
    if (waiting > 1) tree.nodes.push_back(node(Operator::union_, static_cast<std::uint32_t>(waiting)));
    return tree;
}

Scene random_scene(unsigned seed) {
    Numbers n(seed);
    Scene scene{.title = "a title with \"quotes\", \t and \u4e16\u754c"};
    const auto [name, length] = std::array{std::pair{"mm", 1.0}, std::pair{"in", 25.4}, std::pair{"m", 1000.0},
                                           std::pair{"cubit", 457.2}, std::pair{"in", 25.3}}[n.below(5)];
    scene.units = name;
    scene.unit_length = length;
    if (n.coin()) scene.camera = {n(), n(), 30, n.vector(), 1e-3};
    if (n.coin()) scene.lights = {{n.vector(), n.color(), 0.25}, {n.vector(), n.color(), 2}};
    if (n.coin()) scene.lights.push_back({n.vector(), n.color(), 1, n.coin(), 30, n.direction()});
    if (n.coin()) {
        scene.camera = Camera();
        scene.camera.perspective = n.coin() ? 30 : 0;
        scene.camera.eye = n.vector();
        if (n.coin()) scene.camera.look_at = n.vector();
        if (n.coin()) scene.camera.up = n.direction();
    }
    if (n.coin()) scene.ambient = 0.1;
    if (n.coin()) scene.background = n.color();
    if (n.coin()) scene.tolerance = 0;
    if (n.coin()) scene.region_colors = {{-5, n.integer(), n.color()}};
    if (n.coin()) scene.densities = {{n.integer(), {}, 7.85, "steel"}, {0, "/all/", n.color().x}};
    for (int i = 0; i < 12; ++i) {
        const std::string object = "object " + std::to_string(i);
        if (n.coin()) {
            scene.objects.push_back(solid(object, random_shape(n)));
            continue;
        }
        Combination c = std::get<Combination>(combination(object, random_tree(n)));
        c.region = n.coin();
        c.region_id = n.integer();
        c.air = n.coin() ? 0 : n.integer();
        c.fastgen = n.coin() ? Fastgen::none : n.coin() ? Fastgen::plate : Fastgen::volume;
        c.material_id = n.integer();
        c.los = n.coin() ? 100 : 0;
        if (n.coin()) c.color = n.color();
        if (n.coin()) c.finish = Finish();
        if (n.coin()) c.finish = Finish{"glass", 0.1, n.color().x, 2, 10000, n.coin() ? 0.5 : -0.0, 0};
        if (n.coin()) {
            c.finish = Finish{.shader = "light", .light = Emission{n.color().x + 0.1, n.color().x, 180 * n.color().x}};
            if (n.coin()) c.finish->light->target = n.vector();
            if (n.coin()) c.finish->light->direction = n.direction();
            c.finish->light->infinite = n.coin();
            c.finish->light->visible = n.coin();
            c.finish->light->shadows = n.coin() ? 1 : 16;
        }
        c.color_inherits = n.coin();
        c.finish_inherits = n.coin();
        scene.objects.push_back(c);
    }
    if (n.coin()) scene.top = {"object 3", "object 0"};
    if (!scene.top.empty() && n.coin()) scene.top_matrices = {random_matrix(n), identity};
    if (!scene.top_matrices.empty() && scene.top_matrices[0] == identity) scene.top_matrices.clear();
    return scene;
}

}  // namespace

TEST_CASE("json round trip: made-up scenes in all units") {
    for (int seed = 0; seed < test::tries(300); ++seed) {
        INFO(seed);
        check_round_trip(random_scene(static_cast<unsigned>(seed)));
    }
}

TEST_CASE("json round trip: friendly solids stay friendly, and others keep their bits") {
    const auto type = [](const Shape& shape) {
        const std::string text = json_scene_text(make_scene({solid("s", shape)}));
        const std::size_t begin = text.find("\"type\": \"") + 9;
        return text.substr(begin, text.find('"', begin) - begin);
    };
    CHECK(type(sphere({1, 2, 3}, 0.1)) == "sphere");
    CHECK(type(Ell{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}) == "ell");
    CHECK(type(Ell{{}, {1, -0.0, 0}, {0, 1, 0}, {0, 0, 1}}) == "ell");
    CHECK(type(cone({}, {0, 0, 5}, 2, 2)) == "cylinder");
    CHECK(type(cone({}, {5, 0, 0}, 2, 0)) == "cone");
    CHECK(type(Tgc{{}, {0, 0, 5}, {1, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 2, 0}}) == "tgc");
    CHECK(type(box({0, 0, 0}, {1, 2, 3})) == "box");
    CHECK(type(arb({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})) == "arb4");
    CHECK(type(arb({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}})) == "arb6");
}

TEST_CASE("json round trip: every type of solid, in all units", "[promise:round-trip]") {
    constexpr std::size_t types = std::variant_size_v<Shape::variant>;
    Numbers n(11);
    for (std::size_t type = 0; type < types; ++type) {
        for (int i = 0; i < test::tries(40); ++i) {
            Scene scene = make_scene({solid("s", random_shape(n, type))});
            INFO(type_name(std::get<Solid>(scene.objects[0]).shape));
            REQUIRE(std::get<Solid>(scene.objects[0]).shape.index() == type);
            if (i % 2 == 1) {
                scene.units = i % 4 == 1 ? "in" : "cm";
                scene.unit_length = i % 4 == 1 ? 25.4 : 10;
            }
            check_round_trip(scene);
        }
    }
}

TEST_CASE("json round trip: units are kept where that is exact, and named where it is not", "[promise:round-trip]") {
    Scene scene = make_scene({solid("s", sphere({25.4, 0, 0}, 50.8))});
    scene.units = "in";
    scene.unit_length = 25.4;
    const std::string inches = json_scene_text(scene);
    CHECK(inches.find("\"units\": \"in\"") != std::string::npos);
    CHECK(inches.find("\"radius\": 2") != std::string::npos);
    check_round_trip(scene);

    // A number that no double times 25.4 gives. Above 1.5875 = 25.4 / 16 there are some: the products' steps are longer
    // than the numbers' own.
    double odd = 1.6;
    const auto reachable = [](double v) {
        const double x = v / 25.4;
        return x * 25.4 == v || std::nextafter(x, 0.0) * 25.4 == v || std::nextafter(x, 1e9) * 25.4 == v;
    };
    while (reachable(odd)) odd = std::nextafter(odd, 2);
    std::get<Ell>(std::get<Solid>(scene.objects[0]).shape).v.x = odd;
    const std::string millimetres = json_scene_text(scene);
    CHECK(millimetres.find("\"units\": \"mm\"") != std::string::npos);
    CHECK(millimetres.find("\"model_units\": {\"name\": \"in\", \"millimetres\": 25.4}") != std::string::npos);
    check_round_trip(scene);
}

TEST_CASE("json round trip: trees too deep to nest", "[promise:round-trip]") {
    for (const std::size_t depth : {99U, 100U, 101U, 5000U}) {
        Tree tree{{leaf("a")}};
        for (std::size_t i = 0; i < depth; ++i) {
            tree.nodes.push_back(leaf("a"));
            tree.nodes.push_back(node(Operator::union_, 2));
        }
        const Scene scene = make_scene({ball("a"), combination("deep", tree)});
        CHECK((json_scene_text(scene).find("postfix") != std::string::npos) == (depth > 100));
        check_round_trip(scene);
    }
}

TEST_CASE("json round trip: what JSON cannot hold is refused, all of it at once") {
    const auto refused = [](const Scene& scene) {
        const test::Thrown thrown = test::thrown_by([&] { json_scene_text(scene); });
        CHECK((thrown.status == Status::scene || thrown.status == Status::ok));
        return thrown.findings.size();
    };
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(make_scene({ball("a", not_a_number), ball("b"), ball("c", not_a_number)})) == 2);
    CHECK(refused(make_scene({ball("a"), ball("a")})) == 1);
    CHECK(refused(make_scene({ball("caf\xe9")})) == 1);
    CHECK(refused(make_scene({ball("")})) == 1);
    CHECK(refused(make_scene({combination("c", Tree{{leaf("a"), leaf("b")}})})) == 1);
    CHECK(refused(make_scene({combination("c", Tree{{node(Operator::union_, 1)}})})) == 1);
    Scene scene = make_scene({ball("a")});
    scene.camera.azimuth = not_a_number;
    CHECK(refused(scene) == 1);
    scene.camera.azimuth = 0;
    CHECK(refused(scene) == 0);
}

TEST_CASE("json round trip: the examples") {
    const std::vector<std::string> files = test::scene_files();
    for (const std::string& file : files) {
        INFO(file);
        const Scene scene = load_scene(file);
        CHECK(validate(scene).empty());
        CHECK_FALSE(scene.title.empty());
        check_round_trip(scene);
    }
    CHECK((files.empty() || files.size() >= 12));
}

TEST_CASE("json round trip: BRL-CAD's models", "[promise:round-trip]") {
    const std::string models = test::folder("CSGRT_BRLCAD");
    if (models.empty()) return;
    for (const auto& entry : std::filesystem::directory_iterator(models)) {
        if (entry.path().extension() != ".asc" && entry.path().extension() != ".g") continue;
        // One form of each, and not the two greatest.
        if (test::sanitized && (entry.path().extension() == ".asc" || entry.file_size() > 400'000)) continue;
        INFO(entry.path().filename());
        check_round_trip(load_scene(entry.path().string()));
    }
}
