#include "compile/frame.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <glm/glm.hpp>

#include "compile/appearance.hpp"
#include "compile/screen_bounds.hpp"
#include "compile/solids/planes.hpp"
#include "form/camera.hpp"
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

/// The model in BRL-CAD's default view: the middle of its box, and half the box's diagonal.
struct Surroundings {
    dvec3 low, high, center;
    double half;
};
Surroundings surroundings_of(const CompiledScene& scene) {
    const Box box = framing_box(scene);
    const dvec3 low = to_glm(box.low), high = to_glm(box.high);
    return {low, high, 0.5 * (low + high), 0.5 * glm::distance(low, high)};
}

/// The distance of BRL-CAD's eye, in halves of the view.
constexpr double standoff = std::numbers::sqrt2;

dvec3 center_of(const Camera& camera, const Surroundings& model) {
    if (camera.look_at) return in_range(*camera.look_at, "the point that the view looks at");
    return camera.center ? in_range(*camera.center, "the centre of the view") : model.center;
}

/// The view's axes: unit vectors, perpendicular to each other. `back` points to the eye; `distance` is the eye's
/// distance.
struct Axes {
    dvec3 right, up, back;
    double distance = 0;
};

/// The direction of v, and its length in `length`; without overflow for any length but 0.
dvec3 direction_of(dvec3 v, double& length) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    length = 0;
    if (!(largest > 0)) return v;
    v /= largest;
    const double rest = glm::length(v);
    length = largest * rest;
    return v / rest;
}

Axes axes_of(const Camera& camera, dvec3 center) {
    Axes axes;
    if (camera.eye) {
        axes.back = direction_of(in_range(*camera.eye, "the place of the eye") - center, axes.distance);
        if (!(axes.distance > 0)) refuse("the eye stands at the point that it looks at");
        // The right axis is level; if the view looks along z, it is the right axis of azimuth 0.
        double level = 0;
        axes.right = direction_of({-axes.back.y, axes.back.x, 0}, level);
        if (!(level > 0)) axes.right = {0, 1, 0};
        axes.up = glm::cross(axes.back, axes.right);
    } else {
        double sin_a, cos_a, sin_e, cos_e;
        sine_cosine(finite(camera.azimuth, "azimuth"), sin_a, cos_a);
        sine_cosine(finite(camera.elevation, "elevation"), sin_e, cos_e);
        axes = {{-sin_a, cos_a, 0}, {-sin_e * cos_a, -sin_e * sin_a, cos_e}, {cos_e * cos_a, cos_e * sin_a, sin_e}};
    }
    if (camera.up) {
        constexpr double least_sine = 1e-9;  // below this sine rounding would decide the right axis
        double length = 0, sine = 0;
        for (const double x : {camera.up->x, camera.up->y, camera.up->z}) finite(x, "the direction upward");
        const dvec3 up = direction_of(to_glm(*camera.up), length);
        if (!(length > 0)) refuse("the direction upward has no length");
        axes.right = direction_of(glm::cross(up, axes.back), sine);
        if (!(sine > least_sine)) refuse("the direction upward runs along the line of sight");
        axes.up = glm::cross(axes.back, axes.right);
    }
    return axes;
}

/// The distance from an orthographic view's centre to its rays' origins: BRL-CAD's eye, or, if it is farther, a point
/// before the whole model.
double plane_to_center(const CompiledScene& scene, const Surroundings& model, dvec3 center, dvec3 back, double half) {
    const double eye = standoff * half;
    double model_end = 0;
    for (int i = 0; i < 3; ++i)
        model_end += std::max(back[i] * (model.low[i] - center[i]), back[i] * (model.high[i] - center[i]));
    if (model_end <= eye) return eye;
    constexpr double rounding = 0x1p-40;
    const double to_scene = glm::dot(to_glm(scene.center) - center, back);
    const double scene_end = to_scene + scene.radius + rounding * (scene.radius + std::abs(to_scene));
    return std::max({eye, model_end, scene_end});
}

/// BRL-CAD's own light, for a scene without lights. The light is half a view behind the eye and half a view to the
/// eye's left, in the orthographic view of the whole model. It does not move when a view shows a part. The position is
/// fitted to BRL-CAD's pictures of spheres.
dvec3 light_of_model(const Surroundings& model, const Axes& axes) {
    const dvec3 eye = model.center + standoff * model.half * axes.back;
    return eye + model.half * (axes.back - axes.right);
}

/// The light for a view with a perspective. If the eye is near, the light is beside the eye. The farther away the eye
/// is, the nearer is this light to the light of the orthographic view, to which a perspective of nearly 0 converges.
dvec3 light_by_eye(const Surroundings& model, const Axes& axes, dvec3 eye, double half) {
    const double near = standoff * model.half, distance = glm::dot(eye - model.center, axes.back);
    const dvec3 at = eye + half * (axes.back - axes.right);
    if (distance <= near) return at;
    return glm::mix(light_of_model(model, axes), at - (distance - near) * axes.back, near / distance);
}

/// A studio's light: the key from above the eye's left shoulder, a fill from the right, and ambient light, which
/// surfaces that face the eye have most of. The lights are far away, so that each face of a solid has one shade.
void add_studio(const Surroundings& model, const Axes& axes, dvec3 center, PreparedFrame& frame) {
    const double far = 20 * model.half;
    const dvec3 key = 0.55 * axes.up - 0.45 * axes.right + 0.7 * axes.back,
                fill = 0.1 * axes.up + 0.8 * axes.right + 0.6 * axes.back;
    frame.lights = {light_at(from_glm(center + far * key), {0.9, 0.9, 0.9}),
                    light_at(from_glm(center + far * fill), {0.25, 0.25, 0.25})};
    frame.frame.ambient = std::max(frame.frame.ambient, 0.6);
}

void put_clip(const CompiledScene& scene, const std::vector<Plane>& planes, kernel::Frame& frame) {
    if (planes.size() > MOST_CLIPS) refuse("a view has at most " + std::to_string(MOST_CLIPS) + " planes");
    frame.clip_count = static_cast<std::uint32_t>(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
        double size = 0;
        const dvec3 normal = direction_of(in_range(planes[i].normal, "the normal of a plane of the view"), size);
        if (!(size > 0)) refuse("the normal of a plane of the view has no length");
        const double distance = in_range(planes[i].distance, -Limits::ray_origin, "the distance of a plane");
        frame.clip[i] = shared_plane(scene, {from_glm(normal), distance});
    }
}

}  // namespace

void put_scene(const CompiledScene& scene, double tolerance, kernel::Frame& frame) {
    put(to_glm(scene.center), frame.center);
    frame.radius = scene.radius;
    frame.tolerance = tolerance < 0 ? scene.tolerance : tolerance;
    frame.ambient = scene.ambient;
    frame.unbounded_count = scene.unbounded_count;
    frame.node_count = static_cast<std::uint32_t>(scene.nodes.size());
    frame.every_partition = 1;
    frame.whole_lines = (scene.solid_types >> SOLID_PLATE & 1u) != 0;
    std::copy(std::begin(scene.rank_ends), std::end(scene.rank_ends), std::begin(frame.rank_ends));
    frame.candidate_capacity = frame.segment_capacity = frame.word_capacity = COUNT_MAX;
}

Box framing_box(const CompiledScene& scene) {
    dvec3 low = to_glm(scene.bounds.low), high = to_glm(scene.bounds.high);
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return {{-1, -1, -1}, {1, 1, 1}};
    if (glm::distance(low, high) >= 1) {
        low = glm::floor(low);
        high = glm::ceil(high);
    }
    return {from_glm(low), from_glm(high)};
}

PreparedFrame prepare_frame(const CompiledScene& scene, const View& view, double tolerance, const Sampling& sampling) {
    const Camera& camera = view.camera;
    if (view.width < 1 || view.height < 1 || view.width > 32768 || view.height > 32768)
        refuse("the size of a picture must be 1 to 32768 pixels each way");
    if (!(camera.perspective >= 0 && camera.perspective < 180))
        refuse("perspective must be 0 or an angle below 180 degrees");
    if (view.samples < 1 || view.samples > 256) refuse("a pixel has 1 to 256 samples");
    if ((view.channels & ~(channel::all | channel::display | channel::ghosts)) != 0)
        refuse("the channels " + std::to_string(view.channels) + " have bits that no channel has");
    if (const CameraConflict* conflict = conflict_of(camera)) refuse(text_of(*conflict));
    const PixelRectangle part = view.part ? *view.part : PixelRectangle{0, 0, view.width, view.height};
    if (part.left < 0 || part.top < 0 || part.width < 1 || part.height < 1 || part.left > view.width - part.width ||
        part.top > view.height - part.height)
        refuse("the part of a picture must lie in it");

    PreparedFrame result;
    result.aspect = static_cast<double>(view.width) / view.height;
    const Surroundings model = surroundings_of(scene);
    const dvec3 center = center_of(camera, model);
    const Axes axes = axes_of(camera, center);
    const bool perspective = camera.perspective > 0;
    const double slope = std::tan(camera.perspective * std::numbers::pi / 360.0);
    if (camera.eye && perspective) {
        result.eye_to_center = in_range(axes.distance, Limits::least_length, "the distance of the eye");
        result.view_size = in_range(2 * slope * axes.distance, Limits::least_length, "the size of the view");
    } else {
        if (camera.view_size && !(*camera.view_size > 0)) refuse("the size of the view must be positive");
        result.view_size = camera.view_size ? in_range(*camera.view_size, Limits::least_length, "the size of the view")
                                            : 2 * model.half;
        const double half = 0.5 * result.view_size;
        result.eye_to_center =
            in_range(perspective ? half / slope : plane_to_center(scene, model, center, axes.back, half), 0,
                     "the distance of the eye");
    }
    const dvec3 eye = camera.eye && perspective ? to_glm(*camera.eye) : center + result.eye_to_center * axes.back;
    const double pixel = result.view_size / view.height;

    kernel::Frame& frame = result.frame;
    put_scene(scene, tolerance, frame);
    put(eye, frame.eye);
    // The steps are all exact. So each ray is equal to the ray of the whole view, to the last bit, unless it is moved
    // by a fraction of a pixel.
    const double step = sampling.step;
    put(step * (pixel * axes.right), frame.u);
    put(step * (pixel * axes.up), frame.v);
    frame.first_x = (0.5 - 0.5 * view.width + part.left + sampling.column + sampling.right) / step;
    frame.first_y = (0.5 * view.height - 0.5 - part.top - sampling.line - sampling.down) / step;
    put_clip(scene, view.clip, frame);
    put(perspective ? center - eye : -axes.back, frame.w);
    frame.t_min = 0;
    if (!view.transparent) {
        std::transform(scene.background.begin(), scene.background.end(), frame.background,
                       [](double x) { return static_cast<float>(x); });
        frame.background[3] = 1;
    }
    frame.width = static_cast<std::uint32_t>((part.width - sampling.column + sampling.step - 1) / sampling.step);
    frame.height = static_cast<std::uint32_t>((part.height - sampling.line + sampling.step - 1) / sampling.step);
    frame.perspective = perspective;
    // First hits are searched in the order of the solids' boxes, but a plate that a ray grazes begins far before its
    // box.
    frame.every_partition = view.every_partition || frame.whole_lines;
    if (!frame.every_partition) frame.starting_node = scene.starting_node;
    const std::uint32_t counts = view.every_partition ? channel::counts : 0;
    frame.channels = view.channels & ((channel::all & ~channel::counts) | counts | channel::display);

    if (view.light == Lighting::model) result.lights = scene.lights;
    if (view.light == Lighting::studio) {
        add_studio(model, axes, center, result);
    } else if (result.lights.empty()) {
        const dvec3 at =
            perspective ? light_by_eye(model, axes, eye, 0.5 * result.view_size) : light_of_model(model, axes);
        result.lights.push_back(light_at(from_glm(at), {1, 1, 1}));
    }
    frame.light_count = static_cast<std::uint32_t>(result.lights.size());

    frame.screen = screen_bounds(scene, frame);
    result.rays = std::uint64_t{kernel::tiles_across(frame.screen)} * kernel::tiles_down(frame.screen) * TILE * TILE;
    result.right = from_glm(axes.right);
    result.up = from_glm(axes.up);
    result.back = from_glm(axes.back);
    result.center = from_glm(center);
    return result;
}

}  // namespace csgrt
