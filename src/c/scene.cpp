#include <algorithm>
#include <charconv>

#include "c/described.hpp"
#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

namespace {

LoadOptions options_of(const csgrt_load_options* options) {
    if (!options) return {};
    return described<LoadOptions>(read(options, csgrt_load_options CSGRT_LOAD_OPTIONS, "options"), "options");
}

void add(csgrt_scene& to, Object object) {
    auto& [scene, names] = to;
    if (names.size() != scene.objects.size()) {
        for (const Object& old : scene.objects) names.insert(name_of(old));
    }
    if (!names.insert(name_of(object)).second) refuse("the scene has an object '" + name_of(object) + "' already");
    scene.objects.push_back(std::move(object));
}

// ---- Solids, which go through JSON: the reader of JSON describes and checks all types and members ----

void put_text(std::string& json, std::string_view text) {
    constexpr char digits[] = "0123456789abcdef";
    json += '"';
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < ' ') {
            json += "\\u00";
            json += digits[c / 16];
            json += digits[c % 16];
        } else {
            if (c == '"' || c == '\\') json += '\\';
            json += c;
        }
    }
    json += '"';
}

/// Appends numbers with as many digits as keep all their bits.
void put_numbers(std::string& json, std::span<const double> numbers) {
    for (const double& number : numbers) {
        char digits[32];
        if (&number != numbers.data()) json += ',';
        json.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
    }
}

void put_value(std::string& json, const csgrt_member& member) {
    const auto numbers = needed(member.values, member.count, "member.values");
    for (const double number : numbers) {
        if (!std::isfinite(number)) refuse("the member '" + std::string(member.name) + "' has a number without end");
    }
    if (member.columns == 0 && numbers.size() == 1) return put_numbers(json, numbers);
    const std::size_t columns = member.columns == 0 ? numbers.size() : member.columns;
    if (numbers.empty() || numbers.size() % columns != 0) {
        refuse("the member '" + std::string(member.name) + "' has " + std::to_string(numbers.size()) +
               " numbers, expected whole rows of " + std::to_string(columns));
    }
    if (member.columns > 0) json += '[';
    for (std::size_t i = 0; i < numbers.size(); i += columns) {
        json += i == 0 ? "[" : ",[";
        put_numbers(json, numbers.subspan(i, columns));
        json += ']';
    }
    if (member.columns > 0) json += ']';
}

}  // namespace

csgrt_status csgrt_load_scene(const char* path, const csgrt_load_options* options, csgrt_scene** scene) {
    return make(scene, [&] { return load_scene(&CSGRT_NEED(path), options_of(options)); });
}

csgrt_status csgrt_parse_scene(const void* bytes, size_t count, const char* name, const csgrt_load_options* options,
                               csgrt_scene** scene) {
    return make(scene, [&] {
        const auto text = needed(static_cast<const char*>(bytes), count, "bytes");
        return parse_scene({text.begin(), text.end()}, &CSGRT_NEED(name), options_of(options));
    });
}

csgrt_status csgrt_scene_create(csgrt_scene** scene) {
    return make(scene, [] { return Scene{}; });
}

void csgrt_scene_free(csgrt_scene* scene) { delete scene; }

csgrt_status csgrt_save_scene(const csgrt_scene* scene, const char* path) {
    return call([&] { save_scene(CSGRT_NEED(scene).scene, &CSGRT_NEED(path)); });
}

csgrt_status csgrt_validate(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                            const csgrt_settings* settings) {
    return call([&] {
        const Settings s = settings_of(settings);
        std::vector<Diagnostic> found = validate(CSGRT_NEED(scene).scene, texts(objects, object_count, "objects"),
                                                 s.skip_unsupported, nullptr, s.max_instances);
        if (!found.empty()) throw Error(Status::scene, std::move(found));
    });
}

csgrt_status csgrt_scene_add_solid(csgrt_scene* scene, const char* name, const char* type, const csgrt_member* members,
                                   size_t member_count) {
    return call([&] {
        std::string json = R"({"csgrt": 1, "solids": {)";
        put_text(json, &CSGRT_NEED(name));
        json += R"(: {"type": )";
        put_text(json, &CSGRT_NEED(type));
        for (const csgrt_member& member : needed(members, member_count, "members")) {
            json += ", ";
            put_text(json, &needed(member.name, "member.name"));
            json += ": ";
            if (member.json) {
                json += member.json;
            } else {
                put_value(json, member);
            }
        }
        Scene read = parse_scene(json + "}}}", name);
        if (read.objects.size() != 1) refuse("a member's JSON ends the solid '" + std::string(name) + "'");
        Solid& solid = std::get<Solid>(read.objects[0]);
        solid.place = {};  // the solid was not read from a file
        add(CSGRT_NEED(scene), std::move(solid));
    });
}

csgrt_status csgrt_scene_add_mesh(csgrt_scene* scene, const char* name, const csgrt_vec3* vertices, size_t vertex_count,
                                  const uint32_t* faces, size_t face_count) {
    return call([&] {
        Bot mesh;
        for (const csgrt_vec3& vertex : needed(vertices, vertex_count, "vertices")) mesh.vertices.push_back(of(vertex));
        if (face_count > Limits::triangles)
            refuse("the mesh '" + std::string(&CSGRT_NEED(name)) + "' has too many faces");
        const auto indices = needed(faces, 3 * face_count, "faces");
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            mesh.faces.push_back({indices[i], indices[i + 1], indices[i + 2]});
        }
        add(CSGRT_NEED(scene), Solid{&CSGRT_NEED(name), std::move(mesh)});
    });
}

csgrt_status csgrt_scene_add_combination(csgrt_scene* scene, const csgrt_combination* combination) {
    return call([&] {
        const csgrt_combination c = read(combination, csgrt_combination CSGRT_COMBINATION, "combination");
        Combination all{
            .name = &needed(c.name, "combination->name"),
            .region = c.region != 0,
            .fastgen = choice(c.fastgen, Fastgen::volume, "combination->fastgen"),
            .region_id = c.region_id,
            .air = c.air,
            .material_id = c.material_id,
            .los = c.los,
            .color = of(c.color),
            .color_inherits = c.color_inherits != 0,
            .finish_inherits = c.finish_inherits != 0,
        };
        if (c.finish) all.finish = finish_of(c.finish);
        for (const csgrt_tree_node& node : needed(c.nodes, c.node_count, "combination->nodes")) {
            const Operator op = choice(node.op, Operator::not_, "the operator of a node");
            if (op == Operator::leaf) needed(node.object, "the object of a leaf");
            TreeNode& made = all.tree.nodes.emplace_back();
            made.op = op;
            made.arity = node.arity;
            made.object = text_or_empty(node.object);
            made.matrix = matrix_of(node.matrix);
            made.name = text_or_empty(node.name);
        }
        add(CSGRT_NEED(scene), std::move(all));
    });
}

csgrt_status csgrt_scene_camera(const csgrt_scene* scene, csgrt_camera* camera) {
    return call([&] { fill(camera, shown<csgrt_camera>(CSGRT_NEED(scene).scene.camera), "camera"); });
}

csgrt_status csgrt_scene_set_camera(csgrt_scene* scene, const csgrt_camera* camera) {
    return call([&] { CSGRT_NEED(scene).scene.camera = camera_of(camera); });
}

csgrt_status csgrt_scene_load_view(csgrt_scene* scene, const char* path) {
    return call([&] { CSGRT_NEED(scene).scene.camera = load_view(&CSGRT_NEED(path)); });
}

csgrt_status csgrt_scene_set_lights(csgrt_scene* scene, const csgrt_light* lights, size_t count) {
    return call([&] { CSGRT_NEED(scene).scene.lights = lights_of(lights, count); });
}

csgrt_status csgrt_scene_set_top(csgrt_scene* scene, const char* const* objects, size_t count) {
    return call([&] {
        CSGRT_NEED(scene).scene.top = texts(objects, count, "objects");
        scene->scene.top_matrices.clear();
    });
}

csgrt_status csgrt_scene_set_top_matrices(csgrt_scene* scene, const double* matrices, size_t count) {
    return call([&] {
        std::vector<Matrix> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(matrix_of(&needed(matrices, "matrices") + 16 * i));
        CSGRT_NEED(scene).scene.top_matrices = std::move(all);
    });
}

csgrt_status csgrt_scene_get_info(const csgrt_scene* scene, csgrt_scene_info* info) {
    return call([&] {
        const Scene& s = CSGRT_NEED(scene).scene;
        fill(info,
             {0, s.title.c_str(), s.units.c_str(), s.unit_length, s.ambient, of(s.background), s.tolerance, s.lenient,
              s.objects.size(), s.top.size(), s.warnings.size()},
             "info");
    });
}

csgrt_status csgrt_scene_set_info(csgrt_scene* scene, const csgrt_scene_info* info) {
    return call([&] {
        const csgrt_scene_info i = read(info, csgrt_scene_info CSGRT_SCENE_INFO, "info");
        Scene& s = CSGRT_NEED(scene).scene;
        // The texts are copied first, because the pointers may lead into the scene.
        std::string title = text_or_empty(i.title), units = text_or_empty(i.units);
        s.title = std::move(title);
        s.units = std::move(units);
        s.unit_length = i.unit_length;
        s.ambient = i.ambient;
        s.background = of(i.background);
        s.tolerance = i.tolerance;
        s.lenient = i.lenient != 0;
    });
}

csgrt_status csgrt_scene_object(const csgrt_scene* scene, size_t index, const char** name, const char** type) {
    return call([&] {
        const Object& object = item(CSGRT_NEED(scene).scene.objects, index);
        if (name) *name = name_of(object).c_str();
        if (type) *type = type_name(object);
    });
}

csgrt_status csgrt_scene_top(const csgrt_scene* scene, size_t index, const char** object) {
    return call([&] { CSGRT_NEED(object) = item(CSGRT_NEED(scene).scene.top, index).c_str(); });
}

csgrt_status csgrt_scene_top_matrix(const csgrt_scene* scene, size_t index, double matrix[16]) {
    return call([&] {
        const Scene& s = CSGRT_NEED(scene).scene;
        static_cast<void>(item(s.top, index));
        std::ranges::copy(s.top_matrices.empty() ? identity : item(s.top_matrices, index), &CSGRT_NEED(matrix));
    });
}

csgrt_status csgrt_scene_warning(const csgrt_scene* scene, size_t index, csgrt_diagnostic* warning) {
    return call([&] { fill(warning, diagnostic_of(item(CSGRT_NEED(scene).scene.warnings, index)), "warning"); });
}
