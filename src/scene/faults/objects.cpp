#include "scene/faults/objects.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "scene/operators.hpp"
#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

bool in_range(double value, double low, double high) {
    return value >= low && value <= high;  // also false for NaN
}
bool not_negative(double value) { return value >= 0 && std::isfinite(value); }
bool is_axis(const Vec3& v) { return is_finite(v) && v != Vec3{}; }
bool is_color(const Vec3& color) {
    return in_range(color.x, 0, 1) && in_range(color.y, 0, 1) && in_range(color.z, 0, 1);
}

/// Checks values that a scene has once. Their places have no file, because the scene does not know it.
class Settings {
public:
    explicit Settings(const Report& report) : report_(report) {}
    void require(bool holds, const char* pointer, const std::string& message, const char* suggestion = "") const {
        if (!holds) report_(Place{.file = {}, .pointer = pointer}, message, suggestion);
    }

private:
    const Report& report_;
};

}  // namespace

void check_tree(const Combination& combination, const Report& report) {
    std::uint64_t waiting = 0;  // operands that no operator has taken yet
    for (const TreeNode& node : combination.tree.nodes) {
        const auto name = [&] { return std::string(operator_name(node.op)); };
        if (operator_name(node.op).empty()) {
            report(node.place, "this is no operator of a tree", {});
            return;
        }
        if (!takes(node.op, node.arity)) {
            report(
                node.place, "'" + name() + "' cannot have " + std::to_string(node.arity) + " operands",
                node.op == Operator::difference ? "give the object that is cut, then those that are taken away" : "");
            return;
        }
        if (node.arity > waiting) {
            report(node.place, "the tree lacks operands for '" + name() + "'", {});
            return;
        }
        waiting = waiting - node.arity + 1;
    }
    if (waiting > 1) report(combination.place, "the tree has operands that no operator combines", {});
}

void check_matrix(const TreeNode& leaf, const Report& report) {
    const Matrix& m = leaf.matrix;
    const auto of = [&] { return "the matrix of '" + leaf.object + "' "; };
    if (!std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); })) {
        report(leaf.place, of() + "has a number that is not finite", {});
        return;
    }
    const double most =
        std::abs(*std::max_element(m.begin(), m.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (most > Limits::length) {
        report(leaf.place, of() + "has the number " + number_text(most) + "; " + length_limit(), {});
        return;
    }
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        report(leaf.place, of() + "must end in the row 0 0 0 1",
               "points are columns: p' = M p, translation in the last column");
        return;
    }
    const Vec3 x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]};
    if (dependent(x, y, z)) {
        report(leaf.place, of() + "is singular: it flattens the object",
               "give it a scale other than 0 along every axis");
    }
}

void check_emission(const Emission& light, const Place& place, const Report& report) {
    if (!not_negative(light.intensity) || !not_negative(light.fraction))
        report(place, "the intensity and the fraction of a light must be 0 or more, and finite", {});
    if (!in_range(light.angle, 0, 180)) report(place, "the angle of a beam must be from 0 to 180 degrees", {});
    if (light.target && (!is_finite(*light.target) || largest(*light.target) > Limits::length))
        report(place, "the target of a light must be finite; " + length_limit(), {});
    if (light.direction && !is_axis(*light.direction))
        report(place, "the direction of a light must be finite, and not 0", {});
}

void check_settings(const Scene& scene, const Report& report) {
    const Settings settings(report);
    settings.require(scene.unit_length > 0 && std::isfinite(scene.unit_length), "/units",
                     "a unit must be longer than 0");
    const std::string limit = "; " + length_limit();
    settings.require(not_negative(scene.tolerance), "/tolerance", "the tolerance must be 0 or more, and finite");
    settings.require(!(scene.tolerance > Limits::length), "/tolerance",
                     "the tolerance is " + number_text(scene.tolerance) + " mm" + limit);
    settings.require(not_negative(scene.ambient), "/ambient", "the ambient light must be 0 or more, and finite");
    settings.require(is_color(scene.background), "/background", "a colour has components from 0 to 1");
    for (const Light& light : scene.lights) {
        settings.require(is_finite(light.position), "/lights", "the position of a light must be finite");
        settings.require(!(largest(light.position) > Limits::length), "/lights",
                         "a light stands at " + number_text(largest(light.position)) + " mm" + limit);
        settings.require(is_color(light.color), "/lights", "a colour has components from 0 to 1");
        settings.require(not_negative(light.intensity), "/lights", "an intensity must be 0 or more, and finite");
        settings.require(in_range(light.angle, 0, 180), "/lights", "the angle of a beam must be from 0 to 180 degrees");
        settings.require(is_axis(light.direction), "/lights", "the direction of a beam must be finite, and not 0");
    }
    const std::size_t places = scene.top_matrices.size();
    settings.require(
        places == 0 || places == scene.top.size(), "/objects",
        "there are " + std::to_string(places) + " places for " + std::to_string(scene.top.size()) + " top objects",
        "Scene::top_matrices has one for each, or none");
    std::unordered_map<std::string_view, const Matrix*> first;
    for (std::size_t i = 0; i < std::min(places, scene.top.size()); ++i) {
        const Place place{.file = {}, .pointer = "/objects/" + std::to_string(i)};
        check_matrix({.object = scene.top[i], .matrix = scene.top_matrices[i], .place = place}, report);
        if (*first.try_emplace(scene.top[i], &scene.top_matrices[i]).first->second != scene.top_matrices[i])
            report(place, "'" + scene.top[i] + "' is rendered in two places",
                   "make it a member of a combination twice: a top object has one place");
    }
    for (const Look& look : scene.looks)
        check_attributes({.name = look.path,
                          .color = look.color,
                          .finish = look.finish,
                          .place = {.file = {}, .pointer = "/looks/" + look.path}},
                         report);
    const Camera& camera = scene.camera;
    settings.require(std::isfinite(camera.azimuth) && std::isfinite(camera.elevation), "/camera",
                     "azimuth and elevation must be finite");
    settings.require(camera.perspective >= 0 && camera.perspective < 180, "/camera",
                     "the perspective must be 0 or an angle below 180 degrees");
    settings.require(!camera.center || is_finite(*camera.center), "/camera", "the centre must be finite");
    settings.require(!camera.eye || is_finite(*camera.eye), "/camera", "the eye must be finite");
    settings.require(!camera.look_at || is_finite(*camera.look_at), "/camera", "the point to look at must be finite");
    settings.require(!camera.up || is_axis(*camera.up), "/camera", "the direction upward must be finite, and not 0");
    settings.require(!camera.center || !camera.look_at, "/camera",
                     "the centre and the point to look at are one: leave one out");
    settings.require(!camera.eye || !camera.view_size || !(camera.perspective > 0), "/camera",
                     "the eye and the perspective give the size of the view: leave one of the three out");
    settings.require(!camera.view_size || (*camera.view_size > 0 && std::isfinite(*camera.view_size)), "/camera",
                     "the size of the view must be greater than 0, and finite");
}

void check_attributes(const Combination& combination, const Report& report) {
    if (combination.color && !is_color(*combination.color)) {
        report(combination.place, "a colour has components from 0 to 1", {});
    }
    if (combination.finish) {
        const Finish& finish = *combination.finish;
        for (const auto& [name, value] : {std::pair{"specular", finish.specular}, std::pair{"diffuse", finish.diffuse},
                                          std::pair{"ambient", finish.ambient}, std::pair{"transmit", finish.transmit},
                                          std::pair{"reflect", finish.reflect}}) {
            if (!not_negative(value)) {
                report(combination.place, std::string("'") + name + "' must be 0 or more, and finite", {});
            }
        }
        if (finish.light) check_emission(*finish.light, combination.place, report);
        if (finish.shine < 0 || finish.shine > Limits::shine) {
            report(combination.place, "'shine' must be from 0 to " + std::to_string(Limits::shine), {});
        }
    }
}

void check_combination(const Combination& combination, const Report& report) {
    check_attributes(combination, report);
    check_tree(combination, report);
    for (const TreeNode& node : combination.tree.nodes) {
        if (node.op == Operator::leaf) check_matrix(node, report);
    }
}

}  // namespace csgrt
