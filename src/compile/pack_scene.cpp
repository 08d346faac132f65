// Pack scene: packs the solids of a scene with several threads. Shared planes and surfaces are found as one thread
// would find them in the solids' order, so the result does not depend on the threads.
#include <algorithm>
#include <map>
#include <set>

#include "compile/linear.hpp"
#include "compile/pack_chunks.hpp"
#include "compile/solids/pack.hpp"
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

namespace {

/// The packer of a scene's solids works in steps: each solid by itself, then shared surfaces and planes, then the
/// layout of all numbers. In each step several threads work on chunks.
class ScenePacker {
public:
    ScenePacker(const Scene& scene, const FlatScene& flat, const Measured& measured, const Clipped& clipped,
                const std::vector<std::uint32_t>& order, const Space& space, const Box& common,
                const std::vector<kernel::SolidRecord>& terms, std::vector<Warning>& warnings)
        : scene_(scene),
          flat_(flat),
          measured_(measured),
          clipped_(clipped),
          order_(order),
          common_(common),
          terms_(terms),
          warnings_(warnings),
          planes_(space.center, 0.5 * diagonal(common)),
          surfaces_(space.center, space.radius),
          shells_(common),
          chunks_((order.size() + PackedChunk::size - 1) / PackedChunk::size) {}

    Shapes pack() {
        shapes_.tolerance = scene_.tolerance;
        resize_cleared(shapes_.solids, order_.size());
        shapes_.solid_info = SharedList<SolidInfo>(order_.size());
        resize_cleared(shapes_.solid_boxes, order_.size());
        for_each_chunk(chunks_, [this](std::size_t number) {
            const std::size_t first = number * PackedChunk::size;
            const std::size_t last = std::min(order_.size(), first + PackedChunk::size);
            chunks_[number].parts.reserve(last - first);
            std::vector<Plane> planes;
            for (std::size_t i = first; i < last; ++i) {
                constexpr std::size_t soon = 4, later = 8;
                if (i + later < last) {
                    prefetch_line(&flat_.instances[order_[i + later]]);
                    prefetch_whole(measured_.boxes[order_[i + later]]);
                }
                if (i + soon < last) {
                    const Instance& instance = flat_.instances[order_[i + soon]];
                    prefetch_whole(scene_.objects[instance.object]);
                    prefetch_whole(*instance.matrix);
                }
                prepare(i, chunks_[number], planes);
            }
            append_keys(planes, chunks_[number].planes);
        });
        share_surfaces();
        lay_out_reals();
        share_planes(chunks_, planes_, common_, shapes_, shells_, warnings_);
        note_shells();
        for (PackedChunk& chunk : chunks_) {
            shapes_.solid_types |= chunk.solid_types;
            std::move(chunk.warnings.begin(), chunk.warnings.end(), std::back_inserter(warnings_));
        }
        return std::move(shapes_);
    }

private:
    /// Computes everything of a solid that needs no other solid.
    void prepare(std::size_t number, PackedChunk& chunk, std::vector<Plane>& planes) {
        const Instance& instance = flat_.instances[order_[number]];
        const Solid& solid = std::get<Solid>(scene_.objects[instance.object]);
        const Shape& shape = shape_of(scene_, flat_, instance);
        const Box& own = measured_.boxes[order_[number]];
        shapes_.solid_info.own(number) = {solid.name, type_name(solid.shape), instance.piece};
        shapes_.solid_boxes[number] = own;
        if (!is_finite(own) && !std::holds_alternative<Half>(shape))
            chunk.warnings.push_back({solid.name, solid.place, "its faces do not close: it is not bounded", 1});
        if (const auto* revolve = std::get_if<Revolve>(&shape))
            if (std::string note = note_on(*revolve); !note.empty())
                chunk.warnings.push_back({solid.name, solid.place, std::move(note), 1});

        PackedChunk::Part part{};
        part.stands = static_cast<std::uint32_t>(number);
        part.is_large = !std::visit(IsSmall{}, shape);
        if (!part.is_large) {
            const std::size_t first_real = chunk.reals.size(), first_plane = planes.size();
            Packer packer{*instance.matrix, shapes_, shared_, chunk.reals, planes, terms_[number]};
            if (std::holds_alternative<Arb>(shape)) {
                packer.record.type = SOLID_ARB;
                packer.faces(measured_.faces(order_[number]));
            } else {
                std::visit(packer, shape);
                if (packer.record.type == SOLID_HALF && ends(order_[number])) {
                    packer.record.type = SOLID_ARB;  // the half-space's plane is face 0 of the arb, too
                    for (const Plane& side : sides_of(clipped_.bounded_box)) packer.face(side);
                }
            }
            part.faces = static_cast<std::uint32_t>(planes.size() - first_plane);
            for (const Plane& cut : cuts_of(flat_, instance)) planes.push_back(transform_plane(*instance.matrix, cut));
            part.cuts = static_cast<std::uint32_t>(planes.size() - first_plane - part.faces);
            part.is_polyhedron = packer.is_polyhedron;
            part.first_real = static_cast<std::uint32_t>(first_real);
            part.reals = static_cast<std::uint32_t>(chunk.reals.size() - first_real);
            shapes_.solids[number] = packer.record;
            chunk.solid_types |= 1u << packer.record.type;
            if (auto surface = surfaces_.surface_of(packer.record.type, chunk.reals.data() + first_real,
                                                    packer.axes_in_world, is_finite(own) ? own : common_))
                chunk.surfaces.emplace_back(static_cast<std::uint32_t>(chunk.parts.size()), *surface);
        }
        chunk.parts.push_back(part);
    }

    /// Whether a half-space is bounded by the scene's box.
    bool ends(std::uint32_t instance) const {
        return !clipped_.ray_boxes.empty() && is_finite(clipped_.ray_boxes[instance]) &&
               !is_empty(clipped_.ray_boxes[instance]);
    }

    void append_keys(const std::vector<Plane>& planes, std::vector<PackedPlane>& keys) const {
        keys.reserve(keys.size() + planes.size());
        for (const Plane& plane : planes) keys.push_back({planes_.key_of(plane)});
    }

    /// The axes of a small solid, computed once more.
    WideMatrix axes_of(std::uint32_t number) {
        const Instance& instance = flat_.instances[order_[number]];
        std::vector<double> reals;
        std::vector<Plane> planes;
        Packer packer{*instance.matrix, shapes_, shared_, reals, planes};
        std::visit(packer, shape_of(scene_, flat_, instance));
        return packer.axes_in_world;
    }

    void share_surfaces() {
        Shards shards(chunks_.size());
        for_each_chunk(chunks_, [&](std::size_t number) {
            for (const auto& [part, surface] : chunks_[number].surfaces)
                shards.chunk(number).add(surfaces_.coarse_cells(surface));
        });
        shards.sort();
        shards.for_each(surfaces_, [&](SurfaceTable& table, std::span<const Shards::Member> members, std::size_t) {
            const SurfaceTable::RealsOf reals_of = [&](std::uint32_t solid) {
                PackedChunk& chunk = chunks_[solid / PackedChunk::size];
                const PackedChunk::Part& part = chunk.parts[solid % PackedChunk::size];
                return std::span<double>(chunk.reals).subspan(part.first_real, part.reals);
            };
            const SurfaceTable::AxesOf axes = [&](std::uint32_t solid) { return axes_of(solid); };
            const auto chunk_at = [&](std::size_t i) -> PackedChunk& { return chunks_[members[i].chunk]; };
            const auto surface_at = [&](std::size_t i) -> auto& { return chunk_at(i).surfaces[members[i].index]; };
            const auto part_at = [&](std::size_t i) -> auto& { return chunk_at(i).parts[surface_at(i).first]; };
            for (std::size_t i = 0; i < members.size(); ++i) {
                constexpr std::size_t soon = 6, later = 12;
                if (i + later < members.size()) prefetch_whole(surface_at(i + later));
                if (i + soon < members.size()) prefetch_line(&part_at(i + soon));
                const SurfaceTable::Surface& surface = surface_at(i).second;
                PackedChunk::Part& part = part_at(i);
                const SurfaceTable::Found found = table.add(surface, part.stands, reals_of, axes);
                shells_.add(found.solid, part.stands, found.depth, shapes_.solid_boxes[part.stands]);
                part.stands = found.solid;
            }
        });
    }

    /// Lays out the reals. Solids without a fixed size are packed here: they write positions among the scene's numbers.
    void lay_out_reals() {
        std::vector<double>& reals = shapes_.reals;
        std::size_t next = 0;
        for (std::size_t i = 0; i < order_.size(); ++i) {
            PackedChunk& chunk = chunks_[i / PackedChunk::size];
            PackedChunk::Part& part = chunk.parts[i % PackedChunk::size];
            kernel::SolidRecord& record = shapes_.solids[i];
            if (part.is_large) {
                reals.resize(next);
                pack_large(i, chunk, part);
                next = reals.size();
            } else if (part.stands == i) {
                record.first_real = static_cast<std::uint32_t>(next);
                next += part.reals;
            } else {
                record.first_real = shapes_.solids[part.stands].first_real;
            }
            check_numbers(std::max(next, shapes_.words.size()));
        }
        resize_cleared(reals, next);
        for_each_chunk(chunks_, [&](std::size_t number) {
            const PackedChunk& chunk = chunks_[number];
            for (std::size_t i = 0; i < chunk.parts.size(); ++i) {
                const PackedChunk::Part& part = chunk.parts[i];
                const std::size_t solid = number * PackedChunk::size + i;
                if (part.is_large || part.stands != solid) continue;
                std::copy_n(chunk.reals.begin() + part.first_real, part.reals,
                            reals.begin() + shapes_.solids[solid].first_real);
            }
        });
    }

    void pack_large(std::size_t number, PackedChunk& chunk, PackedChunk::Part& part) {
        const Instance& instance = flat_.instances[order_[number]];
        std::vector<Plane> faces;
        Packer packer{*instance.matrix, shapes_, shared_, shapes_.reals, faces, terms_[number]};
        packer.record.first_real = static_cast<std::uint32_t>(shapes_.reals.size());
        std::visit(packer, shape_of(scene_, flat_, instance));
        shapes_.solids[number] = packer.record;
        chunk.solid_types |= 1u << packer.record.type;
        const Solid& solid = std::get<Solid>(scene_.objects[instance.object]);
        for (const std::string& note : packer.notes) chunk.warnings.push_back({solid.name, solid.place, note, 1});
        part.faces = static_cast<std::uint32_t>(faces.size());
        part.is_polyhedron = packer.is_polyhedron;
        append_keys(faces, chunk.large_faces.emplace_back());
    }

    /// Warns of shells that a region loses: regions that contain the outer solid minus the inner solid.
    void note_shells() {
        if (shells_.all().empty()) return;
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> thickness;  // by pair of instances
        for (const Shell& shell : shells_.all()) {
            double& most = thickness[{order_[shell.outer], order_[shell.inner]}];
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
            Warning& warning = warnings_.emplace_back();
            warning.object = name(pair.first);
            warning.reason = "nothing is left between it and '" + name(pair.second) +
                             "', which is removed from it: they are " + rounded_text(thickness[pair]) +
                             " mm apart, and surfaces within 1e-10 of a solid's size are one";
        }
        if (lost.size() > shown)
            warnings_.emplace_back().reason =
                "nothing is left between " + std::to_string(lost.size() - shown) + " more such pairs of solids";
    }

    const Scene& scene_;
    const FlatScene& flat_;
    const Measured& measured_;
    const Clipped& clipped_;
    const std::vector<std::uint32_t>& order_;
    const Box& common_;
    const std::vector<kernel::SolidRecord>& terms_;
    std::vector<Warning>& warnings_;
    Shapes shapes_;
    PlaneTable planes_;  ///< empty, as is `surfaces_`: the shards' tables begin as copies
    SurfaceTable surfaces_;
    SharedParts shared_;
    Shells shells_;
    std::vector<PackedChunk> chunks_;
};

}  // namespace

Shapes pack_solids(const Scene& scene, const FlatScene& flat, const Measured& measured, const Clipped& clipped,
                   const std::vector<std::uint32_t>& order, const Space& space, const Box& common,
                   const std::vector<kernel::SolidRecord>& terms, std::vector<Warning>& warnings) {
    return ScenePacker(scene, flat, measured, clipped, order, space, common, terms, warnings).pack();
}

}  // namespace csgrt
