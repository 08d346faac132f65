#include "compile/lights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

constexpr double everywhere = 180;  // degrees from the beam's axis

/// Intensities of 0 and less mean 1, as in BRL-CAD.
double intensity_of(const Emission& light) { return light.intensity > 0 ? light.intensity : 1; }

}  // namespace

kernel::LightRecord light_record(const Light& light) {
    kernel::LightRecord record = light_at(light.position, light.intensity * light.color);
    if (light.infinite) {
        const Vec3 to_light = length(light.position) > 0 ? unit(light.position) : Vec3{0, 0, 1};
        record.x = to_light.x;
        record.y = to_light.y;
        record.z = to_light.z;
        record.w = 0;
    }
    if (light.angle < everywhere) {
        const Vec3 axis = unit(light.direction);
        record.bx = axis.x;
        record.by = axis.y;
        record.bz = axis.z;
        record.cosine = std::cos(light.angle * std::numbers::pi / 180);
        record.beam = 1;
    }
    return record;
}

void add_region_lights(FlatScene& flat, const std::vector<Box>& boxes, CompiledScene& compiled) {
    double brightest = 0;
    for (const FlatRegion& region : flat.regions) {
        const auto& light = region.info.finish.light;
        if (light && !(light->fraction > 0)) brightest = std::max(brightest, intensity_of(*light));
    }
    // BRL-CAD's: the brightest light and half of the ambient light together make white.
    const double full = brightest * (1 + 0.5 * compiled.ambient);
    for (FlatRegion& region : flat.regions) {
        const auto& light = region.info.finish.light;
        if (!light) continue;
        region.brightness = light->fraction > 0 ? light->fraction : intensity_of(*light) / full;
        const Box box = tree_box(region.tree, boxes);
        if (is_empty(box) || !is_finite(box)) {
            Warning& warning = compiled.warnings.emplace_back();
            warning.object = region.info.path;
            warning.reason = "it gives no light: it has no end";
            warning.appearance = true;
            continue;
        }
        Light found;
        found.position = 0.5 * (box.low + box.high);
        found.color = compiled.shaded(region.info.color);
        found.intensity = region.brightness;
        found.infinite = light->infinite;
        found.angle = light->angle;
        Vec3 axis{0, 0, -1};
        if (light->direction) axis = *light->direction;
        if (light->target) axis = *light->target - found.position;
        // The first solid's, as in BRL-CAD, whatever was given.
        found.direction =
            narrow(transform_direction(*flat.instances[region.tree.nodes.front().solid].matrix, wide(axis)));
        compiled.lights.push_back(light_record(found));
    }
}

}  // namespace csgrt
