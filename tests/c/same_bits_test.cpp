// csgrt.h answers with the bits of the C++ interface, and after edits so do the other interfaces.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <map>
#include <memory>
#include <random>
#include <sstream>

#include <csgrt/librt.h>

#include "c/owned.hpp"
#include "cli/command.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::test;
using command_test::read_file, command_test::run;

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
    REQUIRE(same_bytes(a.overlap_region_splits, a.overlap_splits ? a.overlap_count + 1 : 0, p.overlap_region_splits));
    REQUIRE(same_bytes(a.overlap_region_ids, a.claimant_count, p.overlap_region_ids));
}

void require_same_rays(const csgrt_model* c_model, csgrt_renderer* c_renderer, Renderer& renderer) {
    const std::vector<Ray> list = random_rays(renderer.model().bounds(), tries(200));
    const std::vector<RayRange> ranges = random_ranges(list.size());
    NewPartitions found;
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
    renderer.slice(slice_of(renderer.model().bounds(), {0.2, -0.3, 1}, 1, 40, 30), expected);
    std::vector<std::int32_t> ids(1200);
    REQUIRE_OK(csgrt_renderer_slice(c_renderer, &cut, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));
    REQUIRE_OK(csgrt_model_slice(c_model, &cut, ids.data(), ids.size()));
    REQUIRE(same_bytes(ids.data(), ids.size(), expected));

    std::vector<Vec3> points;
    for (const Ray& ray : random_rays(renderer.model().bounds(), 100)) points.push_back(ray.origin);
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
    NewImage image;
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

std::string text_of(const auto&... words) {
    std::ostringstream text;
    text << std::setprecision(17) << std::showpoint;  // "-0.000": a float in Python
    (text << ... << words);
    return text.str();
}

std::string bytes_of(const auto& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]};
}

/// The bytes of everything, by the names that Python has.
struct Answers {
    Partitions rows;
    std::map<std::string, std::string> bytes;
};

Answers answers_of(Renderer& renderer, const std::vector<Ray>& rays, const Camera& camera) {
    Answers answers;
    Partitions& p = answers.rows;
    renderer.partitions(rays, p, {.solids = true, .normals = true, .overlaps = true});
    Array<std::int32_t> cut;
    renderer.slice(slice_of(renderer.model().bounds(), {0, 0, 1}, 2.5, 40, 30), cut);
    answers.bytes = {{"slice", bytes_of(cut)},
                     {"ray_splits", bytes_of(p.ray_splits)},
                     {"region_ids", bytes_of(p.region_ids)},
                     {"t_in", bytes_of(p.t_in)},
                     {"t_out", bytes_of(p.t_out)},
                     {"in_solids", bytes_of(p.in_solids)},
                     {"out_solids", bytes_of(p.out_solids)},
                     {"in_normals", bytes_of(p.in_normals)},
                     {"out_normals", bytes_of(p.out_normals)},
                     {"overlap_splits", bytes_of(p.overlap_splits)},
                     {"overlap_t_in", bytes_of(p.overlap_t_in)},
                     {"overlap_t_out", bytes_of(p.overlap_t_out)},
                     {"overlap_region_splits", bytes_of(p.overlap_region_splits)},
                     {"overlap_region_ids", bytes_of(p.overlap_region_ids)}};
    const std::uint32_t channels = channel::all | channel::display | channel::ghosts;
    const Image image = renderer.render({.width = 48, .height = 36, .camera = camera, .channels = channels});
    for (std::size_t i = 0; i < image.names.size(); ++i) answers.bytes[image.names[i]] = bytes_of(image.channels[i]);
    return answers;
}

void require_same_librt(const std::string& file, const std::vector<Ray>& rays, std::vector<RayPartitions> expected) {
    const std::unique_ptr<rt_i, decltype(&rt_free_rti)> rtip(rt_dirbuild(file.c_str(), nullptr, 0), rt_free_rti);
    REQUIRE(rtip);
    rt_prep(rtip.get());
    std::vector<RayPartitions> found(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        expected[i].overlaps.clear();  // librt has no list of them
        xray ray;
        librt::copy(ray.r_pt, rays[i].origin);
        librt::copy(ray.r_dir, rays[i].direction);
        librt::shoot(rtip.get(), ray, [&](const partition& row) {
            const auto id = [](long bit) { return static_cast<std::uint32_t>(bit); };
            const auto normal = [](const hit* end) {
                return Vec3{end->hit_normal[X], end->hit_normal[Y], end->hit_normal[Z]};
            };
            found[i].partitions.push_back({row.pt_inhit->hit_dist, row.pt_outhit->hit_dist, normal(row.pt_inhit),
                                           normal(row.pt_outhit), id(row.pt_regionp->reg_bit),
                                           id(row.pt_inseg->seg_stp->st_bit), id(row.pt_outseg->seg_stp->st_bit)});
            return true;
        });
    }
    csgrt::test::require_same(found, expected);
}

void require_same_command(const std::string& scene, const std::vector<Ray>& rays, const Answers& expected) {
    NEEDS_COMMAND();
    const Folder folder;
    std::string list, records;
    for (const auto& [o, d] : rays) list += text_of(o.x, ' ', o.y, ' ', o.z, ' ', d.x, ' ', d.y, ' ', d.z, '\n');
    const auto put = [&](auto value) { records.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const Partitions& p = expected.rows;
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
        for (auto i = std::size_t(p.ray_splits[ray]); i < std::size_t(p.ray_splits[ray + 1]); ++i) {
            put(std::int64_t(ray)), put(p.region_ids[i]), put(p.in_solids[i]), put(p.out_solids[i]);
            put(p.t_in[i]), put(p.t_out[i]), put(p.in_normals[i]), put(p.out_normals[i]);
        }
    const std::string file = folder / "answer.npy";
    REQUIRE(run({"shoot", scene, "--rays", folder.write("rays", list), "--format", "binary", "-o", file}).status == 0);
    REQUIRE((read_file(file) == records));
    REQUIRE(run({"sample", scene, "--plane", "z:2.5", "--size", "40x30", "-o", file}).status == 0);
    REQUIRE(read_file(file).ends_with(expected.bytes.at("slice")));
#ifdef CSGRT_HAVE_IMAGE
    REQUIRE(run({scene, "--size", "48x36", "-o", folder / "picture.exr"}).status == 0);
    const Image image = read_image(folder / "picture.exr");
    REQUIRE(image.names.size() == 13);
    for (std::size_t i = 0; i < image.names.size(); ++i) {
        INFO(image.names[i]);
        REQUIRE((bytes_of(image.channels[i]) == expected.bytes.at(image.names[i])));
    }
#endif
}

/// Python makes the edits and answers in files.
void require_same_python(const std::string& edits, const std::string& edited, const std::vector<Ray>& rays,
                         const Answers& expected) {
    const char* const python = std::getenv("CSGRT_PYTHON");
    if (!python) return;  // the sanitizers' builds have no package
    const auto calls = [&](const std::string& words) {
        return std::system(text_of('"', python, "\" ", words).c_str()) == 0;
    };
    if (!calls("-c 'import csgrt' 2>/dev/null")) {
        std::puts("SKIPPED: the interpreter of CSGRT_PYTHON has no package csgrt; the other interfaces agree");
        return;
    }
    const Folder folder;
    folder.write("wheels.json", wheels);
    folder.write("rays", bytes_of(rays));
    const std::string program = folder.write("program.py", R"(
import os, sys
import csgrt, numpy
os.chdir(sys.path[0])
scene = csgrt.load('wheels.json')
)" + edits + R"(
scene.save('edited.json')
rays = numpy.fromfile('rays').reshape(-1, 6)
answers = scene.partitions(rays, solids=True, normals=True, overlaps=True)
answers['slice'] = scene.slice((0, 0, 1), 2.5, (40, 30))
image = scene.render(48, 36, every_partition=True)
answers.update((name, image[name]) for name in image.names)
for name, values in answers.items():
    values.tofile(name)
)");
    REQUIRE(calls(program));
    CHECK((read_file(folder / "edited.json") == edited));
    for (const auto& [name, bytes] : expected.bytes) {
        INFO(name);
        CHECK((read_file(folder / name) == bytes));
    }
}

}  // namespace

TEST_CASE("pictures, partitions, hits, slices and points from C have the bits of C++", "[promise:c]") {
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

TEST_CASE("places, children, moves and top objects in C are those of C++", "[promise:c]") {
    const Wheels w;
    const Matrix turn{0, -1, 0, 7, 1, 0, 0, 60, 0, 0, 1, 5, 0, 0, 0, 1};
    const auto matrix = [](const auto& call, const auto*... arguments) {
        Matrix found;
        REQUIRE_OK(call(arguments..., found.data()));
        return found;
    };
    OwnedEdit c_edit;
    OwnedModel c_model;
    OwnedScene parts, lamp, edited;
    const double center[] = {0, 0, 0}, radius = 3;
    const csgrt_member members[] = {{"center", center, 3, 0, nullptr}, {"radius", &radius, 1, 0, nullptr}};
    REQUIRE_OK(csgrt_scene_create(&lamp));
    REQUIRE_OK(csgrt_scene_add_solid(lamp, "lamp", "sphere", members, 2));
    REQUIRE_OK(csgrt_parse_scene(wheels, std::strlen(wheels), "wheels.json", nullptr, &parts));
    REQUIRE_OK(csgrt_edit_create(w.model, &c_edit));
    REQUIRE_OK(csgrt_edit_set_matrix(c_edit, "all/wheel@2", turn.data(), 0));
    REQUIRE_OK(csgrt_edit_move(c_edit, "all/wheel@2/hub.r", turn.data(), 0));
    REQUIRE_OK(csgrt_edit_move(c_edit, "/", turn.data(), 0));
    REQUIRE_OK(csgrt_edit_add_top(c_edit, "hub.r", turn.data()));
    REQUIRE_OK(csgrt_edit_add(c_edit, lamp, "lamp", 1));
    CHECK_REFUSED(csgrt_edit_erase(c_edit, "/all/wheel@3"), CSGRT_ERROR_USAGE, "'wheel' has other uses");
    REQUIRE_OK(csgrt_edit_erase(c_edit, "lamp"));
    REQUIRE_OK(csgrt_edit_replace(c_edit, "box", parts, "hub.r"));
    REQUIRE_OK(csgrt_edit_commit(c_edit, &c_model));
    Edit edit(csgrt::Model(parse_scene(wheels, "wheels.json")));
    edit.set_matrix("all/wheel@2", turn).move("all/wheel@2/hub.r", turn).move("/", turn).add_top("hub.r", turn);
    const csgrt::Model model = edit.replace("box", Ell{{}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}).commit();

    for (const char* path : {"all", "hub.r", "/all/wheel@2", "/all/wheel@2/hub.r", "/all/wheel@2/rim.r/box"}) {
        CHECK(matrix(csgrt_model_matrix_of, &*c_model.handle, path) == model.matrix_of(path));
        CHECK(matrix(csgrt_model_placement_of, &*c_model.handle, path) == model.placement_of(path));
        std::int32_t index = 0;
        REQUIRE_OK(csgrt_model_find_region(c_model, path, &index));
        CHECK(index == model.region(path));
        std::string children, expected;
        for (const ChildInfo& c : model.children(path))
            expected += c.path + c.name + c.object + c.type + std::to_string(int(c.op));
        const auto take = [](void* user, const csgrt_child_info* c) {
            *static_cast<std::string*>(user) +=
                std::string(c->path) + c->name + c->object + c->type + std::to_string(c->op);
            return int(c->size == sizeof *c);
        };
        REQUIRE_OK(csgrt_model_children(c_model, path, take, &children));
        CHECK(children == expected);
    }
    REQUIRE_OK(csgrt_model_scene(c_model, &edited));
    std::size_t count = 0;
    const auto first_alone = [](void* user, const csgrt_child_info*) {
        return int(++*static_cast<std::size_t*>(user) < 1);
    };
    REQUIRE_OK(csgrt_model_children(c_model, "/", first_alone, &count));
    CHECK(count == 1);
    // Places go from scene to scene.
    const Matrix places[] = {matrix([&](double* m) { return csgrt_scene_top_matrix(edited, 0, m); }),
                             matrix([&](double* m) { return csgrt_scene_top_matrix(edited, 1, m); })};
    CHECK((places[0] == turn && places[1] == turn));
    const char* const top[] = {"all", "hub.r"};
    REQUIRE_OK(csgrt_scene_set_top(edited, top, 2));
    CHECK(matrix([&](double* m) { return csgrt_scene_top_matrix(edited, 0, m); }) == identity);
    REQUIRE_OK(csgrt_scene_set_top_matrices(edited, places[0].data(), 1));
    CHECK_REFUSED(csgrt_model_create(edited, nullptr, 0, nullptr, &c_model), CSGRT_ERROR_SCENE, "1 places for 2");
    REQUIRE_OK(csgrt_scene_set_top_matrices(edited, places[0].data(), 2));
    REQUIRE_OK(csgrt_model_create(edited, nullptr, 0, nullptr, &c_model));
    CHECK(matrix(csgrt_model_matrix_of, &*c_model.handle, "hub.r") == turn);
}

// Each edit is written as a line of Python, too, which its interpreter runs.
TEST_CASE("after 100 edits C++, C, librt's shape, the command and Python have the same bits",
          "[.interfaces][promise:c]") {
    Wheels made;
    auto& [c_scene, c_model, c_renderer] = made;
    OwnedScene parts, edited;
    REQUIRE_OK(csgrt_scene_create(&parts));
    const Scene scene = parse_scene(wheels, "wheels.json");
    Renderer renderer(scene);
    std::string python;
    std::mt19937 random(61);
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
        const std::string moved = text_of("csgrt.translate(", 20 * x, ", ", -30 * y, ", ", x, ")");
        switch (i % 6 == 5 && regions.size() < 16 ? 4 : i % 6) {
            case 0: {
                const csgrt_vec3 color{x, y, 1};
                edit.set_color(path, {x, y, 1});
                REQUIRE_OK(csgrt_edit_set_color(c_edit, path.c_str(), &color));
                python += text_of("scene['", path, "'].color = (", x, ", ", y, ", 1)\n");
                break;
            }
            case 1: {
                const int state = static_cast<int>(random() % 3);
                edit.set_state(path, static_cast<State>(state));
                REQUIRE_OK(csgrt_edit_set_state(c_edit, path.c_str(), state));
                python += text_of("scene['", path, "'].state = ['shown', 'ghost', 'hidden'][", state, "]\n");
                break;
            }
            case 2: {
                csgrt_finish finish = CSGRT_FINISH;
                finish.specular = x;
                edit.set_finish(path, {.specular = x});
                REQUIRE_OK(csgrt_edit_set_finish(c_edit, path.c_str(), &finish));
                python += text_of("scene['", path, "'].finish = {'specular': ", x, "}\n");
                break;
            }
            case 3:
                edit.set_matrix(path, matrix);
                REQUIRE_OK(csgrt_edit_set_matrix(c_edit, path.c_str(), matrix.data(), 0));
                python += text_of("scene['", path, "'].matrix = ", moved, "\n");
                break;
            case 4: {
                const double radius = 1 + 20 * x, center[] = {0, 0, 0};
                const std::string name = text_of("new", i), solid = name + ".sphere1";  // as Python calls it
                const csgrt_member members[] = {{"center", center, 3, 0, nullptr}, {"radius", &radius, 1, 0, nullptr}};
                const Ell ball{{}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}};
                REQUIRE_OK(csgrt_scene_add_solid(parts, solid.c_str(), "sphere", members, 2));
                if (y < 0.5) {
                    edit.replace("ball", ball);
                    REQUIRE_OK(csgrt_edit_replace(c_edit, "ball", parts, solid.c_str()));
                    python += text_of("scene.replace('ball', csgrt.sphere(", radius, "))\n");
                    break;
                }
                const csgrt_tree_node leaf = CSGRT_OBJECT(solid.c_str());
                csgrt_combination whole = CSGRT_COMBINATION;
                whole.name = name.c_str();
                whole.nodes = &leaf;
                whole.node_count = 1;
                whole.region = 1;
                REQUIRE_OK(csgrt_scene_add_combination(parts, &whole));
                edit.add(Combination{.name = name, .tree = tree(solid), .region = true}).add(Solid{solid, ball});
                edit.add("wheel", Operator::union_, name, matrix);
                REQUIRE_OK(csgrt_edit_add(c_edit, parts, name.c_str(), 0));
                REQUIRE_OK(csgrt_edit_add(c_edit, parts, solid.c_str(), 0));
                REQUIRE_OK(csgrt_edit_add_leg(c_edit, "wheel", CSGRT_UNION, name.c_str(), matrix.data()));
                python += text_of("scene.add('", name, "', csgrt.sphere(", radius, "), top=False)\n");
                python += text_of("scene.add_leg('wheel', '", name, "', matrix=", moved, ")\n");
                break;
            }
            default:
                edit.remove(path);
                REQUIRE_OK(csgrt_edit_remove(c_edit, path.c_str()));
                python += text_of("scene.remove('", path, "')\n");
        }
        renderer.set_model(edit.commit());
        REQUIRE_OK(csgrt_edit_commit(c_edit, &c_model));
        REQUIRE_OK(csgrt_renderer_set_model(c_renderer, c_model));
        python += "scene.commit()\n";
    }
    OwnedModel latest;
    REQUIRE_OK(csgrt_renderer_model(c_renderer, &latest));
    require_same_rays(latest, c_renderer, renderer);
    require_same_places(latest, c_renderer, renderer);
    require_same_pictures(c_scene, latest, c_renderer, renderer, scene.camera);
    csgrt_model_info info = CSGRT_MODEL_INFO;
    REQUIRE_OK(csgrt_model_get_info(latest, &info));
    REQUIRE(info.region_count == renderer.model().regions().size());
    for (std::size_t i = 0; i < info.region_count; ++i) {
        csgrt_region_info region = CSGRT_REGION_INFO;
        REQUIRE_OK(csgrt_model_region(latest, i, &region));
        CHECK(region.path == renderer.model().regions()[i].path);
        CHECK(region.state == static_cast<int>(renderer.model().regions()[i].state));
        csgrt_finish finish = CSGRT_FINISH;
        REQUIRE_OK(csgrt_model_finish(latest, i, &finish));
        CHECK(finish.specular == renderer.model().regions()[i].finish.specular);
    }

    const Folder folder;
    const std::string file = folder / "edited.json";
    REQUIRE_OK(csgrt_model_scene(latest, &edited));
    REQUIRE_OK(csgrt_save_scene(edited, file.c_str()));
    save_scene(renderer.model().scene(), folder / "edited_by_cpp.json");
    CHECK((read_file(file) == read_file(folder / "edited_by_cpp.json")));
    const std::vector<Ray> rays = random_rays(renderer.model().bounds(), 200);
    require_same_librt(file, rays, renderer.shoot(rays));
    const Answers expected = answers_of(renderer, rays, scene.camera);
    CHECK(std::ranges::any_of(expected.rows.in_normals, [](const Vec3& n) { return n.x == 0 && std::signbit(n.x); }));
    CHECK(expected.bytes.at("ghost").find_first_not_of('\0') != std::string::npos);
    CHECK_FALSE(expected.bytes.at("overlap_t_in").empty());
    require_same_command(file, rays, expected);
    require_same_python(python, read_file(file), rays, expected);

    // What Python has no names for.
    OwnedEdit c_edit;
    Edit edit(renderer.model());
    REQUIRE_OK(csgrt_edit_create(latest, &c_edit));
    const std::string path = renderer.model().regions()[0].path;
    const Matrix matrix = {1, 0, 0, 9, 0, 1, 0, -7, 0, 0, 1, 2, 0, 0, 0, 1};
    csgrt_light light = CSGRT_LIGHT;
    light.position = {50, 100, 100};
    const csgrt_vec3 color{0, 0.5, 0};
    edit.set_matrix(path, matrix, Edit::Share::all).set_lights({{.position = {50, 100, 100}}});
    edit.set_ambient(0.3).set_background({0, 0.5, 0});
    REQUIRE_OK(csgrt_edit_set_matrix(c_edit, path.c_str(), matrix.data(), 1));
    REQUIRE_OK(csgrt_edit_set_lights(c_edit, &light, 1));
    REQUIRE_OK(csgrt_edit_set_ambient(c_edit, 0.3));
    REQUIRE_OK(csgrt_edit_set_background(c_edit, &color));
    renderer.set_model(edit.commit());
    REQUIRE_OK(csgrt_edit_commit(c_edit, &latest));
    REQUIRE_OK(csgrt_renderer_set_model(c_renderer, latest));
    require_same_rays(latest, c_renderer, renderer);
    require_same_pictures(c_scene, latest, c_renderer, renderer, scene.camera);
}

TEST_CASE("batches from C are those of a grid, and may be ended", "[promise:c]") {
    const Wheels w;
    NewPartitions whole;
    csgrt_model_info info = CSGRT_MODEL_INFO;
    REQUIRE_OK(csgrt_model_get_info(w.model, &info));
    csgrt_ray_grid grid;
    REQUIRE_OK(csgrt_rays_parallel(&info.bounds, 1, 20, 30, &grid));
    csgrt_rays rays = CSGRT_RAYS;
    rays.grid = &grid;
    REQUIRE_OK(csgrt_renderer_partitions(w.renderer, &rays, whole));
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
    REQUIRE_OK(csgrt_renderer_partitions_in_batches(w.renderer, &rays, 250, take, &seen));
    CHECK(seen.batches == 3);
    CHECK(same_bytes(all.t_in, all.row_count, seen.t_in));
    seen = {.most = 1};
    REQUIRE_OK(csgrt_renderer_partitions_in_batches(w.renderer, &rays, 250, take, &seen));
    CHECK(seen.batches == 1);
    csgrt_statistics statistics = CSGRT_STATISTICS;
    REQUIRE_OK(csgrt_renderer_statistics(w.renderer, &statistics));
    CHECK(statistics.rays == 250);
}
