// What a Model says of its solids' parameters: a solid of them, with no matrix, is met by rays at the same points.
#include <csgrt/edit.hpp>
#include <csgrt/scene_io.hpp>

#include <cmath>
#include <numbers>
#include <set>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "integration/samples.hpp"
#include "scene/vector.hpp"

using namespace csgrt;

namespace {

Matrix about_z(double degrees, double scale, const Vec3& to) {
    const double c = scale * std::cos(degrees * std::numbers::pi / 180),
                 s = scale * std::sin(degrees * std::numbers::pi / 180);
    return {c, -s, 0, to.x, s, c, 0, to.y, 0, 0, scale, to.z, 0, 0, 0, 1};
}
const Matrix about_x = {1, 0, 0, 0, 0, 0.8, -0.6, 0, 0, 0.6, 0.8, 0, 0, 0, 0, 1};
const Matrix mirrored = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
const Matrix sheared = {1, 0.3, 0, 2, 0, 0.7, 0.2, 0, 0, 0, 1.5, 1, 0, 0, 0, 1};

/// The scene of one solid of the samples, under a matrix.
Scene scene_under(const Object& solid, const Matrix& matrix) {
    Scene scene;
    scene.objects.push_back(solid);
    Combination part;
    part.name = "held";
    part.region = true;
    part.tree = tree(name_of(solid), matrix);
    scene.objects.push_back(part);
    scene.top = {"held"};
    return scene;
}

/// The boundaries along rays, all in a row.
std::vector<double> boundaries(const Model& model, const std::vector<Ray>& rays) {
    Partitions found;
    model.partitions(rays, found);
    std::vector<double> all;
    for (std::size_t i = 0; i < found.t_in.size(); ++i) all.insert(all.end(), {found.t_in[i], found.t_out[i]});
    return all;
}

/// Whether the parameters of the model's only solid are those of a solid that rays meet at the same places. A pipe is
/// several solids.
bool has_parameters(const Scene& scene) {
    const Model model(scene);
    if (model.solids().size() > 1) return false;
    const std::optional<Shape> shape = model.solid(0);
    if (!shape) return false;
    const std::vector<Ray> rays = test::random_rays(model.bounds(), 500);
    const Scene again = parse_scene(R"({"csgrt": 1, "solids": {"s": )" + json_text(*shape) + "}}", "again.json");
    const std::vector<double> expected = boundaries(model, rays), found = boundaries(Model(again), rays);
    CHECK(expected.size() > 200);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i] != expected[i]) REQUIRE(std::abs(found[i] - expected[i]) < 1e-9 * (1 + std::abs(expected[i])));
    return true;
}

}  // namespace

TEST_CASE("a model's solids have the parameters that their matrices give them") {
    const Scene samples = test::scene_of_samples();
    const std::set<std::string> any = {"ell", "sphere", "cylinder", "cone", "tgc",
                                       "box", "arb6",   "arbn",     "half", "limits"};  // an affine matrix keeps them
    std::size_t similar = 0;
    for (const Object& object : samples.objects) {
        const std::string name = name_of(object);
        if (name == "half") continue;  // it is not bounded
        INFO(name);
        const bool has_any = has_parameters(scene_under(object, identity));
        for (const Matrix& matrix :
             {about_z(30, 1, {1, 2, 3}), compose(about_x, about_z(75, 2.5, {4, 0, 0})), compose(mirrored, about_x)})
            CHECK(has_parameters(scene_under(object, matrix)) == has_any);
        CHECK(has_parameters(scene_under(object, sheared)) == (any.contains(name) && has_any));
        similar += has_any && !any.contains(name);
    }
    CHECK(similar >= 10);
}

TEST_CASE("a part that moves takes its solids' parameters along, and no other part's") {
    Scene scene;
    for (const char* name : {"first", "second"}) {
        scene.objects.push_back(Solid{name, Tor{{10, 0, 0}, {0, 0, 1}, 3, 1}, {}});
        scene.top.push_back(name);
    }
    Model model(scene);
    const auto at = [&](const Model& of, const std::string& name) {
        for (std::size_t i = 0; i < of.solids().size(); ++i)
            if (of.solids()[i].name == name) return std::get<Tor>(of.solid(i).value());
        throw std::logic_error("no such solid");
    };
    const Model moved = Edit(model).move("/second", about_z(90, 1, {0, 0, 5})).commit();
    const Model again = Edit(moved).move("/second", about_z(0, 1, {0, 0, 5})).commit();
    CHECK(at(model, "second").v.x == 10);
    CHECK(length(at(moved, "second").v - Vec3{0, 10, 5}) < 1e-12);
    CHECK(length(at(again, "second").v - Vec3{0, 10, 10}) < 1e-12);
    CHECK(at(again, "first").v.x == 10);
    CHECK_THROWS_AS(model.solid(2), Error);
}
