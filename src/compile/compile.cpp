// Compile: compiles a scene in steps: validate; flatten and measure, until all solids are within the limits; clip by
// half-spaces; number the solids; pack regions, appearance and shapes. After an edit of members: take out, place and
// measure the changed part; number the solids; pack regions, if numbers have changed; pack shapes.

#include "compile/compilation.hpp"
#include "compile/regions/status_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "base/erase_at.hpp"
#include "base/identical.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/bounds/extent.hpp"
#include "compile/hash.hpp"
#include "compile/appearance.hpp"
#include "compile/linear.hpp"
#include "compile/regions/pack.hpp"
#include "compile/regions/path_table.hpp"
#include "scene/excerpt.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/faults/objects.hpp"

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
bool leave_out_extremes(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured, Names& names,
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

Compilation::Compilation(std::shared_ptr<const Scene> of, const std::vector<std::string>& objects,
                         const CompileOptions& options, std::size_t most_kept)
    : scene_(std::move(of)), names_(*scene_), warnings_(scene_->warnings) {
    const Scene& scene = *scene_;
    roots_ = objects.empty() ? names_.top_objects() : objects;
    validated_ = validate(scene, names_, objects, options.skip_unsupported, warnings_, options.max_instances);
    if (!validated_.findings.empty()) throw Error(Status::scene, std::move(validated_.findings));
    std::vector<std::string> roots = roots_;
    if (roots.empty()) roots = names_.top_objects();  // now cycles are cut; before, all objects may have been in cycles

    const auto flattened = [&] {
        return flatten(scene, names_, validated_.instances, roots, options.air, options.max_instances);
    };
    flat_ = flattened();
    measured_.emplace(scene, flat_);
    while (leave_out_extremes(scene, flat_, *measured_, names_, warnings_)) {
        flat_ = flattened();
        measured_.emplace(scene, flat_);
        is_local_ = false;  // another matrix may bring a solid back
    }
    warnings_.insert(warnings_.end(), flat_.warnings.begin(), flat_.warnings.end());
    if (flat_.regions.empty()) throw Error(Status::scene, nothing_to_render(warnings_));

    const std::vector<Box>& boxes = measured_->boxes;
    clipped_ = clip_by_half_spaces(scene, flat_, boxes);
    auto [space, order] = space_of(boxes, clipped_.ray_boxes.empty() ? boxes : clipped_.ray_boxes);
    order_ = std::move(order);
    instances_.resize(boxes.size());
    std::iota(instances_.begin(), instances_.end(), std::uint32_t{0});
    Box bounds;
    auto [logic, terms] = pack_regions(flat_, clipped_.trees, order_, measured_->brlcad_boxes,
                                       take_infos(flat_, measured_->brlcad_boxes, bounds));
    logic.bounds = bounds;
    terms_ = std::move(terms);
    space.starting_node = starting_node(space.nodes, terms_);
    Appearance appearance = appearance_of({scene.lights, scene.ambient, scene.background}, logic.region_info,
                                          logic.region_lights, options.display_shading, warnings_);
    packer_.emplace(scene, flat_, *measured_, clipped_, space, common_box(scene, flat_, space));
    compiled_ = {std::move(space), std::move(logic), {}, std::move(appearance), {}, 0, 0, {}};
    is_kept_ = boxes.size() <= most_kept;
    pack();
    is_local_ = is_local_ && is_kept_ && compiled_.unbounded_count == 0 && clipped_.ray_boxes.empty() &&
                compiled_.region_lights.empty() && std::ranges::all_of(boxes, is_finite);
}

/// Packs the solids, as they are numbered now.
void Compilation::pack() {
    std::vector<Warning> warnings;
    static_cast<Shapes&>(compiled_) = packer_->lay_out(order_, terms_, is_kept_, warnings);
    compiled_.warnings = warnings_;
    compiled_.warnings.insert(compiled_.warnings.end(), warnings.begin(), warnings.end());
    join_equal(compiled_.warnings);
    compiled_.status_tree = std::make_shared<LateStatusTree>();
    compiled_.geometry_hash = hash_of_geometry(compiled_);
    compiled_.hash = hash_of(compiled_);
}

/// Adds the members with other matrices in `b` than in `a`.
void Compilation::add_different(const MemberMatrices& a, const MemberMatrices& b, ChangedMembers& found) const {
    const auto is_other = [&](const Member& member) {
        return !same_bits(names_.matrix(member.first, member.second, a), names_.matrix(member.first, member.second, b));
    };
    for (const MemberMatrices* matrices : {&a, &b}) {
        const MemberMatrices& other = matrices == &a ? b : a;
        for (const auto& [member, matrix] : matrices->all)
            if (is_other(member)) found.all.push_back(member);
        for (const auto& [path, matrix] : matrices->alone)
            if (const auto known = other.alone.find(path);
                known == other.alone.end() || !same_bits(known->second, matrix))
                found.alone.push_back(path);
    }
    std::ranges::sort(found.all);
    found.all.erase(std::unique(found.all.begin(), found.all.end()), found.all.end());
}

std::optional<CompiledScene> Compilation::with(const SceneChanges& changes, const CompiledScene& before,
                                               const SceneChanges& of_before) {
    // Also members whose matrices are right here, and not in `before`.
    ChangedMembers moved;
    add_different(changes_.matrices, changes.matrices, moved);
    add_different(of_before.matrices, changes.matrices, moved);
    if (!is_local_ || changes_.removed != of_before.removed) return {};
    std::vector<std::uint32_t> gone, regions;
    if (!take_out(changes, gone) || !place(changes, moved, regions)) return {};
    CompiledScene made = compiled_;
    static_cast<Appearance&>(made) = before;
    made.region_info = before.region_info;
    made.states = before.states;
    made.paths = before.paths;
    if (!gone.empty()) {
        made.region_info = without(made.region_info, gone);
        if (!made.states.empty()) erase_at(made.states.own(), gone);
        made.paths = std::make_shared<LatePathTable>();
        made.materials = without(made.materials, gone);
        made.materials_hash = 0;
        for (std::size_t i = 0; i < made.materials.size(); ++i)
            made.materials_hash += hash_of_material(i, made.materials[i]);
    }
    for (const std::uint32_t region : regions)
        made.region_info.own(region).bounds = tree_box(flat_.regions[region].tree, measured_->brlcad_boxes);
    made.bounds = bounds_of(made.region_info);
    made.hash = hash_of(made);
    is_spent_ = false;
    return made;
}

/// Takes out what is removed, and finds the regions that are gone.
bool Compilation::take_out(const SceneChanges& changes, std::vector<std::uint32_t>& regions) {
    if (changes.removed == changes_.removed) return true;
    const bool has_notes = !flat_.warnings.empty() || warnings_.size() > scene_->warnings.size();
    if (has_notes || flat_.has_numbered_paths || !std::ranges::includes(changes.removed, changes_.removed))
        return false;
    std::vector<Member> removed;
    std::ranges::set_difference(changes.removed, changes_.removed, std::back_inserter(removed));
    changes_.removed = changes.removed;
    is_spent_ = true;
    std::optional<Moved> gone = csgrt::take_out(flat_, removed);
    if (!gone || !packer_->remove(gone->instances)) return false;
    std::vector<std::uint32_t> left;
    std::ranges::set_difference(instances_, gone->instances, std::back_inserter(left));
    instances_ = std::move(left);
    regions = std::move(gone->regions);
    compiled_.region_info = without(compiled_.region_info, regions);
    return true;
}

/// Compiles what stands elsewhere with other matrices of some members, and finds the regions that may have moved.
bool Compilation::place(const SceneChanges& changes, const ChangedMembers& members,
                        std::vector<std::uint32_t>& regions) {
    bool is_sound = true;
    const auto check = [&](const Member& member, const Matrix& matrix) {
        const TreeNode node{.matrix = matrix};
        check_matrix(node, [&](const Place&, const std::string&, const std::string&) { is_sound = false; });
        if (member.second != Names::none && names_.child(member.first, member.second) >= Names::left_out)
            is_sound = false;
    };
    for (const Member& member : members.all)
        check(member, names_.matrix(member.first, member.second, changes.matrices));
    for (const auto& [path, matrix] : changes.matrices.alone) check(path.back(), matrix);
    if (!is_sound) return false;
    names_.set_matrices(changes.matrices);
    std::optional<Moved> moved = place_again(flat_, members);
    if (!moved) {
        names_.set_matrices(changes_.matrices);
        place_again(flat_, members);
        return false;
    }
    is_spent_ = true;
    changes_.matrices = changes.matrices;
    regions = std::move(moved->regions);
    for (const std::uint32_t i : moved->instances) {
        measured_->measure(*scene_, flat_, i);
        if (!is_finite(measured_->boxes[i]) || !extent_fault(*scene_, flat_, *measured_, i).empty()) return false;
    }
    if (!packer_->repack(moved->instances) || !number(moved->instances)) return false;
    pack();
    return true;
}

/// Numbers the solids again. False: the model has another sphere.
bool Compilation::number(const std::vector<std::uint32_t>& moved) {
    constexpr std::uint32_t none = 0xffffffff;
    // The hierarchy has the instances that are left by their numbers among these.
    std::vector<Box> boxes;
    std::vector<std::uint32_t> numbers(measured_->boxes.size(), none), earlier_order, changed;
    boxes.reserve(instances_.size());
    for (const std::uint32_t i : instances_) {
        numbers[i] = static_cast<std::uint32_t>(boxes.size());
        boxes.push_back(measured_->boxes[i]);
    }
    for (const std::uint32_t i : order_) earlier_order.push_back(numbers[i]);
    for (const std::uint32_t i : moved) changed.push_back(numbers[i]);
    Space sphere;
    set_sphere(boxes, sphere);
    if (!same_bits(sphere.center, compiled_.center) || !same_bits(sphere.radius, compiled_.radius)) return false;
    const EarlierHierarchy earlier{compiled_.nodes.get(), earlier_order, changed};
    auto [space, order] = space_of(boxes, boxes, &earlier);
    for (std::uint32_t& i : order) i = instances_[i];
    if (order != order_) {
        order_ = std::move(order);
        auto [logic, terms] = pack_regions(flat_, {}, order_, measured_->brlcad_boxes, compiled_.region_info);
        static_cast<Logic&>(compiled_) = std::move(logic);
        terms_ = std::move(terms);
    }
    static_cast<Space&>(compiled_) = std::move(space);
    compiled_.starting_node = starting_node(compiled_.nodes, terms_);
    return true;
}

CompiledScene compile(const Scene& scene, const std::vector<std::string>& objects, const CompileOptions& options) {
    return Compilation(std::shared_ptr<const Scene>(std::shared_ptr<void>(), &scene), objects, options, 0).compiled();
}

}  // namespace csgrt
