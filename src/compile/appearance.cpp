#include "compile/appearance.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "base/display_bytes.hpp"
#include "base/parallel.hpp"
#include "compile/hash.hpp"
#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

constexpr double everywhere = 180;  // degrees from the beam's axis

/// The intensity of a light. As in BRL-CAD, 0 and less mean 1.
double intensity_of(const Emission& light) { return light.intensity > 0 ? light.intensity : 1; }

/// The record of a light. The light's colour is decoded for shading already.
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

kernel::MaterialRecord material_of(const RegionInfo& info, double brightness, const Appearance& appearance) {
    const Finish& f = info.finish;
    const Vec3 color = appearance.shaded(info.color);
    const double ambient = appearance.ambient;
    const auto to_float = [](double x) { return static_cast<float>(x); };
    kernel::MaterialRecord m{to_float(color.x),
                             to_float(color.y),
                             to_float(color.z),
                             to_float(f.specular),
                             to_float(f.diffuse),
                             to_float(f.ambient),
                             static_cast<std::uint32_t>(std::max(f.shine, 0)),
                             0};
    if (!f.light) return m;
    // A body that glows shows half of its colour in any light. The other half depends on how much the surface faces the
    // eye, so that the body looks round.
    m.specular = m.diffuse = 0;
    m.ambient = ambient > 0 ? to_float(0.5 * brightness / ambient) : 0;
    m.glow = to_float((ambient > 0 ? 0.5 : 1) * brightness);
    return m;
}

void set_material(Appearance& appearance, std::size_t region, const kernel::MaterialRecord& material) {
    const kernel::MaterialRecord& before = appearance.materials[region];
    if (std::memcmp(&material, &before, sizeof material) == 0) return;
    appearance.materials_hash += hash_of_material(region, material) - hash_of_material(region, before);
    appearance.materials.own(region) = material;
}

/// Adds the lights of the regions that emit light, by BRL-CAD's rules, and sets the materials of these regions.
void add_region_lights(const SharedList<RegionInfo>& regions, std::span<const RegionLight> shining,
                       Appearance& appearance, std::vector<Warning>& warnings) {
    double brightest = 0;
    for (const RegionLight& of : shining) {
        const Emission& light = *regions[of.region].finish.light;
        if (!(light.fraction > 0)) brightest = std::max(brightest, intensity_of(light));
    }
    // The scale is BRL-CAD's: the brightest light and half of the ambient light together make white.
    const double full = brightest * (1 + 0.5 * appearance.ambient);
    for (const RegionLight& of : shining) {
        const RegionInfo& region = regions[of.region];
        const Emission& light = *region.finish.light;
        const double bright = light.fraction > 0 ? light.fraction : intensity_of(light) / full;
        set_material(appearance, of.region, material_of(region, bright, appearance));
        if (is_empty(region.bounds) || !is_finite(region.bounds)) {
            Warning& warning = warnings.emplace_back();
            warning.object = region.path;
            warning.reason = "it gives no light: it has no end";
            warning.appearance = true;
            continue;
        }
        Light found;
        found.position = 0.5 * (region.bounds.low + region.bounds.high);
        found.color = appearance.shaded(region.color);
        found.intensity = bright;
        found.infinite = light.infinite;
        found.angle = light.angle;
        Vec3 axis{0, 0, -1};
        if (light.direction) axis = *light.direction;
        if (light.target) axis = *light.target - found.position;
        // The matrix of the first solid turns the beam, as in BRL-CAD, whatever direction was given.
        found.direction = narrow(transform_direction(of.matrix, wide(axis)));
        appearance.lights.push_back(light_record(found));
    }
}

SharedVector<kernel::DisplayBytes> display_bytes(bool are_display_values) {
    kernel::DisplayBytes table{};
    for (int byte = 0; byte < 255; ++byte) table.ends[byte] = display_end(byte, are_display_values);
    table.ends[255] = std::numeric_limits<float>::infinity();
    for (std::uint32_t part = 0; part < DISPLAY_PARTS; ++part)
        table.first[part / 4] |=
            std::uint32_t{display_byte(static_cast<double>(part) / DISPLAY_PARTS, are_display_values)} << part % 4 * 8;
    return {table};
}

/// The appearance without materials and regions' lights.
Appearance common_appearance(const SceneAppearance& scene, bool display_shading) {
    Appearance appearance;
    appearance.display_shading = display_shading;
    // The tables are never destroyed: a thread may compile while the process ends.
    static const auto* const tables =
        new std::array<SharedVector<kernel::DisplayBytes>, 2>{display_bytes(false), display_bytes(true)};
    appearance.display = (*tables)[display_shading];
    appearance.ambient = scene.ambient;
    const Vec3 background = appearance.shaded(scene.background);
    appearance.background = {background.x, background.y, background.z};
    for (Light light : scene.lights) {
        light.color = appearance.shaded(light.color);
        appearance.lights.push_back(light_record(light));
    }
    return appearance;
}

}  // namespace

Appearance appearance_of(const SceneAppearance& scene, const SharedList<RegionInfo>& regions,
                         std::span<const RegionLight> shining, bool display_shading, std::vector<Warning>& warnings) {
    Appearance appearance = common_appearance(scene, display_shading);
    using Materials = SharedList<kernel::MaterialRecord>;
    Materials& materials = appearance.materials = Materials(regions.size());
    constexpr std::size_t many = 4096;
    static_assert(many % Materials::chunk_size == 0);  // threads make different chunks of the list
    std::atomic<std::uint64_t> hash = 0;
    for_chunks(regions.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        std::uint64_t own = 0;
        for (std::size_t i = first; i < last; ++i)
            own += hash_of_material(i, materials.own(i) = material_of(regions[i], 0, appearance));
        hash += own;
    });
    appearance.materials_hash = hash;
    add_region_lights(regions, shining, appearance, warnings);
    return appearance;
}

Appearance appearance_of(const SceneAppearance& scene, const SharedList<RegionInfo>& regions,
                         std::span<const RegionLight> shining, const Appearance& before,
                         std::span<const std::uint32_t> changed) {
    Appearance appearance = common_appearance(scene, before.display_shading);
    appearance.materials = before.materials;
    appearance.materials_hash = before.materials_hash;
    for (const std::uint32_t i : changed) set_material(appearance, i, material_of(regions[i], 0, appearance));
    std::vector<Warning> known;
    add_region_lights(regions, shining, appearance, known);
    return appearance;
}

}  // namespace csgrt
