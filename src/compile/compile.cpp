// The steps: validate, flatten, measure boxes, number, pack solids, pack regions, list terms.

#include "compile/compiled_scene.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "compile/bvh/build.hpp"
#include "compile/bounds/extent.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/hash.hpp"
#include "compile/lights.hpp"
#include "compile/linear.hpp"
#include "compile/bounds/instance_bounds.hpp"
#include "compile/regions/pack.hpp"
#include "compile/solids/pack.hpp"
#include "compile/solids/polyhedron.hpp"
#include "compile/regions/terms.hpp"
#include "base/parallel.hpp"
#include "scene/excerpt.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/faults/validate.hpp"

namespace csgrt {

namespace {

/// The sphere around all bounded solids, from the box around their boxes. Returns how many solids are not bounded.
std::size_t set_sphere(const std::vector<Box>& boxes, CompiledScene& compiled) {
    struct Part {
        Box box = empty_box;
        std::size_t unbounded = 0;
    };
    constexpr std::size_t many = 16'384;
    std::vector<Part> parts((boxes.size() + many - 1) / many);
    for_chunks(boxes.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        Part part;
        for (std::size_t i = first; i < last; ++i) {
            if (is_finite(boxes[i])) {
                part.box = united(part.box, boxes[i]);
            } else {
                ++part.unbounded;
            }
        }
        parts[number] = part;
    });
    Part all;
    for (const Part& part : parts) all = {united(all.box, part.box), all.unbounded + part.unbounded};
    if (!is_empty(all.box)) {
        compiled.center = narrow(0.5L * (wide(all.box.low) + wide(all.box.high)));
        compiled.radius = 0.5 * diagonal(all.box);
    }
    return all.unbounded;
}

/// Numbers the instances: the `unbounded` ones first, then in the order of the hierarchy's leaves. Returns old numbers
/// in the new order.
std::vector<std::uint32_t> number_solids(const std::vector<Box>& boxes, std::size_t unbounded,
                                         CompiledScene& compiled) {
    compiled.unbounded_count = static_cast<std::uint32_t>(unbounded);
    std::vector<std::uint32_t> order, bounded;
    if (unbounded > 0)
        for (std::uint32_t i = 0; i < boxes.size(); ++i) (is_finite(boxes[i]) ? bounded : order).push_back(i);
    Hierarchy hierarchy = build_bvh(
        boxes.size() - unbounded, [&](std::size_t i) { return boxes[unbounded > 0 ? bounded[i] : i]; }, compiled.center,
        compiled.radius, compiled.unbounded_count);
    compiled.nodes = std::move(hierarchy.nodes);
    if (unbounded == 0) return std::move(hierarchy.order);
    for (const std::uint32_t i : hierarchy.order) order.push_back(bounded[i]);
    return order;
}

/// Where planes of unbounded solids are compared: around everything bounded, or where there is nothing, around the feet
/// of the planes.
Box common_box(const Scene& scene, const FlatScene& flat, const CompiledScene& compiled) {
    double reach = compiled.radius;
    if (reach == 0) {
        reach = 1;
        for (const Instance& instance : flat.instances)
            if (const auto* half = std::get_if<Half>(&shape_of(scene, flat, instance)))
                reach = std::max(reach, 2 * std::fabs(transform_plane(*instance.matrix, half->plane).distance));
    }
    const Vec3& c = compiled.center;
    return {{c.x - reach, c.y - reach, c.z - reach}, {c.x + reach, c.y + reach, c.z + reach}};
}

void set_surroundings(const Scene& scene, CompiledScene& compiled) {
    for (Light light : scene.lights) {
        light.color = compiled.shaded(light.color);
        compiled.lights.push_back(light_record(light));
    }
    const Vec3 background = compiled.shaded(scene.background);
    compiled.background = {background.x, background.y, background.z};
    compiled.ambient = scene.ambient;
    compiled.tolerance = scene.tolerance;
}

/// Whether solids are left out because of where they stand, so that the trees change. Throws Error (scene) if the scene
/// is strict.
bool leave_out_extremes(const Scene& scene, const FlatScene& flat, const Measured& measured, Names& names,
                        std::vector<Warning>& warnings) {
    const std::vector<ExtentFault> faults = extent_faults(scene, flat, measured);
    if (faults.empty()) return false;
    if (scene.lenient) {
        for (const auto& [object, text] : faults) {
            const bool is_new = names.kind(object) != Names::Kind::left_out;
            names.leave_out(object);
            const Object& solid = scene.objects[object];
            if (is_new) warnings.push_back({name_of(solid), place_of(solid), "left out: it " + text, 1});
        }
        return true;
    }
    FindingList findings;
    for (const auto& [index, text] : faults) {
        const Object& object = scene.objects[index];
        findings.add({place_of(object), "solid '" + name_of(object) + "' " + text, {}, {}});
    }
    for (Diagnostic& diagnostic : findings.shown()) diagnostic.excerpt = excerpt(diagnostic.place);
    throw Error(Status::scene, findings.take());
}

/// Warnings about one object that say the same become one, at the first of them.
void join_equal(std::vector<Warning>& warnings) {
    std::map<std::pair<std::string_view, std::string_view>, Warning*> known;
    std::vector<Warning> joined;
    joined.reserve(warnings.size());  // `known` refers to them
    for (Warning& warning : warnings) {
        if (const auto found = known.find({warning.object, warning.reason}); found != known.end()) {
            found->second->count += warning.count;
        } else {
            Warning& first = joined.emplace_back(std::move(warning));
            known.emplace(std::pair{std::string_view(first.object), std::string_view(first.reason)}, &first);
        }
    }
    warnings = std::move(joined);
}

std::vector<Diagnostic> nothing_to_render(std::vector<Warning>& warnings) {
    join_equal(warnings);
    std::vector<Diagnostic> diagnostics{{{}, "there is nothing to render", {}, {}}};
    for (std::size_t i = 0; i < std::min(warnings.size(), FindingList::most); ++i) {
        Place place = warnings[i].place;
        place.pointer = warnings[i].object;
        diagnostics.push_back({std::move(place), warnings[i].reason, {}, {}});
    }
    if (warnings.size() > FindingList::most)
        diagnostics.push_back(
            {{}, "and " + std::to_string(warnings.size() - FindingList::most) + " more warnings", {}, {}});
    return diagnostics;
}

}  // namespace

CompiledScene compile(const Scene& scene, const std::vector<std::string>& objects, const CompileOptions& options) {
    Names names(scene);
    std::vector<std::string> roots = objects.empty() ? names.top_objects() : objects;
    CompiledScene compiled;
    compiled.warnings = scene.warnings;
    compiled.display_shading = options.display_shading;
    Validated validated =
        validate(scene, names, objects, options.skip_unsupported, compiled.warnings, options.max_instances);
    if (!validated.findings.empty()) throw Error(Status::scene, std::move(validated.findings));
    if (roots.empty()) roots = names.top_objects();  // all were in cycles, which are cut now

    FlatScene flat = flatten(scene, names, validated.instances, roots, options.air, options.max_instances);
    std::optional<Measured> measured(std::in_place, scene, flat);
    while (leave_out_extremes(scene, flat, *measured, names, compiled.warnings)) {
        flat = flatten(scene, names, validated.instances, roots, options.air, options.max_instances);
        measured.emplace(scene, flat);
    }
    std::move(flat.warnings.begin(), flat.warnings.end(), std::back_inserter(compiled.warnings));
    if (flat.regions.empty()) throw Error(Status::scene, nothing_to_render(compiled.warnings));

    set_surroundings(scene, compiled);
    add_region_lights(flat, measured->brlcad_boxes, compiled);
    const std::size_t unbounded = set_sphere(measured->boxes, compiled);
    const std::vector<std::uint32_t> order = number_solids(measured->boxes, unbounded, compiled);
    pack_solids(scene, flat, *measured, order, common_box(scene, flat, compiled), compiled);
    // Read by one thread while another goes through the regions, which it mostly does alone.
    std::future<std::uint64_t> geometry = start_async([&compiled] { return hash_of_geometry(compiled); });
    pack_regions(flat, order, measured->brlcad_boxes, compiled);
    // Giving much memory back takes a while, too.
    const std::future<void> cleared = start_async([&] {
        measured.reset();
        flat = {};
    });
    list_terms(compiled);
    join_equal(compiled.warnings);
    compiled.hash = hash_of(compiled, geometry.get());
    return compiled;
}

}  // namespace csgrt
