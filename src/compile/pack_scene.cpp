#include "compile/pack_scene.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>

#include "compile/linear.hpp"
#include "compile/solids/packer.hpp"
#include "base/prefetch.hpp"
#include "scene/range.hpp"

namespace csgrt {

namespace {

/// Does a solid's Packer leave the scene's tables alone? Types without a fixed size write into these tables, and share
/// their elements.
struct IsSmall {
    template <class Shape>
    bool operator()(const Shape&) const {
        return true;
    }
    bool operator()(const Metaball&) const { return false; }
    bool operator()(const Bot&) const { return false; }
    bool operator()(const Ars&) const { return false; }
    bool operator()(const Nmg&) const { return false; }
    bool operator()(const Ebm&) const { return false; }
    bool operator()(const Vol&) const { return false; }
    bool operator()(const Dsp&) const { return false; }
    bool operator()(const Extrude&) const { return false; }
    bool operator()(const Revolve&) const { return false; }
    bool operator()(const Unsupported&) const { return false; }
};

}  // namespace

void check_numbers(std::size_t count) {
    if (count > 0xffffffffu) throw Error(Status::scene, "the parameters of all solids together exceed 2^32 numbers");
}

ScenePacker::ScenePacker(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured,
                         const Clipped& clipped, const Space& space, const Box& common)
    : scene_(scene),
      flat_(flat),
      measured_(measured),
      clipped_(clipped),
      common_(common),
      planes_(space.center, 0.5 * diagonal(common)),
      surfaces_(space.center, space.radius),
      shells_(common),
      chunks_((flat.instances.size() + PackedChunk::size - 1) / PackedChunk::size),
      surface_shards_(chunks_.size()) {
    large_.tolerance = scene.tolerance;
    for_each_chunk(chunks_, [this](std::size_t number) {
        const std::size_t first = number * PackedChunk::size;
        const std::size_t last = std::min(flat_.instances.size(), first + PackedChunk::size);
        PackedChunk& chunk = chunks_[number];
        chunk.parts.reserve(last - first);
        for (std::size_t i = first; i < last; ++i) {
            constexpr std::size_t soon = 4;
            if (i + soon < last) {
                const Instance& instance = flat_.instances[i + soon];
                prefetch_whole(scene_.objects[instance.object]);
                prefetch_whole(*instance.matrix);
            }
            const Alone alone = pack_alone(static_cast<std::uint32_t>(i), chunk.reals, chunk.planes, chunk.warnings);
            if (alone.surface)
                chunk.surfaces.emplace_back(static_cast<std::uint32_t>(chunk.parts.size()), *alone.surface);
            chunk.parts.push_back(alone.part);
            if (i == first) chunk.planes.reserve(chunk.planes.size() * (last - first));  // most are alike
        }
    });
    pack_large();
    share_surfaces();
    sharing_.emplace(chunks_, planes_, measured_.boxes, common_, shells_);
}

Shapes ScenePacker::lay_out(const std::vector<std::uint32_t>& order, const std::vector<kernel::SolidRecord>& terms,
                            bool again, std::vector<Warning>& warnings) {
    Shapes shapes = again ? large_ : std::move(large_);
    const bool has_infos = infos_.size() == order.size();
    const auto has_info = [&](std::size_t i) { return has_infos && infos_order_[i] == order[i]; };
    const auto has_matrix = [&](std::size_t i) { return has_info(i) && !std::ranges::binary_search(moved_, order[i]); };
    std::ranges::sort(moved_);
    shapes.solid_info = has_infos ? infos_ : SharedList<SolidInfo>(order.size());
    shapes.solid_matrices = has_infos ? matrices_ : SharedList<Matrix>(order.size());
    resize_cleared(shapes.solids, order.size());
    resize_cleared(shapes.solid_boxes, order.size());
    std::vector<kernel::SolidRecord>& solids = shapes.solids.own();
    std::vector<Box>& boxes = shapes.solid_boxes.own();
    std::atomic<std::uint32_t> types{0};
    for_chunks(order.size(), PackedChunk::size, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        std::uint32_t own_types = 0;
        for (std::size_t i = first; i < last; ++i) {
            constexpr std::size_t soon = 4, later = 8;
            if (i + later < last) {
                if (!has_info(i + later)) prefetch_line(&flat_.instances[order[i + later]]);
                prefetch_whole(measured_.boxes[order[i + later]]);
                prefetch_whole(part_of(order[i + later]));
            }
            if (i + soon < last && !has_info(i + soon))
                prefetch_whole(scene_.objects[flat_.instances[order[i + soon]].object]);
            if (!has_info(i)) {
                const Instance& instance = flat_.instances[order[i]];
                const Solid& solid = std::get<Solid>(scene_.objects[instance.object]);
                shapes.solid_info.own(i) = {solid.name, type_name(solid.shape), instance.piece};
            }
            if (!has_matrix(i)) shapes.solid_matrices.own(i) = *flat_.instances[order[i]].matrix;
            const PackedChunk::Part& part = part_of(order[i]);
            boxes[i] = measured_.boxes[order[i]];
            solids[i] = terms[i];
            solids[i].type = part.type;
            solids[i].first_word = part.first_word;
            own_types |= 1u << part.type;
        }
        types |= own_types;
    });
    if (again) {
        infos_ = shapes.solid_info;
        matrices_ = shapes.solid_matrices;
        moved_.clear();
        infos_order_ = order;
    }
    shapes.solid_types = types;
    lay_out_reals(order, shapes);
    sharing_->write(order, shapes, warnings);
    note_shells(warnings);
    for (const PackedChunk& chunk : chunks_)
        warnings.insert(warnings.end(), chunk.warnings.begin(), chunk.warnings.end());
    return shapes;
}

/// The number of an instance's surface in its chunk, if the instance has one.
std::optional<std::size_t> ScenePacker::surface_number(std::uint32_t instance) {
    const auto& surfaces = chunk_of(instance).surfaces;
    const std::uint32_t number = instance % PackedChunk::size;
    const auto known = std::lower_bound(surfaces.begin(), surfaces.end(), number,
                                        [](const auto& entry, std::uint32_t of) { return entry.first < of; });
    if (known == surfaces.end() || known->first != number) return {};
    return static_cast<std::size_t>(known - surfaces.begin());
}

bool ScenePacker::remove(std::span<const std::uint32_t> instances) {
    for (const std::uint32_t instance : instances) {
        if (part_of(instance).is_large || !chunk_of(instance).warnings.empty()) return false;
        part_of(instance).is_gone = true;
        sharing_->remove(instance);
        if (const auto surface = surface_number(instance))
            surface_shards_.touch(instance / PackedChunk::size, *surface);
    }
    return true;
}

bool ScenePacker::repack(std::span<const std::uint32_t> instances) {
    for (const std::uint32_t instance : instances) {
        std::vector<double> reals;
        std::vector<PackedPlane> planes;
        std::vector<Warning> warnings;
        if (part_of(instance).is_large) return false;
        moved_.push_back(instance);
        const auto [made, surface] = pack_alone(instance, reals, planes, warnings);
        PackedChunk& chunk = chunk_of(instance);
        PackedChunk::Part& part = part_of(instance);
        const bool has_same_sizes = made.type == part.type && made.reals == part.reals && made.faces == part.faces &&
                                    made.cuts == part.cuts && warnings.empty();
        const std::optional<std::size_t> known = surface_number(instance);
        if (!has_same_sizes || known.has_value() != surface.has_value()) return false;
        std::copy(reals.begin(), reals.end(), chunk.reals.begin() + part.first_real);
        for (std::size_t i = 0; i < planes.size(); ++i) chunk.planes[part.first_plane + i].key = planes[i].key;
        sharing_->change(instance);
        if (!surface) continue;
        chunk.surfaces[*known].second = *surface;
        Shards::Chunk at;
        at.add(surfaces_.coarse_cells(*surface));
        surface_shards_.replace(instance / PackedChunk::size, *known, at);
    }
    std::vector<Shards::Member> members = surface_shards_.take_changed();
    std::erase_if(members, [&](const Shards::Member& member) {
        const PackedChunk& chunk = chunks_[member.chunk];
        return chunk.parts[chunk.surfaces[member.index].first].is_gone;
    });
    for (const auto& [number, index] : members) {
        const auto solid =
            static_cast<std::uint32_t>(number * PackedChunk::size + chunks_[number].surfaces[index].first);
        part_of(solid).stands = part_of(solid).numbers = solid;
    }
    SurfaceTable table = surfaces_;
    share(table, members);
    sharing_->share_again();
    return shells_.all().empty();
}

/// Computes everything of a solid that needs no other solid. Of a large solid nearly nothing.
ScenePacker::Alone ScenePacker::pack_alone(std::uint32_t number, std::vector<double>& reals,
                                           std::vector<PackedPlane>& keys, std::vector<Warning>& warnings) {
    const Instance& instance = flat_.instances[number];
    const Solid& solid = std::get<Solid>(scene_.objects[instance.object]);
    const Shape& shape = shape_of(scene_, flat_, instance);
    const Box& own = measured_.boxes[number];
    if (!is_finite(own) && !std::holds_alternative<Half>(shape))
        warnings.push_back({solid.name, solid.place, "its faces do not close: it is not bounded", 1});
    if (const auto* revolve = std::get_if<Revolve>(&shape))
        if (std::string note = note_on(*revolve); !note.empty())
            warnings.push_back({solid.name, solid.place, std::move(note), 1});

    Alone alone{};
    PackedChunk::Part& part = alone.part;
    part.stands = part.numbers = number;
    part.is_large = !std::visit(IsSmall{}, shape);
    if (part.is_large) return alone;
    std::vector<Plane> planes;
    planes.reserve(8);  // enough for most solids
    Packer packer{*instance.matrix, large_, shared_, reals, planes};
    part.first_real = static_cast<std::uint32_t>(reals.size());
    if (std::holds_alternative<Arb>(shape)) {
        packer.record.type = SOLID_ARB;
        packer.faces(measured_.faces(number));
    } else {
        std::visit(packer, shape);
        if (packer.record.type == SOLID_HALF && ends(number)) {
            packer.record.type = SOLID_ARB;  // the half-space's plane is face 0 of the arb, too
            for (const Plane& side : sides_of(clipped_.bounded_box)) packer.face(side);
        }
    }
    part.faces = static_cast<std::uint32_t>(planes.size());
    for (const Plane& cut : cuts_of(flat_, instance)) planes.push_back(transform_plane(*instance.matrix, cut));
    part.cuts = static_cast<std::uint32_t>(planes.size() - part.faces);
    part.type = packer.record.type;
    part.is_polyhedron = packer.is_polyhedron;
    part.reals = static_cast<std::uint32_t>(reals.size() - part.first_real);
    append_keys(planes, keys);
    alone.surface = surfaces_.surface_of(part.type, reals.data() + part.first_real, packer.axes_in_world,
                                         is_finite(own) ? own : common_);
    return alone;
}

/// Whether a half-space is bounded by the scene's box.
bool ScenePacker::ends(std::uint32_t instance) const {
    return !clipped_.ray_boxes.empty() && is_finite(clipped_.ray_boxes[instance]) &&
           !is_empty(clipped_.ray_boxes[instance]);
}

void ScenePacker::append_keys(const std::vector<Plane>& planes, std::vector<PackedPlane>& keys) const {
    for (const Plane& plane : planes) keys.push_back({planes_.key_of(plane)});
}

/// The axes of a small solid, computed once more.
WideMatrix ScenePacker::axes_of(std::uint32_t number) {
    const Instance& instance = flat_.instances[number];
    std::vector<double> reals;
    std::vector<Plane> planes;
    Packer packer{*instance.matrix, large_, shared_, reals, planes};
    std::visit(packer, shape_of(scene_, flat_, instance));
    return packer.axes_in_world;
}

/// Packs the solids without a fixed size, one after the other: they write positions among the scene's numbers.
void ScenePacker::pack_large() {
    for (std::uint32_t number = 0; number < flat_.instances.size(); ++number) {
        if (part_of(number).is_large) pack_large(number);
        check_numbers(std::max(large_.reals.size(), large_.words.size()));
    }
}

void ScenePacker::pack_large(std::uint32_t number) {
    const Instance& instance = flat_.instances[number];
    PackedChunk& chunk = chunk_of(number);
    PackedChunk::Part& part = part_of(number);
    std::vector<Plane> faces;
    Packer packer{*instance.matrix, large_, shared_, large_.reals, faces};
    packer.record.first_real = static_cast<std::uint32_t>(large_.reals.size());
    std::visit(packer, shape_of(scene_, flat_, instance));
    part.type = packer.record.type;
    part.first_real = packer.record.first_real;
    part.first_word = packer.record.first_word;
    const Solid& solid = std::get<Solid>(scene_.objects[instance.object]);
    for (const std::string& note : packer.notes) chunk.warnings.push_back({solid.name, solid.place, note, 1});
    part.faces = static_cast<std::uint32_t>(faces.size());
    part.is_polyhedron = packer.is_polyhedron;
    append_keys(faces, chunk.large_faces.emplace_back());
}

void ScenePacker::share_surfaces() {
    for_each_chunk(chunks_, [&](std::size_t number) {
        for (const auto& [part, surface] : chunks_[number].surfaces)
            surface_shards_.chunk(number).add(surfaces_.coarse_cells(surface));
    });
    surface_shards_.sort();
    surface_shards_.for_each(surfaces_, [&](SurfaceTable& table, std::span<const Shards::Member> members, std::size_t) {
        share(table, members);
    });
    surface_shards_.forget_members();
}

/// Finds the solids whose numbers some solids use.
void ScenePacker::share(SurfaceTable& table, std::span<const Shards::Member> members) {
    const SurfaceTable::RealsOf reals = [&](std::uint32_t solid) { return reals_of(part_of(solid).numbers); };
    const SurfaceTable::AxesOf axes = [&](std::uint32_t solid) { return axes_of(solid); };
    const auto chunk_at = [&](std::size_t i) -> PackedChunk& { return chunks_[members[i].chunk]; };
    const auto surface_at = [&](std::size_t i) -> auto& { return chunk_at(i).surfaces[members[i].index]; };
    const auto part_at = [&](std::size_t i) -> auto& { return chunk_at(i).parts[surface_at(i).first]; };
    for (std::size_t i = 0; i < members.size(); ++i) {
        constexpr std::size_t soon = 6, later = 12;
        if (i + later < members.size()) prefetch_whole(surface_at(i + later));
        if (i + soon < members.size()) prefetch_line(&part_at(i + soon));
        PackedChunk::Part& part = part_at(i);
        const std::uint32_t solid = part.stands;
        const SurfaceTable::Found found = table.add(surface_at(i).second, solid, reals, axes);
        shells_.add(found.solid, solid, found.depth, measured_.boxes[solid]);
        part.stands = found.solid;
        if (found.gives) part_of(found.solid).numbers = solid;
    }
}

/// Lays out the reals: those of large solids, then those of the others as solids are numbered.
void ScenePacker::lay_out_reals(const std::vector<std::uint32_t>& order, Shapes& shapes) const {
    std::vector<kernel::SolidRecord>& solids = shapes.solids.own();
    std::vector<std::uint32_t> first(flat_.instances.size());  // one an instance
    std::size_t next = shapes.reals.size();
    for (std::size_t i = 0; i < order.size(); ++i) {
        constexpr std::size_t soon = 16;
        if (i + soon < order.size()) prefetch_line(&part_of(order[i + soon]));
        const PackedChunk::Part& part = part_of(order[i]);
        first[order[i]] = part.is_large ? part.first_real : static_cast<std::uint32_t>(next);
        if (!part.is_large && part.stands == order[i]) next += part.reals;
        check_numbers(std::max(next, shapes.words.size()));
    }
    resize_cleared(shapes.reals, next);
    std::vector<double>& reals = shapes.reals.own();
    for_chunks(order.size(), PackedChunk::size, 0, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            constexpr std::size_t soon = 4;
            if (i + soon < end && !part_of(order[i + soon]).is_large) prefetch_line(reals_of(order[i + soon]).data());
            const PackedChunk::Part& part = part_of(order[i]);
            solids[i].first_real = first[part.stands];
            if (part.is_large || part.stands != order[i]) continue;
            const std::span<const double> own = reals_of(part.numbers);
            std::copy(own.begin(), own.end(), reals.begin() + first[order[i]]);
        }
    });
}

/// Warns of shells that a region loses: regions that contain the outer solid minus the inner solid.
void ScenePacker::note_shells(std::vector<Warning>& warnings) const {
    if (shells_.all().empty()) return;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> thickness;  // by pair of instances
    for (const Shell& shell : shells_.all()) {
        double& most = thickness[{shell.outer, shell.inner}];
        most = std::max(most, shell.thickness);
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> lost;
    for (const FlatRegion& region : flat_.regions) {
        const std::vector<FlatTree::Node>& nodes = region.tree.nodes;
        std::set<std::uint32_t> held, removed;
        std::vector<bool> is_removed = {false};  // of the operands still to come, from the last node back
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            const bool here = is_removed.back();
            is_removed.pop_back();
            if (node->op == Operator::leaf) (here ? removed : held).insert(node->solid);
            for (std::uint32_t i = 0; node->op != Operator::leaf && i < node->arity; ++i)
                is_removed.push_back(here !=
                                     (node->op == Operator::not_ || (node->op == Operator::difference && i > 0)));
        }
        for (const auto& [pair, most] : thickness)
            if (held.contains(pair.first) && removed.contains(pair.second)) lost.insert(pair);
    }
    constexpr std::size_t shown = 5;
    std::size_t count = 0;
    for (const auto& pair : lost) {
        if (++count > shown) break;
        const auto name = [&](std::uint32_t instance) {
            return std::get<Solid>(scene_.objects[flat_.instances[instance].object]).name;
        };
        Warning& warning = warnings.emplace_back();
        warning.object = name(pair.first);
        warning.reason = "nothing is left between it and '" + name(pair.second) +
                         "', which is removed from it: they are " + rounded_text(thickness[pair]) +
                         " mm apart, and surfaces within 1e-10 of a solid's size are one";
    }
    if (lost.size() > shown)
        warnings.emplace_back().reason =
            "nothing is left between " + std::to_string(lost.size() - shown) + " more such pairs of solids";
}

}  // namespace csgrt
