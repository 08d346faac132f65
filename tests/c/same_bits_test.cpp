// csgrt.h answers with the bits of the C++ interface.
#include <array>
#include <cstring>
#include <random>

#include "c/owned.hpp"
#include "folder.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

template <class A, class B>
bool same_bytes(const A* a, std::size_t count, const B& b) {
    static_assert(sizeof(A) == sizeof(b[0]));
    return count == b.size() && (count == 0 || std::memcmp(a, b.data(), count * sizeof(A)) == 0);
}

csgrt_rays rays_of(const std::vector<Ray>& list, unsigned fields) {
    csgrt_rays rays = CSGRT_RAYS;
    rays.list = reinterpret_cast<const csgrt_ray*>(list.data());
    rays.count = list.size();
    rays.fields = fields;
    return rays;
}

void require_same(const csgrt_partitions* found, const Partitions& p) {
    csgrt_partition_arrays a = CSGRT_PARTITION_ARRAYS;
    REQUIRE_OK(csgrt_partitions_get(found, &a));
    REQUIRE(same_bytes(a.ray_splits, a.ray_count + 1, p.ray_splits));
    REQUIRE(same_bytes(a.region_ids, a.row_count, p.region_ids));
    REQUIRE(same_bytes(a.t_in, a.row_count, p.t_in));
    REQUIRE(same_bytes(a.t_out, a.row_count, p.t_out));
    REQUIRE(same_bytes(a.in_solids, a.in_solids ? a.row_count : 0, p.in_solids));
    REQUIRE(same_bytes(a.out_solids, a.out_solids ? a.row_count : 0, p.out_solids));
    REQUIRE(same_bytes(a.in_normals, a.in_normals ? a.row_count : 0, p.in_normals));
    REQUIRE(same_bytes(a.out_normals, a.out_normals ? a.row_count : 0, p.out_normals));
    REQUIRE(same_bytes(a.overlap_splits, a.overlap_splits ? a.ray_count + 1 : 0, p.overlap_splits));
    REQUIRE(same_bytes(a.overlap_t_in, a.overlap_count, p.overlap_t_in));
    REQUIRE(same_bytes(a.overlap_t_out, a.overlap_count, p.overlap_t_out));
    REQUIRE(same_bytes(a.overlap_region_ids, a.claimant_count, p.overlap_region_ids));
}

void require_same_rays(const csgrt_model* c_model, csgrt_renderer* c_renderer, Renderer& renderer) {
    const std::vector<Ray> list = random_rays(renderer.bounds(), tries(200));
    const std::vector<RayRange> ranges = random_ranges(list.size());
    OwnedPartitions found;
    REQUIRE_OK(csgrt_partitions_create(&found));
    Partitions expected;
    for (const unsigned fields : {7u, 0u}) {  // what was there before is gone
        const Fields wanted{.solids = fields != 0, .normals = fields != 0, .overlaps = fields != 0};
        csgrt_rays rays = rays_of(list, fields);
        rays.ranges = reinterpret_cast<const csgrt_range*>(ranges.data());
        rays.range_count = ranges.size();
        renderer.partitions(list, expected, wanted, {.each = ranges});
        REQUIRE_OK(csgrt_renderer_partitions(c_renderer, &rays, found));
        require_same(found, expected);
        REQUIRE_OK(csgrt_model_partitions(c_model, &rays, found));
        require_same(found, expected);
    }

    csgrt_rays rays = rays_of(list, 0);
    rays.range = {-5, 500};
    const RayRanges range{.all = {-5, 500}};
    Hits hits;
    renderer.cast_rays(list, hits, {.solids = true, .normals = true}, range);
    Array<std::uint8_t> dark;
    renderer.occluded(list, dark, range);
    const auto require_hits = [&](auto cast, auto occluded, auto* tracer) {
        std::vector<double> t(list.size());
        std::vector<std::int32_t> regions(list.size()), solids(list.size());
        std::vector<csgrt_vec3> normals(list.size());
        csgrt_hits c_hits = CSGRT_HITS;
        c_hits.count = list.size();
        c_hits.t_hit = t.data();
        c_hits.region_ids = regions.data();
        REQUIRE_OK(cast(tracer, &rays, &c_hits));  // without solids and normals
        c_hits.solid_ids = solids.data();
        c_hits.normals = normals.data();
        REQUIRE_OK(cast(tracer, &rays, &c_hits));
        REQUIRE(same_bytes(t.data(), t.size(), hits.t_hit));
        REQUIRE(same_bytes(regions.data(), regions.size(), hits.region_ids));
        REQUIRE(same_bytes(solids.data(), solids.size(), hits.solid_ids));
        REQUIRE(same_bytes(normals.data(), normals.size(), hits.normals));
        std::vector<std::uint8_t> answers(list.size());
        REQUIRE_OK(occluded(tracer, &rays, answers.data(), answers.size()));
        REQUIRE(same_bytes(answers.data(), answers.size(), dark));
    };
    require_hits(csgrt_model_cast_rays, csgrt_model_occluded, c_model);
    require_hits(csgrt_renderer_cast_rays, csgrt_renderer_occluded, c_renderer);
}

void require_same_places(const csgrt_model* c_model, csgrt_renderer* c_renderer, Renderer& renderer) {
    csgrt_model_info info = CSGRT_MODEL_INFO;
    REQUIRE_OK(csgrt_model_get_info(c_model, &info));
    const csgrt_vec3 normal{0.2, -0.3, 1};
    csgrt_slice cut;
    REQUIRE_OK(csgrt_slice_of(&info.bounds, &normal, 1, 40, 30, &cut));
    Array<std::int32_t> expected;
    renderer.slice(slice_of(renderer.bounds(), {0.2, -0.3, 1}, 1, 40, 30), expected);
    std::vector<std::int32_t> ids(1200);
    REQUIRE_OK(csgrt_renderer_slice(c_renderer, &cut, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));
    REQUIRE_OK(csgrt_model_slice(c_model, &cut, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));

    std::vector<Vec3> points;
    for (const Ray& ray : random_rays(renderer.bounds(), 100)) points.push_back(ray.origin);
    renderer.region_at(points, expected);
    ids.resize(points.size());
    const auto* list = reinterpret_cast<const csgrt_vec3*>(points.data());
    REQUIRE_OK(csgrt_renderer_region_at(c_renderer, list, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));
    REQUIRE_OK(csgrt_model_region_at(c_model, list, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));
}

void require_same_pictures(const csgrt_scene* c_scene, const csgrt_model* c_model, csgrt_renderer* c_renderer,
                           Renderer& renderer, const Camera& camera) {
    csgrt_camera c_camera = CSGRT_CAMERA;
    REQUIRE_OK(csgrt_scene_camera(c_scene, &c_camera));
    csgrt_view c_view = CSGRT_VIEW;
    c_view.camera = &c_camera;
    c_view.width = 48;
    c_view.height = 36;
    const Image expected = renderer.render({.width = 48, .height = 36, .camera = camera});
    OwnedImage image;
    REQUIRE_OK(csgrt_image_create(&image));
    REQUIRE_OK(csgrt_renderer_render(c_renderer, &c_view, image));
    csgrt_image_info info = CSGRT_IMAGE_INFO;
    REQUIRE_OK(csgrt_image_get_info(image, &info));
    REQUIRE(info.channel_count == expected.names.size());
    for (std::size_t i = 0; i < info.channel_count; ++i) {
        const char* name = nullptr;
        int holds_ids = 0;
        std::size_t count = 0;
        REQUIRE_OK(csgrt_image_channel_name(image, i, &name, &holds_ids));
        CHECK(name == expected.names[i]);
        if (holds_ids) {
            const std::uint32_t* ids = nullptr;
            REQUIRE_OK(csgrt_image_ids(image, name, &ids, &count));
            REQUIRE(same_bytes(ids, count, expected.ids(name)));
        } else {
            const float* values = nullptr;
            REQUIRE_OK(csgrt_image_channel(image, name, &values, &count));
            REQUIRE(same_bytes(values, count, expected.channel(name)));
        }
    }
    const char* const names[] = {"Z", "R"};
    std::vector<float> values(48 * 36 * 2);
    REQUIRE_OK(csgrt_image_copy(image, names, 2, values.data(), values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) REQUIRE(values[i] == expected.channel(names[i % 2])[i / 2]);

    std::vector<unsigned char> bytes(48 * 36 * 4), made(bytes.size());
    REQUIRE_OK(csgrt_image_display_pixels(image, bytes.data(), bytes.size()));
    REQUIRE(bytes == display_pixels(expected));
    c_view.channels = CSGRT_CHANNEL_DISPLAY;
    REQUIRE_OK(csgrt_renderer_render(c_renderer, &c_view, image));
    REQUIRE_OK(csgrt_image_display_pixels(image, made.data(), made.size()));
    REQUIRE(bytes == made);

    csgrt_pick pick = CSGRT_PICK;
    REQUIRE_OK(csgrt_model_pick(c_model, &c_view, 20, 17, &pick));
    const Pick at = renderer.model().pick({.width = 48, .height = 36, .camera = camera}, 20, 17);
    CHECK((pick.region == at.region && pick.solid == at.solid && same(pick.t, at.t)));
    csgrt_ray_grid grid;
    csgrt_ray ray;
    REQUIRE_OK(csgrt_model_grid_of(c_model, &c_view, &grid));
    REQUIRE_OK(csgrt_ray_grid_ray(&grid, 20, 17, &ray));
    CHECK(std::memcmp(&ray, &pick.ray, sizeof ray) == 0);
}

}  // namespace

TEST_CASE("pictures, partitions, hits, slices and points from C have the bits of C++") {
    std::vector<std::pair<std::string, std::vector<const char*>>> files;
    for (const std::string& file : scene_files()) files.emplace_back(file, std::vector<const char*>{});
    if (const std::string models = folder("CSGRT_BRLCAD"); !models.empty()) {
        files.emplace_back(models + "/havoc.asc", std::vector<const char*>{"havoc"});
    }
    for (const auto& [file, objects] : files) {
        INFO(file);
        OwnedScene c_scene;
        OwnedModel c_model;
        OwnedRenderer c_renderer;
        REQUIRE_OK(csgrt_load_scene(file.c_str(), nullptr, &c_scene));
        REQUIRE_OK(csgrt_model_create(c_scene, objects.data(), objects.size(), nullptr, &c_model));
        REQUIRE_OK(csgrt_renderer_create(c_model, nullptr, &c_renderer));
        const Scene scene = load_scene(file);
        Renderer renderer(scene, {objects.begin(), objects.end()});
        require_same_rays(c_model, c_renderer, renderer);
        require_same_places(c_model, c_renderer, renderer);
        require_same_pictures(c_scene, c_model, c_renderer, renderer, scene.camera);
    }
}

TEST_CASE("after 100 edits from C a model has the bits of the same edits in C++") {
    OwnedScene c_scene, parts;
    OwnedModel c_model;
    OwnedRenderer c_renderer;
    REQUIRE_OK(csgrt_parse_scene(wheels, std::strlen(wheels), "wheels.json", nullptr, &c_scene));
    REQUIRE_OK(csgrt_model_create(c_scene, nullptr, 0, nullptr, &c_model));
    REQUIRE_OK(csgrt_renderer_create(c_model, nullptr, &c_renderer));
    REQUIRE_OK(csgrt_scene_create(&parts));
    const Scene scene = parse_scene(wheels, "wheels.json");
    Renderer renderer(scene);
    std::mt19937 random(58);
    const auto part = [&] { return static_cast<double>(random() % 1001) / 1000; };
    for (int i = 0; i < 100; ++i) {
        OwnedEdit c_edit;
        const csgrt::Model before = renderer.model();
        Edit edit(before);
        REQUIRE_OK(csgrt_edit_create(c_model, &c_edit));
        const auto& regions = before.regions();
        const std::string path = regions[random() % static_cast<unsigned>(regions.size())].path;
        const double x = part(), y = part();
        const Matrix matrix = {1, 0, 0, 20 * x, 0, 1, 0, -30 * y, 0, 0, 1, x, 0, 0, 0, 1};
        switch (i % 7) {
            case 0: {
                const csgrt_vec3 color{x, y, 1};
                edit.set_color(path, {x, y, 1});
                REQUIRE_OK(csgrt_edit_set_color(c_edit, path.c_str(), &color));
                break;
            }
            case 1:
                edit.set_state(path, static_cast<State>(i % 3));
                REQUIRE_OK(csgrt_edit_set_state(c_edit, path.c_str(), i % 3));
                break;
            case 2: {
                csgrt_finish finish = CSGRT_FINISH;
                finish.specular = x;
                edit.set_finish(path, {.specular = x});
                REQUIRE_OK(csgrt_edit_set_finish(c_edit, path.c_str(), &finish));
                break;
            }
            case 3:
                edit.set_matrix(path, matrix, y < 0.5 ? Edit::Share::alone : Edit::Share::all);
                REQUIRE_OK(csgrt_edit_set_matrix(c_edit, path.c_str(), matrix.data(), y >= 0.5));
                break;
            case 4: {
                const double radius = 1 + 20 * x;
                const std::string name = "new" + std::to_string(i);
                const std::array<double, 9> axes{radius, 0, 0, 0, radius, 0, 0, 0, radius}, none{};
                const csgrt_member members[] = {{"center", none.data(), 3, 0, nullptr},
                                                {"a", axes.data(), 3, 0, nullptr},
                                                {"b", axes.data() + 3, 3, 0, nullptr},
                                                {"c", axes.data() + 6, 3, 0, nullptr}};
                const Ell ball{{}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}};
                REQUIRE_OK(csgrt_scene_add_solid(parts, name.c_str(), "ell", members, 4));
                if (y < 0.5) {
                    edit.replace("ball", ball);
                    REQUIRE_OK(csgrt_edit_replace(c_edit, "ball", parts, name.c_str()));
                    break;
                }
                edit.add(Solid{name, ball}).add("wheel", Operator::union_, name, matrix);
                REQUIRE_OK(csgrt_edit_add(c_edit, parts, name.c_str(), 0));
                REQUIRE_OK(csgrt_edit_add_leg(c_edit, "wheel", CSGRT_UNION, name.c_str(), matrix.data()));
                break;
            }
            case 5:
                if (i % 2 == 0 || regions.size() < 3) continue;
                edit.remove(path);
                REQUIRE_OK(csgrt_edit_remove(c_edit, path.c_str()));
                break;
            default: {
                csgrt_light light = CSGRT_LIGHT;
                light.position = {100 * x, 100, 100};
                const csgrt_vec3 color{0, y, 0};
                edit.set_lights({{.position = {100 * x, 100, 100}}}).set_ambient(y).set_background({0, y, 0});
                REQUIRE_OK(csgrt_edit_set_lights(c_edit, &light, 1));
                REQUIRE_OK(csgrt_edit_set_ambient(c_edit, y));
                REQUIRE_OK(csgrt_edit_set_background(c_edit, &color));
            }
        }
        renderer.set_model(edit.commit());
        REQUIRE_OK(csgrt_edit_commit(c_edit, &c_model));
        REQUIRE_OK(csgrt_renderer_set_model(c_renderer, c_model));
    }
    OwnedModel latest;
    OwnedScene edited;
    REQUIRE_OK(csgrt_renderer_model(c_renderer, &latest));
    require_same_rays(latest, c_renderer, renderer);
    require_same_places(latest, c_renderer, renderer);
    require_same_pictures(c_scene, latest, c_renderer, renderer, scene.camera);
    csgrt_model_info info = CSGRT_MODEL_INFO;
    REQUIRE_OK(csgrt_model_get_info(latest, &info));
    REQUIRE(info.region_count == renderer.regions().size());
    for (std::size_t i = 0; i < info.region_count; ++i) {
        csgrt_region_info region = CSGRT_REGION_INFO;
        REQUIRE_OK(csgrt_model_region(latest, i, &region));
        CHECK(region.path == renderer.regions()[i].path);
        CHECK(region.state == static_cast<int>(renderer.regions()[i].state));
        csgrt_finish finish = CSGRT_FINISH;
        REQUIRE_OK(csgrt_model_finish(latest, i, &finish));
        CHECK(finish.specular == renderer.regions()[i].finish.specular);
    }
    const Folder folder;
    const std::string path = folder / "edited.json";
    REQUIRE_OK(csgrt_model_scene(latest, &edited));
    REQUIRE_OK(csgrt_save_scene(edited, path.c_str()));
    CHECK(csgrt::Model(load_scene(path)).regions().size() == info.region_count);
}

TEST_CASE("batches from C are those of a grid, and may be ended") {
    OwnedScene scene;
    OwnedModel model;
    OwnedRenderer renderer;
    OwnedPartitions whole;
    REQUIRE_OK(csgrt_parse_scene(wheels, std::strlen(wheels), "wheels.json", nullptr, &scene));
    REQUIRE_OK(csgrt_model_create(scene, nullptr, 0, nullptr, &model));
    REQUIRE_OK(csgrt_renderer_create(model, nullptr, &renderer));
    REQUIRE_OK(csgrt_partitions_create(&whole));
    csgrt_model_info info = CSGRT_MODEL_INFO;
    REQUIRE_OK(csgrt_model_get_info(model, &info));
    csgrt_ray_grid grid;
    REQUIRE_OK(csgrt_rays_parallel(&info.bounds, 1, 20, 30, &grid));
    csgrt_rays rays = CSGRT_RAYS;
    rays.grid = &grid;
    REQUIRE_OK(csgrt_renderer_partitions(renderer, &rays, whole));
    csgrt_partition_arrays all = CSGRT_PARTITION_ARRAYS;
    REQUIRE_OK(csgrt_partitions_get(whole, &all));

    struct Seen {
        std::vector<double> t_in = {};
        int batches = 0, most = 100;
    } seen;
    const csgrt_take take = [](void* user, const csgrt_partitions* batch, std::uint64_t) {
        csgrt_partition_arrays part = CSGRT_PARTITION_ARRAYS;
        Seen& to = *static_cast<Seen*>(user);
        if (csgrt_partitions_get(batch, &part) != CSGRT_OK) return 0;
        to.t_in.insert(to.t_in.end(), part.t_in, part.t_in + part.row_count);
        return ++to.batches < to.most ? 1 : 0;
    };
    REQUIRE_OK(csgrt_renderer_partitions_in_batches(renderer, &rays, 250, take, &seen));
    CHECK(seen.batches == 3);
    CHECK(same_bytes(all.t_in, all.row_count, seen.t_in));
    seen = {.most = 1};
    REQUIRE_OK(csgrt_renderer_partitions_in_batches(renderer, &rays, 250, take, &seen));
    CHECK(seen.batches == 1);
    csgrt_statistics statistics = CSGRT_STATISTICS;
    REQUIRE_OK(csgrt_renderer_statistics(renderer, &statistics));
    CHECK(statistics.rays == 250);
}
