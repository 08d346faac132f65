// The order of it all: flatten, box, number, pack, linearize.

#include "compile/compiled_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "compile/bounds.hpp"
#include "compile/bvh.hpp"
#include "compile/flatten.hpp"
#include "compile/hash.hpp"
#include "compile/linear.hpp"
#include "compile/linearize.hpp"
#include "compile/pack_solids.hpp"
#include "compile/polyhedron.hpp"
#include "compile/terms.hpp"
#include "parallel.hpp"
#include "scene/validate.hpp"

namespace csgrt {

namespace {

/// The sphere around all bounded solids, from the box around their boxes.
void set_sphere(const std::vector<Box>& boxes, CompiledScene& compiled) {
    Box all = empty_box;
    for (const Box& box : boxes)
        if (is_finite(box)) all = united(all, box);
    if (is_empty(all)) return;
    compiled.center = narrow(0.5L * (wide(all.low) + wide(all.high)));
    compiled.radius = 0.5 * diagonal(all);
}

/// Numbers the instances: the unbounded ones first, then in the order of the hierarchy's leaves. Returns old numbers in
/// the new order.
std::vector<std::uint32_t> number_solids(const std::vector<Box>& boxes, CompiledScene& compiled) {
    std::vector<std::uint32_t> order, bounded;
    std::vector<Box> bounded_boxes;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (is_finite(boxes[i])) {
            bounded.push_back(i);
            bounded_boxes.push_back(boxes[i]);
        } else {
            order.push_back(i);
        }
    }
    compiled.unbounded_count = static_cast<std::uint32_t>(order.size());
    Hierarchy hierarchy = build_bvh(bounded_boxes, compiled.center, compiled.radius, compiled.unbounded_count);
    compiled.nodes = std::move(hierarchy.nodes);
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
                reach = std::max(reach, 2 * std::fabs(transform_plane(instance.matrix, half->plane).distance));
    }
    const Vec3& c = compiled.center;
    return {{c.x - reach, c.y - reach, c.z - reach}, {c.x + reach, c.y + reach, c.z + reach}};
}

void set_regions(FlatScene& flat, const std::vector<Box>& brlcad_boxes, CompiledScene& compiled) {
    using Key = std::tuple<float, float, float, float, float, float, std::uint32_t>;
    std::map<Key, std::uint32_t> known;
    compiled.bounds = empty_box;
    for (FlatRegion& region : flat.regions) {
        const LinearTree tree = linearize(region.tree, compiled.trees);
        if (!tree.union_only) compiled.operators |= tree.operators;

        const Finish& f = region.info.finish;
        const Vec3& color = region.info.color;
        const auto to_float = [](double x) { return static_cast<float>(x); };
        const kernel::MaterialRecord m{to_float(color.x),
                                       to_float(color.y),
                                       to_float(color.z),
                                       to_float(f.specular),
                                       to_float(f.diffuse),
                                       to_float(f.ambient),
                                       static_cast<std::uint32_t>(std::max(f.shine, 0))};
        const auto next = static_cast<std::uint32_t>(compiled.materials.size());
        const auto [material, added] =
            known.emplace(Key{m.r, m.g, m.b, m.specular, m.diffuse, m.ambient, m.shine}, next);
        if (added) compiled.materials.push_back(m);

        compiled.regions.push_back(
            {tree.first_word, tree.word_count, tree.union_only ? REGION_UNION_ONLY : 0u, material->second});
        region.info.bounds = tree_box(region.tree, brlcad_boxes);
        if (is_finite(region.info.bounds) && !is_empty(region.info.bounds))
            compiled.bounds = united(compiled.bounds, region.info.bounds);
        compiled.region_info.push_back(std::move(region.info));
        compiled.flat_trees.push_back(std::move(region.tree));
    }
}

void set_surroundings(const Scene& scene, CompiledScene& compiled) {
    for (const Light& light : scene.lights) {
        const auto shade = [&](double c) { return static_cast<float>(c * light.intensity); };
        compiled.lights.push_back({light.position.x, light.position.y, light.position.z, shade(light.color.x),
                                   shade(light.color.y), shade(light.color.z)});
    }
    compiled.background = {scene.background.x, scene.background.y, scene.background.z};
    compiled.ambient = scene.ambient;
    compiled.tolerance = scene.tolerance;
}

}  // namespace

CompiledScene compile(const Scene& scene, const std::vector<std::string>& objects, const CompileOptions& options) {
    const Names names(scene);
    if (std::vector<Diagnostic> findings = validate(scene, names, objects, options.skip_unsupported); !findings.empty())
        throw Error(Status::scene, std::move(findings));

    FlatScene flat =
        flatten(scene, names, objects.empty() ? names.top_objects() : objects, options.air, options.skip_unsupported);
    CompiledScene compiled;
    compiled.notes = std::move(flat.notes);
    compiled.skipped = std::move(flat.skipped);
    if (flat.regions.empty()) {
        std::string message = "there is nothing to render";
        for (const std::string& note : compiled.notes) message += "\n" + note;
        for (const std::string& solid : compiled.skipped) message += "\nleft out: " + solid;
        throw Error(Status::scene, message);
    }

    set_surroundings(scene, compiled);
    std::vector<Box> boxes, brlcad_boxes;
    boxes.resize(flat.instances.size());
    const auto for_instances = [&](const auto& call) {
        constexpr std::size_t chunk = 1024;
        for_chunks(flat.instances.size(), chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i) call(i);
        });
    };
    for_instances([&](std::size_t i) {
        const Instance& instance = flat.instances[i];
        boxes[i] = solid_box(shape_of(scene, flat, instance), instance.matrix, cuts_of(flat, instance));
    });
    set_sphere(boxes, compiled);
    const std::vector<std::uint32_t> order = number_solids(boxes, compiled);
    pack_solids(scene, flat, order, boxes, common_box(scene, flat, compiled), compiled);

    std::vector<std::uint32_t> number(order.size());
    brlcad_boxes.resize(order.size());
    for_instances([&](std::size_t i) {
        number[order[i]] = static_cast<std::uint32_t>(i);
        const Instance& instance = flat.instances[order[i]];
        brlcad_boxes[i] = brlcad_box(shape_of(scene, flat, instance), instance.matrix, cuts_of(flat, instance));
    });
    std::uint64_t leaves = 0;
    for (FlatRegion& region : flat.regions) {
        for (FlatTree::Node& node : region.tree.nodes) {
            if (node.op != Operator::leaf) continue;
            node.solid = number[node.solid];
            ++leaves;
        }
    }
    compiled.instances = static_cast<std::uint32_t>(leaves);

    set_regions(flat, brlcad_boxes, compiled);
    list_terms(compiled);
    compiled.hash = hash_of(compiled);
    return compiled;
}

}  // namespace csgrt
