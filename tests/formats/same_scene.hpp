// Whether two scenes are the same model, bit for bit; places aside, which tell where it was read.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Every number and text of a scene in one order, as bytes.
class SceneBytes {
public:
    explicit SceneBytes(const Scene& scene) {
        add(scene.title, scene.units, scene.unit_length, scene.camera.azimuth, scene.camera.elevation,
            scene.camera.perspective, scene.camera.center, scene.camera.view_size, scene.camera.eye,
            scene.camera.look_at, scene.camera.up, scene.ambient, scene.background, scene.tolerance,
            scene.lights.size(), scene.objects.size(), scene.top.size(), scene.region_colors.size(),
            scene.densities.size());
        for (const Light& light : scene.lights)
            add(light.position, light.color, light.intensity, light.infinite, light.angle, light.direction);
        for (const std::string& name : scene.top) add(name);
        add(scene.top_matrices);
        for (const RegionColor& range : scene.region_colors) add(range.low, range.high, range.color);
        for (const Density& row : scene.densities) add(row.material_id, row.path, row.density, row.name);
        for (const Object& object : scene.objects) {
            add(object.index(), name_of(object));
            if (const auto* solid = std::get_if<Solid>(&object)) {
                add_any(solid->shape);
            } else {
                add_combination(std::get<Combination>(object));
            }
        }
    }
    explicit SceneBytes(const Shape& shape) { add_any(shape); }
    explicit SceneBytes(const Combination& combination) { add_combination(combination); }
    const std::string& bytes() const { return bytes_; }

private:
    void add_any(const Shape& any) {
        add(any.index());
        std::visit([this](const auto& shape) { add_shape(shape); }, any);
    }
    template <class... T>
    void add(const T&... values) {
        (add_one(values), ...);
    }
    void add_one(const std::string& text) {
        add_one(text.size());
        bytes_ += text;
    }
    template <class T>
    void add_one(const std::optional<T>& value) {
        add_one(value.has_value());
        if (value) add_one(*value);
    }
    template <class T>
    void add_one(const std::vector<T>& values) {
        add_one(values.size());
        for (const T& value : values) add_one(value);
    }
    void add_one(const Sketch& sketch) {
        add(sketch.name, sketch.vertices, sketch.curves.size(), sketch.reversed);
        for (const Sketch::Curve& curve : sketch.curves) {
            add(curve.index());
            std::visit([this](const auto& it) { add_curve(it); }, curve);
        }
    }
    template <class T>
    void add_one(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class Numbers>
    void add_shape(const Numbers& shape) {
        add_one(shape);
    }
    void add_shape(const Arbn& shape) {
        add(shape.planes.size());
        for (const Plane& plane : shape.planes) add(plane);
    }
    void add_shape(const Metaball& s) {
        add(s.method, s.threshold, s.points.size());
        for (const Metaball::Point& p : s.points) add(p.position, p.strength, p.softness);
    }
    void add_shape(const Pipe& s) {
        add(s.points.size());
        for (const Pipe::Point& p : s.points) add(p.position, p.outer, p.inner, p.bend);
    }
    void add_shape(const Bot& s) {
        add(s.mode, s.orientation, s.vertices, s.faces, s.thickness, s.append, s.normals, s.face_normals);
    }
    void add_shape(const Ars& s) { add(s.curves); }
    void add_shape(const Nmg& s) { add(s.vertices, s.faces); }
    void add_shape(const Ebm& s) { add(s.file, s.width, s.depth, s.height, s.matrix, s.cells); }
    void add_shape(const Vol& s) { add(s.file, s.width, s.depth, s.height, s.low, s.high, s.cell, s.matrix, s.cells); }
    void add_shape(const Dsp& s) { add(s.file, s.width, s.depth, s.smooth, s.cut, s.matrix, s.heights); }
    void add_shape(const Extrude& s) { add(s.v, s.h, s.a, s.b, s.sketch); }
    void add_shape(const Revolve& s) { add(s.v, s.axis, s.r, s.angle, s.sketch); }
    void add_shape(const Unsupported& shape) { add(shape.type); }

    void add_curve(const Sketch::Line& c) { add(c.start, c.end); }
    void add_curve(const Sketch::Arc& c) { add(c.start, c.end, c.radius, c.center_left, c.clockwise); }
    void add_curve(const Sketch::Bezier& c) { add(c.points); }
    void add_curve(const Sketch::Nurb& c) { add(c.order, c.knots, c.points, c.weights); }

    void add_combination(const Combination& c) {
        add(c.tree.nodes.size(), c.region, c.region_id, c.air, c.fastgen, c.material_id, c.los, c.color,
            c.finish.has_value(), c.color_inherits, c.finish_inherits);
        if (c.finish) {
            add(c.finish->shader, c.finish->specular, c.finish->diffuse, c.finish->ambient, c.finish->shine,
                c.finish->transmit, c.finish->reflect, c.finish->light.has_value());
            if (const auto& l = c.finish->light)
                add(l->intensity, l->fraction, l->angle, l->target, l->direction, l->infinite, l->visible, l->shadows);
        }
        for (const TreeNode& node : c.tree.nodes) add(node.op, node.arity, node.object, node.matrix);
    }

    std::string bytes_;
};

/// Name, tree and place aside.
inline bool same_attributes(Combination a, Combination b) {
    for (Combination* combination : {&a, &b}) combination->name.clear(), combination->tree = {};
    return SceneBytes(a).bytes() == SceneBytes(b).bytes();
}
inline bool same_scene(const Scene& a, const Scene& b) { return SceneBytes(a).bytes() == SceneBytes(b).bytes(); }
inline bool same_shape(const Shape& a, const Shape& b) { return SceneBytes(a).bytes() == SceneBytes(b).bytes(); }

}  // namespace csgrt
