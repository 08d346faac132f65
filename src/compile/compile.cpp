// Compile: compiles a scene in steps: validate; flatten and measure, until all solids are within the limits; clip by
// half-spaces; number the solids; pack regions, appearance and shapes.

#include "compile/regions/status_tree.hpp"
#include "compile/compiled_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "compile/bvh/space.hpp"
#include "compile/bounds/extent.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/half_spaces.hpp"
#include "compile/hash.hpp"
#include "compile/appearance.hpp"
#include "compile/linear.hpp"
#include "compile/bounds/instance_bounds.hpp"
#include "compile/regions/pack.hpp"
#include "compile/solids/pack.hpp"
#include "scene/excerpt.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/faults/validate.hpp"

namespace csgrt {

namespace {

/// The box in which planes of unbounded solids are compared: around all bounded solids or, if there are none, around
/// the planes' points that are nearest to the origin.
Box common_box(const Scene& scene, const FlatScene& flat, const Space& space) {
    double reach = space.radius;
    if (reach == 0) {
        reach = 1;
        for (const Instance& instance : flat.instances)
            if (const auto* half = std::get_if<Half>(&shape_of(scene, flat, instance)))
                reach = std::max(reach, 2 * std::fabs(transform_plane(*instance.matrix, half->plane).distance));
    }
    const Vec3& c = space.center;
    return {{c.x - reach, c.y - reach, c.z - reach}, {c.x + reach, c.y + reach, c.z + reach}};
}

/// Leaves out solids beyond the limits of size and distance. Returns true if there are such solids: then the trees
/// change. Throws Error (scene) if the scene is strict.
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

/// Joins equal warnings about one object into the first of them.
void join_equal(std::vector<Warning>& warnings) {
    std::map<std::pair<std::string_view, std::string_view>, Warning*> known;
    std::vector<Warning> joined;
    joined.reserve(warnings.size());  // `known` refers to the elements
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
    std::vector<Warning> warnings = scene.warnings;
    Validated validated = validate(scene, names, objects, options.skip_unsupported, warnings, options.max_instances);
    if (!validated.findings.empty()) throw Error(Status::scene, std::move(validated.findings));
    if (roots.empty()) roots = names.top_objects();  // now cycles are cut; before, all objects may have been in cycles

    const auto flattened = [&] {
        return flatten(scene, names, validated.instances, roots, options.air, options.max_instances);
    };
    FlatScene flat = flattened();
    std::optional<Measured> measured(std::in_place, scene, flat);
    while (leave_out_extremes(scene, flat, *measured, names, warnings)) {
        flat = flattened();
        measured.emplace(scene, flat);
    }
    warnings.insert(warnings.end(), flat.warnings.begin(), flat.warnings.end());
    if (flat.regions.empty()) throw Error(Status::scene, nothing_to_render(warnings));

    const Clipped clipped = clip_by_half_spaces(scene, flat, measured->boxes);
    auto [space, order] = space_of(measured->boxes, clipped.ray_boxes.empty() ? measured->boxes : clipped.ray_boxes);
    auto [logic, terms] = pack_regions(flat, clipped.trees, order, measured->brlcad_boxes);
    space.starting_node = starting_node(space.nodes, terms);
    Appearance appearance = appearance_of({scene.lights, scene.ambient, scene.background}, logic.region_info,
                                          logic.region_lights, options.display_shading, warnings);
    Shapes shapes =
        pack_solids(scene, flat, *measured, clipped, order, space, common_box(scene, flat, space), terms, warnings);
    join_equal(warnings);
    CompiledScene compiled{std::move(space),
                           std::move(logic),
                           std::move(shapes),
                           std::move(appearance),
                           std::make_shared<LateStatusTree>(),
                           0,
                           0,
                           std::move(warnings)};
    compiled.geometry_hash = hash_of_geometry(compiled);
    compiled.hash = hash_of(compiled);
    return compiled;
}

}  // namespace csgrt
