// csgrt.h refuses what is wrong with a status, a text and a place; and its defaults are those of C++.
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "c/call.hpp"
#include "c/owned.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

csgrt_member number(const char* name, const double& value) { return {name, &value, 1, 0, nullptr}; }

constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();

/// Each number of `numbers`, which are doubles or structs of nothing else, in turn is none, or has no end: then call()
/// must refuse it.
template <class Call, class... Numbers>
void check_no_end(const char* what, const Call& call, Numbers&... numbers) {
    std::vector<double*> all;
    const auto add = [&](double* first, std::size_t bytes) {
        for (std::size_t i = 0; i < bytes / sizeof(double); ++i) all.push_back(first + i);
    };
    (add(reinterpret_cast<double*>(&numbers), sizeof numbers), ...);
    REQUIRE_OK(call());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const double bad : {none, infinite, -infinite}) {
            INFO(what << ", number " << i << " is " << bad);
            const double good = std::exchange(*all[i], bad);
            const int status = call();
            CHECK((status == CSGRT_ERROR_USAGE || status == CSGRT_ERROR_SCENE));
            *all[i] = good;
        }
}

}  // namespace

TEST_CASE("defaults of structs in C are those of C++") {
    const csgrt_settings settings CSGRT_SETTINGS;
    const Settings s = c::settings_of(&settings), d;
    CHECK((s.reference == d.reference && s.device == d.device && s.wait_for_device == d.wait_for_device));
    CHECK((s.device_timeout == d.device_timeout && s.max_memory == d.max_memory && s.precision == d.precision));
    CHECK((s.max_instances == d.max_instances && !s.laboratory));
    CHECK((s.tolerance_rule == d.tolerance_rule && s.tolerance == d.tolerance && s.air == d.air));
    CHECK((s.skip_unsupported == d.skip_unsupported && s.display_shading == d.display_shading));
    CHECK((s.check == d.check && s.threads == d.threads && !s.progress));

    const csgrt_view view CSGRT_VIEW;
    const View v = c::view_of(&view), w;
    CHECK((v.width == w.width && v.height == w.height && v.every_partition == w.every_partition));
    CHECK((v.channels == w.channels && v.clip.empty() && !v.part && v.samples == w.samples));
    CHECK(v.transparent == w.transparent);
    const csgrt_camera camera CSGRT_CAMERA;
    const Camera a = c::camera_of(&camera), b;
    CHECK((a.azimuth == b.azimuth && a.elevation == b.elevation && a.perspective == b.perspective));
    CHECK((!a.center && !a.view_size && !a.eye && !a.look_at && !a.up));

    csgrt_finish finish CSGRT_FINISH;
    finish.shines = 1;
    const Finish f = c::finish_of(&finish), g{.light = Emission{}};
    CHECK((f.shader == g.shader && f.specular == g.specular && f.diffuse == g.diffuse && f.ambient == g.ambient));
    CHECK((f.shine == g.shine && f.transmit == g.transmit && f.reflect == g.reflect));
    CHECK((f.light->intensity == g.light->intensity && f.light->fraction == 0 && f.light->angle == g.light->angle));
    CHECK((!f.light->infinite && f.light->visible && f.light->shadows == g.light->shadows && !f.light->target));
    const csgrt_light light CSGRT_LIGHT;
    const Light l = c::lights_of(&light, 1)[0], m;
    CHECK((l.color == m.color && l.intensity == m.intensity && l.angle == m.angle && l.direction == m.direction));

    OwnedScene scene;
    csgrt_scene_info info = CSGRT_SCENE_INFO, empty = CSGRT_SCENE_INFO;
    REQUIRE_OK(csgrt_scene_create(&scene));
    REQUIRE_OK(csgrt_scene_get_info(scene, &info));
    CHECK((std::strcmp(info.units, empty.units) == 0 && info.ambient == empty.ambient));
    CHECK(info.unit_length == empty.unit_length);
    CHECK(std::strcmp(csgrt_version(), CSGRT_VERSION_STRING) == 0);
}

TEST_CASE("every argument of C that is NULL is refused by its name", "[promise:c]") {
    const Wheels w;
    const csgrt_view view CSGRT_VIEW;
    csgrt_rays rays = CSGRT_RAYS;
    csgrt_model* model = reinterpret_cast<csgrt_model*>(&rays);
    CHECK_REFUSED(csgrt_load_scene("x.json", nullptr, nullptr), CSGRT_ERROR_USAGE, "where the new handle goes is NULL");
    CHECK_REFUSED(csgrt_model_create(nullptr, nullptr, 0, nullptr, &model), CSGRT_ERROR_USAGE, "scene is NULL");
    CHECK(model == nullptr);
    OwnedScene scene;
    CHECK_REFUSED(csgrt_load_scene(nullptr, nullptr, &scene), CSGRT_ERROR_USAGE, "path is NULL");
    CHECK_REFUSED(csgrt_parse_scene(nullptr, 3, "x", nullptr, &scene), CSGRT_ERROR_USAGE, "bytes is NULL");
    CHECK_REFUSED(csgrt_save_scene(w.scene, nullptr), CSGRT_ERROR_USAGE, "path is NULL");
    CHECK_REFUSED(csgrt_validate(w.scene, nullptr, 2, nullptr), CSGRT_ERROR_USAGE, "objects is NULL");
    CHECK_REFUSED(csgrt_renderer_render(w.renderer, &view, nullptr), CSGRT_ERROR_USAGE, "image is NULL");
    CHECK_REFUSED(csgrt_renderer_render(nullptr, &view, nullptr), CSGRT_ERROR_USAGE, "renderer is NULL");
    CHECK_REFUSED(csgrt_renderer_partitions(w.renderer, nullptr, nullptr), CSGRT_ERROR_USAGE, "rays is NULL");
    CHECK_REFUSED(csgrt_renderer_partitions(w.renderer, &rays, nullptr), CSGRT_ERROR_USAGE, "partitions is NULL");
    rays.count = 1;
    NewPartitions partitions;
    CHECK_REFUSED(csgrt_renderer_partitions(w.renderer, &rays, partitions), CSGRT_ERROR_USAGE, "rays->list is NULL");
    CHECK_REFUSED(csgrt_renderer_cast_rays(w.renderer, &rays, nullptr), CSGRT_ERROR_USAGE, "hits is NULL");
    CHECK_REFUSED(csgrt_renderer_occluded(w.renderer, &rays, nullptr, 1), CSGRT_ERROR_USAGE, "answers is NULL");
    const csgrt_vec3 point = {0, 0, 0};
    const csgrt_slice slice = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1, 1};
    std::int32_t id = 0;
    CHECK_REFUSED(csgrt_renderer_region_at(w.renderer, nullptr, &id, 1), CSGRT_ERROR_USAGE, "points is NULL");
    CHECK_REFUSED(csgrt_renderer_region_at(w.renderer, &point, nullptr, 1), CSGRT_ERROR_USAGE, "ids is NULL");
    CHECK_REFUSED(csgrt_renderer_region_at(nullptr, &point, &id, 1), CSGRT_ERROR_USAGE, "renderer is NULL");
    CHECK_REFUSED(csgrt_renderer_slice(w.renderer, nullptr, &id, 1), CSGRT_ERROR_USAGE, "slice is NULL");
    CHECK_REFUSED(csgrt_renderer_slice(w.renderer, &slice, nullptr, 1), CSGRT_ERROR_USAGE, "ids is NULL");
    CHECK_REFUSED(csgrt_renderer_partitions_in_batches(w.renderer, &rays, 1, nullptr, nullptr), CSGRT_ERROR_USAGE,
                  "rays->list is NULL");
    CHECK_REFUSED(csgrt_partitions_get(partitions, nullptr), CSGRT_ERROR_USAGE, "arrays is NULL");
    CHECK_REFUSED(csgrt_model_region(nullptr, 0, nullptr), CSGRT_ERROR_USAGE, "model is NULL");
    CHECK_REFUSED(csgrt_model_find_region(w.model, "/all", nullptr), CSGRT_ERROR_USAGE, "index is NULL");
    CHECK_REFUSED(csgrt_model_children(w.model, "/", nullptr, nullptr), CSGRT_ERROR_USAGE, "take is NULL");
    CHECK_REFUSED(csgrt_model_matrix_of(w.model, "/all", nullptr), CSGRT_ERROR_USAGE, "matrix is NULL");
    CHECK_REFUSED(csgrt_scene_set_top_matrices(w.scene, nullptr, 1), CSGRT_ERROR_USAGE, "matrices is NULL");
    CHECK_REFUSED(csgrt_edit_set_color(nullptr, "x", nullptr), CSGRT_ERROR_USAGE, "edit is NULL");
    CHECK_REFUSED(csgrt_scene_add_solid(w.scene, "x", "sphere", nullptr, 1), CSGRT_ERROR_USAGE, "members is NULL");
    CHECK_REFUSED(csgrt_devices(nullptr), CSGRT_ERROR_USAGE, "count is NULL");
    csgrt_scene_free(nullptr);
    csgrt_model_free(nullptr);
    csgrt_renderer_free(nullptr);
    csgrt_partitions_free(nullptr);
    csgrt_image_free(nullptr);
    csgrt_edit_free(nullptr);
    csgrt_verifier_free(nullptr);
}

TEST_CASE("structs of C of an earlier version have the defaults of later members, and wrong sizes are refused",
          "[promise:c]") {
    const Wheels w;
    csgrt_view view = CSGRT_VIEW;
    view.width = 7;
    view.height = 5;
    view.samples = -3;
    view.size = offsetof(csgrt_view, samples);
    CHECK(c::view_of(&view).samples == 1);
    CHECK(c::view_of(&view).width == 7);
    NewImage image;
    CHECK(csgrt_renderer_render(w.renderer, &view, image) == CSGRT_OK);
    for (const std::size_t size : {std::size_t{0}, sizeof(csgrt_view) + 1, offsetof(csgrt_view, samples) + 1}) {
        view.size = size;
        CHECK_REFUSED(csgrt_renderer_render(w.renderer, &view, image), CSGRT_ERROR_USAGE,
                      "view->size is " + std::to_string(size));
    }
    csgrt_model_info info = CSGRT_MODEL_INFO;
    info.size = offsetof(csgrt_model_info, region_count);
    info.region_count = 99;
    CHECK(csgrt_model_get_info(w.model, &info) == CSGRT_OK);
    CHECK((info.bounds.high.x > 0 && info.region_count == 99));
    info.size = 0;
    CHECK_REFUSED(csgrt_model_get_info(w.model, &info), CSGRT_ERROR_USAGE, "info->size is 0");
}

TEST_CASE("what C passes on is refused with its index, its value or its place", "[promise:c]") {
    Wheels w;
    NewPartitions partitions;
    std::vector<csgrt_ray> list(9, {{0, 0, 0}, {1, 0, 0}});
    list[7].direction = {0, 0, 0};
    csgrt_rays rays = CSGRT_RAYS;
    rays.list = list.data();
    rays.count = list.size();
    CHECK_REFUSED(csgrt_renderer_partitions(w.renderer, &rays, partitions), CSGRT_ERROR_USAGE, "ray 7");
    CHECK_REFUSED(csgrt_model_partitions(w.model, &rays, partitions), CSGRT_ERROR_USAGE, "ray 7");
    rays.count = 7;
    rays.fields = 16;
    CHECK_REFUSED(csgrt_model_partitions(w.model, &rays, partitions), CSGRT_ERROR_USAGE, "fields is 16");
    rays.fields = 0;
    const csgrt_range range{0, 1};
    rays.ranges = &range;
    rays.range_count = 1;
    CHECK(csgrt_model_partitions(w.model, &rays, partitions) == CSGRT_ERROR_USAGE);
    rays.range_count = 0;
    CHECK_REFUSED(csgrt_model_partitions(w.model, &rays, partitions), CSGRT_ERROR_USAGE, "range_count is 0");
    rays.ranges = nullptr;
    const csgrt_ray_grid grid{};
    rays.grid = &grid;
    CHECK_REFUSED(csgrt_model_partitions(w.model, &rays, partitions), CSGRT_ERROR_USAGE, "are both given");
    rays.grid = nullptr;
    csgrt_hits hits = CSGRT_HITS;
    hits.count = 6;
    CHECK_REFUSED(csgrt_model_cast_rays(w.model, &rays, &hits), CSGRT_ERROR_USAGE, "the count is 6, expected 7");
    csgrt_region_info region = CSGRT_REGION_INFO;
    CHECK_REFUSED(csgrt_model_region(w.model, 99, &region), CSGRT_ERROR_USAGE, "the index 99 is too large");
    csgrt_settings settings = CSGRT_SETTINGS;
    settings.precision = 4;
    OwnedRenderer other;
    CHECK_REFUSED(csgrt_renderer_create(w.model, &settings, &other), CSGRT_ERROR_USAGE, "settings->precision is 4");
    settings.precision = 0;
    settings.device = "no such device";
    CHECK(csgrt_renderer_create(w.model, &settings, &other) == CSGRT_ERROR_NO_DEVICE);

    CHECK_REFUSED(csgrt_load_scene("no/such.json", nullptr, &w.scene), CSGRT_ERROR_FILE, "no/such.json");
    const char* broken = "{\"csgrt\": 1,\n \"solids\": {\"ball\": {\"type\": \"spere\"}}}";
    CHECK_REFUSED(csgrt_parse_scene(broken, std::strlen(broken), "broken.json", nullptr, &w.scene), CSGRT_ERROR_SCENE,
                  "broken.json:2");
    csgrt_diagnostic d = CSGRT_DIAGNOSTIC;
    REQUIRE(csgrt_last_diagnostic_count() >= 1);
    REQUIRE(csgrt_last_diagnostic(0, &d) == CSGRT_OK);
    CHECK((d.line == 2 && d.column > 1 && std::strcmp(d.file, "broken.json") == 0));
    CHECK_THAT(d.suggestion, ContainsSubstring("sphere"));
    CHECK(csgrt_last_diagnostic(csgrt_last_diagnostic_count(), &d) == CSGRT_ERROR_USAGE);

    const std::string first = csgrt_last_error();
    std::string elsewhere = "unset";
    std::thread([&] { elsewhere = csgrt_last_error(); }).join();
    CHECK(elsewhere.empty());
    CHECK(csgrt_last_error() == first);
}

TEST_CASE("no number that C sets is taken if it is none, or has no end") {
    const Wheels w;
    OwnedModel model;
    OwnedRenderer renderer;
    OwnedVerifier verifier;
    NewImage image;
    NewPartitions partitions;

    csgrt_settings settings = CSGRT_SETTINGS;
    const auto makes_model = [&] { return csgrt_model_create(w.scene, nullptr, 0, &settings, &model); };
    const auto makes_renderer = [&] { return csgrt_renderer_create(w.model, &settings, &renderer); };
    const auto makes_verifier = [&] { return csgrt_verifier_create(w.scene, nullptr, 0, &settings, &verifier); };
    check_no_end("a model's settings", makes_model, settings.tolerance, settings.device_timeout);
    check_no_end("a renderer's settings", makes_renderer, settings.tolerance, settings.device_timeout);
    check_no_end("a verifier's settings", makes_verifier, settings.tolerance, settings.device_timeout);
    settings.tolerance = infinite;
    CHECK_REFUSED(makes_renderer(), CSGRT_ERROR_USAGE, "the setting tolerance is inf, and must be a finite number");

    csgrt_ray ray = {{-30, 0.5, 0.25}, {2, 0, 0}};
    csgrt_range range = {0, 1e3};
    csgrt_ray_grid grid{};
    csgrt_rays rays = CSGRT_RAYS;
    const auto shoots = [&] { return csgrt_renderer_partitions(w.renderer, &rays, partitions); };
    const auto finds = [&] { return csgrt_model_partitions(w.model, &rays, partitions); };
    rays.list = &ray;
    rays.count = 1;
    check_no_end("a renderer's ray", shoots, ray);
    check_no_end("a model's ray", finds, ray);
    for (double* const end : {&rays.range.t_near, &rays.range.t_far}) {  // a line has no ends
        const double good = std::exchange(*end, none);
        CHECK((shoots() == CSGRT_ERROR_USAGE && finds() == CSGRT_ERROR_USAGE));
        *end = good;
    }
    rays.ranges = &range;
    rays.range_count = 1;
    range.t_far = none;
    CHECK((shoots() == CSGRT_ERROR_USAGE && finds() == CSGRT_ERROR_USAGE));
    rays.ranges = nullptr;
    rays.range_count = 0;

    csgrt_box box = {{-30, -30, -30}, {60, 60, 60}};
    csgrt_vec3 center = {0, 0, 0}, eye = {500, 20, 30}, up = {0, 0, 1}, normal = {1, 2, 3}, point = {1, 1, 1};
    double angle = 30, offset = 3;
    const auto parallel = [&] { return csgrt_rays_parallel(&box, 0, 3, 2, &grid); };
    check_no_end("the box of parallel rays", parallel, box);
    const auto pinhole = [&] { return csgrt_rays_pinhole(angle, &center, &eye, &up, 3, 2, &grid); };
    check_no_end("an eye", pinhole, angle, center, eye, up);
    rays.grid = &grid;
    rays.list = nullptr;
    rays.count = 0;
    check_no_end("a renderer's grid", shoots, grid.origin, grid.direction, grid.right, grid.up);
    check_no_end("a model's grid", finds, grid.origin, grid.direction, grid.right, grid.up);
    csgrt_slice slice{};
    const auto slices = [&] { return csgrt_slice_of(&box, &normal, offset, 3, 3, &slice); };
    check_no_end("a plane", slices, box, normal, offset);
    std::int32_t ids[9];
    const auto looks = [&] { return csgrt_renderer_slice(w.renderer, &slice, ids, 9); };
    check_no_end("a slice", looks, slice.center, slice.right, slice.up);
    const auto asks = [&] { return csgrt_model_region_at(w.model, &point, ids, 1); };
    check_no_end("a point", asks, point);

    csgrt_camera camera = CSGRT_CAMERA;
    csgrt_plane plane = {{1, 0, 0}, 20};
    csgrt_view view = CSGRT_VIEW;
    view.width = view.height = 4;
    view.camera = &camera;
    view.clip = &plane;
    view.clip_count = 1;
    const auto draws = [&] { return csgrt_renderer_render(w.renderer, &view, image); };
    camera.view_size = 100;
    camera.center = &center;
    check_no_end("a view", draws, camera.azimuth, camera.elevation, camera.perspective, camera.view_size, center,
                 plane);
    camera.view_size = 0;
    camera.center = nullptr;
    camera.eye = &eye;
    camera.look_at = &point;
    camera.up = &up;
    check_no_end("a view from an eye", draws, eye, point, up);
    const auto samples = [&] {
        csgrt_ray some[50];
        return csgrt_verifier_sample(verifier, &camera, 1, some, 50);
    };
    settings.tolerance = -1;
    REQUIRE_OK(makes_verifier());
    check_no_end("a sample from an eye", samples, eye, point, up);

    csgrt_scene_info info = CSGRT_SCENE_INFO;
    csgrt_light light = CSGRT_LIGHT;
    csgrt_finish finish = CSGRT_FINISH;
    csgrt_vec3 red = {1, 0, 0};
    finish.shines = 1;
    finish.target = &point;
    finish.direction = &up;
    double matrix[16] = {1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1};
    csgrt_vec3 vertices[] = {{20, 0, 0}, {30, 0, 0}, {20, 10, 0}, {20, 0, 10}};
    const std::uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const auto builds = [&] {
        OwnedScene scene;
        const csgrt_tree_node node = CSGRT_PLACED("mesh", matrix);
        csgrt_combination part = CSGRT_COMBINATION;
        part.name = "part";
        part.nodes = &node;
        part.node_count = part.region = 1;
        part.color = &red;
        part.finish = &finish;
        if (csgrt_scene_create(&scene) != CSGRT_OK ||
            csgrt_scene_add_mesh(scene, "mesh", vertices, 4, faces, 4) != CSGRT_OK ||
            csgrt_scene_add_combination(scene, &part) != CSGRT_OK || csgrt_scene_set_info(scene, &info) != CSGRT_OK ||
            csgrt_scene_set_camera(scene, &camera) != CSGRT_OK || csgrt_scene_set_lights(scene, &light, 1) != CSGRT_OK)
            return CSGRT_ERROR_USAGE;
        return csgrt_model_create(scene, nullptr, 0, nullptr, &model);
    };
    check_no_end("a scene", builds, info.unit_length, info.ambient, info.background, info.tolerance, camera.azimuth,
                 camera.elevation, camera.perspective, eye, point, up, light.position, light.color, light.intensity,
                 light.angle, light.direction, finish.specular, finish.diffuse, finish.ambient, finish.transmit,
                 finish.reflect, finish.intensity, finish.fraction, finish.angle, red, matrix, vertices);
    double place[16] = {1, 0, 0, 5, 0, 1, 0, 5, 0, 0, 1, 5, 0, 0, 0, 1};
    const auto edits = [&] {
        OwnedEdit edit;
        if (csgrt_edit_create(w.model, &edit) != CSGRT_OK || csgrt_edit_set_color(edit, "all", &red) != CSGRT_OK ||
            csgrt_edit_set_finish(edit, "all", &finish) != CSGRT_OK ||
            csgrt_edit_set_lights(edit, &light, 1) != CSGRT_OK ||
            csgrt_edit_set_ambient(edit, info.ambient) != CSGRT_OK ||
            csgrt_edit_set_background(edit, &info.background) != CSGRT_OK ||
            csgrt_edit_set_matrix(edit, "all/wheel", matrix, 0) != CSGRT_OK ||
            csgrt_edit_set_matrix(edit, "all", place, 0) != CSGRT_OK)
            return CSGRT_ERROR_USAGE;
        return csgrt_edit_commit(edit, &model);
    };
    check_no_end("an edit", edits, red, finish.specular, finish.diffuse, finish.ambient, finish.transmit,
                 finish.reflect, finish.intensity, finish.fraction, finish.angle, point, up, light.position,
                 light.color, light.intensity, light.angle, light.direction, info.ambient, info.background, matrix,
                 place);
}

TEST_CASE("scenes are built in C of solids by the names of their members, meshes and trees", "[promise:c]") {
    OwnedScene scene;
    OwnedModel model;
    REQUIRE_OK(csgrt_scene_create(&scene));
    const double radius = 10, hole = 4, center[] = {0, 0, 0}, not_finite = std::numeric_limits<double>::quiet_NaN();
    const csgrt_member ball[] = {{"center", center, 3, 0, nullptr}, number("radius", radius)};
    const csgrt_member pin[] = {{"center", nullptr, 0, 0, "[0, 0, 0]"}, number("radius", hole)};
    const csgrt_member corners[] = {{"vertices", center, 3, 2, nullptr}};
    const csgrt_member bad[] = {{"center", center, 3, 0, nullptr}, number("radius", not_finite)};
    REQUIRE_OK(csgrt_scene_add_solid(scene, "the \"ball\"", "sphere", ball, 2));
    REQUIRE_OK(csgrt_scene_add_solid(scene, "pin", "sphere", pin, 2));
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "pin", "sphere", ball, 2), CSGRT_ERROR_USAGE, "'pin' already");
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "x", "sphere", ball, 1), CSGRT_ERROR_SCENE, "radius");
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "x", "spere", ball, 2), CSGRT_ERROR_SCENE, "sphere");
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "x", "sphere", bad, 2), CSGRT_ERROR_USAGE, "'radius'");
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "x", "arb4", corners, 1), CSGRT_ERROR_USAGE, "whole rows of 2");
    const csgrt_member odd[] = {{"center", nullptr, 0, 0,
                                 "[0,0,0], \"radius\": 1}, \"y\": {\"type\": \"sphere\", "
                                 "\"center\": [0,0,0]"},
                                number("radius", radius)};
    CHECK_REFUSED(csgrt_scene_add_solid(scene, "x", "sphere", odd, 2), CSGRT_ERROR_USAGE, "ends the solid 'x'");

    const csgrt_vec3 vertices[] = {{20, 0, 0}, {30, 0, 0}, {20, 10, 0}, {20, 0, 10}};
    const std::uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    REQUIRE_OK(csgrt_scene_add_mesh(scene, "tetrahedron", vertices, 4, faces, 4));
    const csgrt_tree_node nodes[] = {CSGRT_OBJECT("the \"ball\""), CSGRT_OBJECT("pin"), CSGRT_JOIN(CSGRT_DIFFERENCE, 2),
                                     CSGRT_OBJECT("tetrahedron"), CSGRT_JOIN(CSGRT_UNION, 2)};
    csgrt_combination part = CSGRT_COMBINATION;
    const csgrt_vec3 red{1, 0, 0};
    part.name = "part";
    part.nodes = nodes;
    part.node_count = 5;
    part.region = 1;
    part.region_id = 12;
    part.color = &red;
    REQUIRE_OK(csgrt_scene_add_combination(scene, &part));
    REQUIRE_OK(csgrt_validate(scene, nullptr, 0, nullptr));
    REQUIRE_OK(csgrt_model_create(scene, nullptr, 0, nullptr, &model));

    Scene expected;
    expected.objects.push_back(Solid{"ball", Ell{{}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}, {}});
    expected.objects.push_back(Solid{"pin", Ell{{}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {}});
    Bot mesh{.vertices = {{20, 0, 0}, {30, 0, 0}, {20, 10, 0}, {20, 0, 10}}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    expected.objects.push_back(Solid{"tetrahedron", mesh, {}});
    expected.objects.push_back(
        Combination{.name = "part", .tree = (tree("ball") - tree("pin")) | tree("tetrahedron"), .region = true});
    const Ray ray{{-30, 0.5, 0.25}, {2, 0, 0}};
    Partitions p;
    Model(expected).partitions(ray, p);
    NewPartitions partitions;
    csgrt_rays rays = CSGRT_RAYS;
    rays.list = reinterpret_cast<const csgrt_ray*>(&ray);
    rays.count = 1;
    REQUIRE_OK(csgrt_model_partitions(model, &rays, partitions));
    csgrt_partition_arrays rows = CSGRT_PARTITION_ARRAYS;
    REQUIRE_OK(csgrt_partitions_get(partitions, &rows));
    REQUIRE((rows.row_count == 3 && p.t_in.size() == 3));
    for (std::size_t i = 0; i < 3; ++i) CHECK((rows.t_in[i] == p.t_in[i] && rows.t_out[i] == p.t_out[i]));
    csgrt_region_info region = CSGRT_REGION_INFO;
    REQUIRE_OK(csgrt_model_region(model, 0, &region));
    CHECK((std::strcmp(region.path, "/part") == 0 && region.region_id == 12 && region.color.y == 0));

    // What the trees of a scene need and what is not there: each is a finding.
    const csgrt_tree_node missing[] = {CSGRT_OBJECT("nothing"), CSGRT_OBJECT("void"), CSGRT_JOIN(CSGRT_UNION, 2)};
    part.name = "holes";
    part.nodes = missing;
    part.node_count = 3;
    REQUIRE_OK(csgrt_scene_add_combination(scene, &part));
    CHECK_REFUSED(csgrt_validate(scene, nullptr, 0, nullptr), CSGRT_ERROR_SCENE, "nothing");
    CHECK(csgrt_last_diagnostic_count() == 2);
    const char* const top[] = {"part"};
    REQUIRE_OK(csgrt_scene_set_top(scene, top, 1));
    CHECK(csgrt_validate(scene, nullptr, 0, nullptr) == CSGRT_OK);
    const char *name = nullptr, *type = nullptr;
    REQUIRE_OK(csgrt_scene_object(scene, 3, &name, &type));
    CHECK((std::strcmp(name, "part") == 0 && std::strcmp(type, "region") == 0));
    csgrt_scene_info info = CSGRT_SCENE_INFO;
    REQUIRE_OK(csgrt_scene_get_info(scene, &info));
    CHECK((info.object_count == 5 && info.top_count == 1));
    info.title = "a part";
    info.background = red;
    REQUIRE_OK(csgrt_scene_set_info(scene, &info));
    REQUIRE_OK(csgrt_scene_get_info(scene, &info));
    CHECK((std::strcmp(info.title, "a part") == 0 && info.background.x == 1));
}

TEST_CASE("a progress function of C ends a call", "[promise:c][promise:interrupts]") {
    csgrt_settings settings = CSGRT_SETTINGS;
    int calls = 0;
    settings.user = &calls;
    settings.progress = [](void* user, double) { return ++*static_cast<int*>(user) < 2 ? 1 : 0; };
    const Wheels w(&settings);
    csgrt_view view = CSGRT_VIEW;
    view.width = view.height = 4000;
    view.samples = 16;
    NewImage image;
    CHECK(csgrt_renderer_render(w.renderer, &view, image) == CSGRT_ERROR_INTERRUPTED);
    CHECK(calls == 2);
}

TEST_CASE("a verifier in C passes, and says with a status that it does not", "[promise:c]") {
    const auto verify = [](const csgrt_scene* scene, const csgrt_settings* settings, csgrt_verification* result) {
        OwnedVerifier verifier;
        std::vector<csgrt_ray> rays(50);
        REQUIRE_OK(csgrt_verifier_create(scene, nullptr, 0, settings, &verifier));
        REQUIRE_OK(csgrt_verifier_sample(verifier, nullptr, 1, rays.data(), rays.size()));
        for (int i = 0; i < 20; ++i)  // they graze a ball of radius 99.7, within what single precision rounds
            rays[i] = {{-200, 99.7 + 3e-8 * (i - 10), 0}, {1, 0, 0}};
        REQUIRE_OK(csgrt_verifier_shoot(verifier, rays.data(), rays.size()));
        const csgrt_status status = csgrt_verifier_result(verifier, result);
        result->device = "";  // it was the verifier's
        return status;
    };
    csgrt_verification result = CSGRT_VERIFICATION;
    CHECK(verify(Wheels().scene, nullptr, &result) == CSGRT_OK);
    CHECK((result.rays == 50 && result.hits > 0 && result.wrong == 0 && result.ends > 0));

    OwnedScene grazed;
    const char* text = R"({"csgrt": 1, "solids": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 99.7}}})";
    REQUIRE_OK(csgrt_parse_scene(text, std::strlen(text), "grazed.json", nullptr, &grazed));
    csgrt_settings settings = CSGRT_SETTINGS;
    settings.precision = CSGRT_PRECISION_SINGLE;
    settings.reference = 1;
    CHECK_REFUSED(verify(grazed, &settings, &result), CSGRT_ERROR_DIFFERS, "decided rays are wrong");
    CHECK((result.wrong > 0 && result.first_wrong < 50 && std::abs(result.wrong_ray.direction.x) <= 1));
}

TEST_CASE("devices are told in C") {
    std::size_t count = 0;
    REQUIRE_OK(csgrt_devices(&count));
    CHECK(count == devices().size());
    csgrt_device_info info = CSGRT_DEVICE_INFO;
    for (std::size_t i = 0; i < count; ++i) {
        REQUIRE_OK(csgrt_device(i, &info));
        CHECK(info.name == devices()[i].name);
    }
    CHECK_REFUSED(csgrt_device(count, &info), CSGRT_ERROR_USAGE, "too large");
    CHECK(csgrt_prepare_devices(nullptr) == CSGRT_OK);
}
