#include "compile/frame.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <glm/glm.hpp>

#include "compile/window.hpp"
#include "scene/range.hpp"

namespace csgrt {
namespace {

using glm::dvec3;

dvec3 to_glm(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3 from_glm(dvec3 v) { return {v.x, v.y, v.z}; }

void put(dvec3 from, double (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

[[noreturn]] void refuse(const std::string& what) { throw Error(Status::usage, what); }

double finite(double value, const char* what) {
    if (!std::isfinite(value)) refuse(std::string(what) + " must be a finite number");
    return value;
}

double in_range(double value, double least, const char* what) {
    if (std::abs(finite(value, what)) <= Limits::ray_origin && value >= least) return value;
    refuse(std::string(what) + " is " + number_text(value) + " mm, and must be from " + number_text(least) + " to " +
           number_text(Limits::ray_origin));
}
dvec3 in_range(const Vec3& v, const char* what) {
    for (const double x : {v.x, v.y, v.z}) in_range(x, -Limits::ray_origin, what);
    return to_glm(v);
}

// Sines and cosines of whole right angles are exact, so that axis-parallel views look along the axes exactly.
void sine_cosine(double degrees, double& sine, double& cosine) {
    const double turn = std::remainder(degrees, 360.0);
    const double radians = turn * std::numbers::pi / 180.0;
    sine = std::sin(radians);
    cosine = std::cos(radians);
    if (std::remainder(turn, 90.0) == 0) {
        sine = std::round(sine);
        cosine = std::round(cosine);
    }
}

void fill_scene(const CompiledScene& scene, double tolerance, kernel::Frame& frame) {
    put(to_glm(scene.center), frame.center);
    frame.radius = scene.radius;
    frame.tolerance = tolerance < 0 ? scene.tolerance : tolerance;
    frame.ambient = scene.ambient;
    frame.solid_count = static_cast<std::uint32_t>(scene.solids.size());
    frame.unbounded_count = scene.unbounded_count;
    frame.node_count = static_cast<std::uint32_t>(scene.nodes.size());
    frame.every_partition = 1;
    std::copy(std::begin(scene.rank_ends), std::end(scene.rank_ends), std::begin(frame.rank_ends));
}

}  // namespace

Box framing_box(const CompiledScene& scene) {
    dvec3 low = to_glm(scene.bounds.low), high = to_glm(scene.bounds.high);
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return {{-1, -1, -1}, {1, 1, 1}};
    if (glm::distance(low, high) >= 1) {
        low = glm::floor(low);
        high = glm::ceil(high);
    }
    return {from_glm(low), from_glm(high)};
}

PreparedFrame prepare_frame(const CompiledScene& scene, const View& view, double tolerance) {
    const Camera& camera = view.camera;
    if (view.width < 1 || view.height < 1 || view.width > 32768 || view.height > 32768)
        refuse("the size of a picture must be 1 to 32768 pixels each way");
    if (!(camera.perspective >= 0 && camera.perspective < 180))
        refuse("perspective must be 0 or an angle below 180 degrees");

    PreparedFrame result;
    const Box box = framing_box(scene);
    const dvec3 low = to_glm(box.low), high = to_glm(box.high);
    const dvec3 center = camera.center ? in_range(*camera.center, "the centre of the view") : 0.5 * (low + high);
    if (camera.view_size && !(*camera.view_size > 0)) refuse("the size of the view must be positive");
    result.view_size = camera.view_size ? in_range(*camera.view_size, Limits::least_length, "the size of the view")
                                        : glm::distance(low, high);

    double sin_a, cos_a, sin_e, cos_e;
    sine_cosine(finite(camera.azimuth, "azimuth"), sin_a, cos_a);
    sine_cosine(finite(camera.elevation, "elevation"), sin_e, cos_e);
    const dvec3 back(cos_e * cos_a, cos_e * sin_a, sin_e), right(-sin_a, cos_a, 0),
        up(-sin_e * cos_a, -sin_e * sin_a, cos_e);

    // Orthographic, BRL-CAD's eye stands back sqrt(2) times half the view's size; in perspective where the picture
    // plane through the centre just fills the angle of view.
    const double half = 0.5 * result.view_size;
    result.eye_to_center = camera.perspective > 0 ? half / std::tan(camera.perspective * std::numbers::pi / 360.0)
                                                  : std::numbers::sqrt2 * half;
    const dvec3 eye = center + in_range(result.eye_to_center, 0, "the distance of the eye") * back;
    const double pixel = result.view_size / view.height;

    kernel::Frame& frame = result.frame;
    fill_scene(scene, tolerance, frame);
    put(eye, frame.eye);
    put(pixel * right, frame.u);
    put(pixel * up, frame.v);
    put(camera.perspective > 0 ? center - eye : -back, frame.w);
    frame.t_min = 0;
    for (int i = 0; i < 3; ++i) frame.background[i] = static_cast<float>(scene.background[static_cast<std::size_t>(i)]);
    frame.width = static_cast<std::uint32_t>(view.width);
    frame.height = static_cast<std::uint32_t>(view.height);
    frame.perspective = camera.perspective > 0;
    frame.every_partition = view.every_partition;
    frame.channels = view.channels & (view.every_partition ? channel::all : channel::all & ~channel::counts);

    result.lights = scene.lights;
    if (result.lights.empty()) {
        // BRL-CAD's own light: half a view back from the eye and half a view to its left. Fitted to its pictures of
        // spheres.
        const dvec3 at = eye + half * (back - right);
        result.lights.push_back({at.x, at.y, at.z, 1, 1, 1});
    }
    frame.light_count = static_cast<std::uint32_t>(result.lights.size());

    frame.window = window_of(scene, frame);
    result.rays = std::uint64_t{kernel::blocks_across(frame.window)} * kernel::blocks_down(frame.window) * BLOCK * BLOCK;
    result.right = from_glm(right);
    result.up = from_glm(up);
    result.back = from_glm(back);
    result.center = from_glm(center);
    return result;
}

PreparedFrame prepare_rays(const CompiledScene& scene, std::uint32_t count, double tolerance) {
    PreparedFrame result;
    fill_scene(scene, tolerance, result.frame);
    result.frame.listed = 1;
    result.frame.t_min = -std::numeric_limits<double>::infinity();
    result.frame.width = count;
    result.frame.height = 1;
    result.rays = count;
    return result;
}

}  // namespace csgrt
