#include <algorithm>

#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

csgrt_status csgrt_model_create(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                                const csgrt_settings* settings, csgrt_model** model) {
    return make(model, [&] {
        return Model(CSGRT_NEED(scene).scene, texts(objects, object_count, "objects"), settings_of(settings));
    });
}

void csgrt_model_free(csgrt_model* model) { delete model; }

csgrt_status csgrt_model_scene(const csgrt_model* model, csgrt_scene** scene) {
    return make(scene, [&] { return CSGRT_NEED(model).model.scene(); });
}

csgrt_status csgrt_model_get_info(const csgrt_model* model, csgrt_model_info* info) {
    return call([&] {
        const Model& m = CSGRT_NEED(model).model;
        fill(info, {0, of(m.bounds()), m.tolerance(), m.regions().size(), m.solids().size(), m.warnings().size()},
             "info");
    });
}

csgrt_status csgrt_model_region(const csgrt_model* model, size_t index, csgrt_region_info* info) {
    return call([&] { fill(info, shown<csgrt_region_info>(item(CSGRT_NEED(model).model.regions(), index)), "info"); });
}

csgrt_status csgrt_model_find_region(const csgrt_model* model, const char* path, int32_t* index) {
    return call([&] { CSGRT_NEED(index) = CSGRT_NEED(model).model.region(&CSGRT_NEED(path)); });
}

csgrt_status csgrt_model_children(const csgrt_model* model, const char* path, csgrt_take_child take, void* user) {
    return call([&] {
        if (!take) refuse("take is NULL");
        for (const ChildInfo& child : CSGRT_NEED(model).model.children(&CSGRT_NEED(path))) {
            csgrt_child_info info = shown<csgrt_child_info>(child);
            info.size = sizeof info;
            if (take(user, &info) == 0) return;
        }
    });
}

csgrt_status csgrt_model_matrix_of(const csgrt_model* model, const char* path, double matrix[16]) {
    return call([&] {
        const Matrix found = CSGRT_NEED(model).model.matrix_of(&CSGRT_NEED(path));
        std::ranges::copy(found, &CSGRT_NEED(matrix));
    });
}

csgrt_status csgrt_model_placement_of(const csgrt_model* model, const char* path, double matrix[16]) {
    return call([&] {
        const Matrix found = CSGRT_NEED(model).model.placement_of(&CSGRT_NEED(path));
        std::ranges::copy(found, &CSGRT_NEED(matrix));
    });
}

csgrt_status csgrt_model_finish(const csgrt_model* model, size_t region, csgrt_finish* finish) {
    return call([&] {
        const Finish& f = item(CSGRT_NEED(model).model.regions(), region).finish;
        csgrt_finish all CSGRT_FINISH;
        all.shader = f.shader.c_str();
        all.specular = f.specular;
        all.diffuse = f.diffuse;
        all.ambient = f.ambient;
        all.shine = f.shine;
        all.transmit = f.transmit;
        all.reflect = f.reflect;
        if (f.light) {
            all.shines = 1;
            all.intensity = f.light->intensity;
            all.fraction = f.light->fraction;
            all.angle = f.light->angle;
            all.target = of(f.light->target);
            all.direction = of(f.light->direction);
            all.infinite = f.light->infinite;
            all.visible = f.light->visible;
            all.shadows = f.light->shadows;
        }
        fill(finish, all, "finish");
    });
}

csgrt_status csgrt_model_solid(const csgrt_model* model, size_t index, csgrt_solid_info* info) {
    return call([&] { fill(info, shown<csgrt_solid_info>(item(CSGRT_NEED(model).model.solids(), index)), "info"); });
}

csgrt_status csgrt_model_solid_json(const csgrt_model* model, size_t index, const char** json) {
    return call([&] {
        static thread_local std::string text;
        const std::optional<Shape> shape = CSGRT_NEED(model).model.solid(index);
        if (shape) text = json_text(*shape);
        CSGRT_NEED(json) = shape ? text.c_str() : nullptr;
    });
}

csgrt_status csgrt_model_warning(const csgrt_model* model, size_t index, csgrt_diagnostic* warning) {
    return call([&] { fill(warning, diagnostic_of(item(CSGRT_NEED(model).model.warnings(), index)), "warning"); });
}

csgrt_status csgrt_model_pick(const csgrt_model* model, const csgrt_view* view, int column, int row, csgrt_pick* pick) {
    return call([&] {
        const Pick p = CSGRT_NEED(model).model.pick(view_of(view), column, row);
        fill(pick, {0, p.region, p.solid, p.t, of(p.point), of(p.normal), of(p.ray)}, "pick");
    });
}

csgrt_status csgrt_model_grid_of(const csgrt_model* model, const csgrt_view* view, csgrt_ray_grid* grid) {
    return call([&] { CSGRT_NEED(grid) = shown<csgrt_ray_grid>(CSGRT_NEED(model).model.grid_of(view_of(view))); });
}

// ---- Edits ----

csgrt_status csgrt_edit_create(const csgrt_model* model, csgrt_edit** edit) {
    return make(edit, [&] { return Edit(CSGRT_NEED(model).model); });
}

void csgrt_edit_free(csgrt_edit* edit) { delete edit; }

csgrt_status csgrt_edit_set_color(csgrt_edit* edit, const char* path, const csgrt_vec3* color) {
    return call([&] { CSGRT_NEED(edit).edit.set_color(&CSGRT_NEED(path), of(CSGRT_NEED(color))); });
}

csgrt_status csgrt_edit_set_finish(csgrt_edit* edit, const char* path, const csgrt_finish* finish) {
    return call([&] { CSGRT_NEED(edit).edit.set_finish(&CSGRT_NEED(path), finish_of(finish)); });
}

csgrt_status csgrt_edit_set_state(csgrt_edit* edit, const char* path, int state) {
    return call([&] { CSGRT_NEED(edit).edit.set_state(&CSGRT_NEED(path), choice(state, State::hidden, "state")); });
}

csgrt_status csgrt_edit_set_lights(csgrt_edit* edit, const csgrt_light* lights, size_t count) {
    return call([&] { CSGRT_NEED(edit).edit.set_lights(lights_of(lights, count)); });
}

csgrt_status csgrt_edit_set_ambient(csgrt_edit* edit, double intensity) {
    return call([&] { CSGRT_NEED(edit).edit.set_ambient(intensity); });
}

csgrt_status csgrt_edit_set_background(csgrt_edit* edit, const csgrt_vec3* color) {
    return call([&] { CSGRT_NEED(edit).edit.set_background(of(CSGRT_NEED(color))); });
}

csgrt_status csgrt_edit_set_matrix(csgrt_edit* edit, const char* path, const double matrix[16], int share_all) {
    return call([&] {
        CSGRT_NEED(edit).edit.set_matrix(&CSGRT_NEED(path), matrix_of(&CSGRT_NEED(matrix)),
                                         share_all ? Edit::Share::all : Edit::Share::alone);
    });
}

csgrt_status csgrt_edit_move(csgrt_edit* edit, const char* path, const double matrix[16], int share_all) {
    return call([&] {
        CSGRT_NEED(edit).edit.move(&CSGRT_NEED(path), matrix_of(&CSGRT_NEED(matrix)),
                                   share_all ? Edit::Share::all : Edit::Share::alone);
    });
}

namespace {

const Object& object_in(const csgrt_scene& scene, const std::string& name) {
    const Object* object = scene.scene.find(name);
    if (!object) refuse("the scene has no object '" + name + "'");
    return *object;
}

}  // namespace

csgrt_status csgrt_edit_replace(csgrt_edit* edit, const char* solid, const csgrt_scene* scene, const char* name) {
    return call([&] {
        const Object* from = &object_in(CSGRT_NEED(scene), &CSGRT_NEED(name));
        Matrix matrix = identity;
        if (const auto* moved = std::get_if<Combination>(from); moved && moved->tree.nodes.size() == 1) {
            matrix = moved->tree.nodes[0].matrix;
            from = &object_in(*scene, moved->tree.nodes[0].object);
        }
        if (!std::holds_alternative<Solid>(*from))
            refuse("'" + std::string(name) + "' is a combination, expected a solid or a combination of one solid");
        CSGRT_NEED(edit).edit.replace(&CSGRT_NEED(solid), std::get<Solid>(*from).shape, matrix);
    });
}

csgrt_status csgrt_edit_add(csgrt_edit* edit, const csgrt_scene* scene, const char* name, int top) {
    return call([&] { CSGRT_NEED(edit).edit.add(object_in(CSGRT_NEED(scene), &CSGRT_NEED(name)), top != 0); });
}

csgrt_status csgrt_edit_add_top(csgrt_edit* edit, const char* object, const double* matrix) {
    return call([&] { CSGRT_NEED(edit).edit.add_top(&CSGRT_NEED(object), matrix_of(matrix)); });
}

csgrt_status csgrt_edit_add_leg(csgrt_edit* edit, const char* combination, csgrt_operator op, const char* object,
                                const double* matrix) {
    return call([&] {
        CSGRT_NEED(edit).edit.add(&CSGRT_NEED(combination), choice(op, Operator::not_, "op"), &CSGRT_NEED(object),
                                  matrix_of(matrix));
    });
}

csgrt_status csgrt_edit_remove(csgrt_edit* edit, const char* path) {
    return call([&] { CSGRT_NEED(edit).edit.remove(&CSGRT_NEED(path)); });
}

csgrt_status csgrt_edit_erase(csgrt_edit* edit, const char* path) {
    return call([&] { CSGRT_NEED(edit).edit.erase(&CSGRT_NEED(path)); });
}

csgrt_status csgrt_edit_commit(const csgrt_edit* edit, csgrt_model** model) {
    return make(model, [&] { return CSGRT_NEED(edit).edit.commit(); });
}
